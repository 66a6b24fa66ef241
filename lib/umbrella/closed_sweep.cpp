// Vertices are taken by ascending ids. The triangles at a vertex that reach
// back to a lower one are known by then. The others, whose first corner it is,
// make fans between two of these, and take their orientation from one end to
// the other; or an umbrella, which begins a new patch. As long as ids that are
// near mean points that are near, all that a step looks at is in the cache.
#include <limits>
#include <utility>

#include "umbrella/closed_sweep_internal.h"
#include "umbrella/parity_sets_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Sweep {
 public:
  Sweep(std::size_t n_vertices, std::span<const LocatedTriangle> triangles)
      : triangles_(triangles),
        labels_(triangles.size(), kNone),
        first_back_(n_vertices, kNone),
        next_back_(triangles.size()),
        edge_to_(n_vertices),
        patches_(0) {}

  /// @return whether all is as it should be
  bool run();
  TurnedTriangles result() &&;

 private:
  /// From the vertex at hand up to another one.
  struct Edge {
    std::uint32_t state = kNone;  // 2 v, with two triangles 2 v + 1
    TriangleIndex both = 0;       // exclusive or of these
  };

  bool visit(VertexId v, TriangleIndex begin, TriangleIndex end);
  bool find_edges(VertexId v, TriangleIndex begin, TriangleIndex end);
  bool pass_on(VertexId v, TriangleIndex t, std::uint32_t runs_up);
  bool relate(TriangleIndex t, std::uint32_t label);
  template <class Visit>
  void for_each_back(VertexId v, Visit visit) const {
    for (TriangleIndex t = first_back_[index(v)]; t != kNone; t = next_back_[t])
      visit(t);
  }
  const Triangle& corners(TriangleIndex t) const {
    return triangles_[t].corners;
  }

  std::span<const LocatedTriangle> triangles_;
  std::vector<std::uint32_t> labels_;  // 2 patch, if turned 2 patch + 1
  // Lists of the triangles with the same middle corner.
  std::vector<TriangleIndex> first_back_, next_back_;
  std::vector<Edge> edge_to_;
  ParitySets patches_;
};

bool Sweep::run() {
  TriangleIndex next = 0;
  for (std::uint32_t v = 0; v < first_back_.size(); ++v) {
    const TriangleIndex begin = next;
    while (next < triangles_.size() && corners(next)[0] == VertexId{v}) ++next;
    if (!visit(VertexId{v}, begin, next)) return false;
  }
  return next == triangles_.size();
}

/// @param begin, end  the triangles whose first corner is v
bool Sweep::visit(VertexId v, TriangleIndex begin, TriangleIndex end) {
  if (!find_edges(v, begin, end)) return false;
  bool agrees = true;
  for_each_back(v,
                [&](TriangleIndex t) { agrees = pass_on(v, t, 1) && agrees; });
  for (TriangleIndex t = begin; t < end; ++t) {
    if (labels_[t] != kNone) continue;
    labels_[t] = 2 * patches_.add();
    agrees = pass_on(v, t, 0) && agrees;
  }
  return agrees;
}

/// Those up from v. @return whether each has two triangles
bool Sweep::find_edges(VertexId v, TriangleIndex begin, TriangleIndex end) {
  const auto with_one = static_cast<std::uint32_t>(2 * index(v));
  std::ptrdiff_t n_with_one = 0;
  bool has_more = false;
  // No processor can guess which triangle is the first at its edge.
  const auto meet = [&](VertexId high, TriangleIndex t) {
    Edge& edge = edge_to_[index(high)];
    const auto is_second = static_cast<std::uint32_t>(edge.state == with_one);
    has_more |= edge.state == with_one + 1;
    edge = {with_one + is_second, (edge.both & (0U - is_second)) ^ t};
    n_with_one += 1 - 2 * static_cast<std::ptrdiff_t>(is_second);
  };
  for_each_back(v, [&](TriangleIndex t) { meet(corners(t)[2], t); });
  for (TriangleIndex t = begin; t < end; ++t) {
    const auto& [a, b, c] = corners(t);
    meet(b, t);
    meet(c, t);
    next_back_[t] = std::exchange(first_back_[index(b)], t);
  }
  return n_with_one == 0 && !has_more;
}

/// Turns the triangles that follow t around v like it, beyond its last corner
/// first, up to one that has been turned. @return whether that agrees
///
/// @param runs_up  1 if t, as it is, runs up along its edge to that corner, or
///   0
bool Sweep::pass_on(VertexId v, TriangleIndex t, std::uint32_t runs_up) {
  VertexId high = corners(t)[2];
  std::uint32_t label = labels_[t];
  while (true) {
    t ^= edge_to_[index(high)].both;
    const auto& [a, b, c] = corners(t);
    const auto is_up = static_cast<std::uint32_t>(a != v) |
                       static_cast<std::uint32_t>(b == high);
    label ^= is_up ^ runs_up ^ 1U;
    if (labels_[t] != kNone) return relate(t, label);
    labels_[t] = label;
    // Its first corner is v: it comes up one edge and goes down the other.
    high = b == high ? c : b;
    runs_up = is_up ^ 1U;
  }
}

/// Takes note that t should have another label as well.
bool Sweep::relate(TriangleIndex t, std::uint32_t label) {
  return labels_[t] == label ||
         patches_.relate(labels_[t] / 2, label / 2, (labels_[t] ^ label) & 1U);
}

TurnedTriangles Sweep::result() && {
  std::vector<std::uint32_t> final_label(patches_.size(), kNone);
  std::uint32_t n_components = 0;
  // The first triangle of a component is in its first patch, and not turned.
  for (std::uint32_t p = 0; p < final_label.size(); ++p) {
    const auto [root, parity] = patches_.find(p);
    if (final_label[root] == kNone)
      final_label[root] = 2 * n_components++ + parity;
    final_label[p] = final_label[root] ^ parity;
  }
  for (std::uint32_t& label : labels_)
    label = final_label[label / 2] ^ (label & 1U);
  return {std::move(labels_), n_components};
}

}  // namespace

std::optional<TurnedTriangles> sweep_closed(
    std::size_t n_vertices, std::span<const LocatedTriangle> triangles) {
  Sweep sweep(n_vertices, triangles);
  if (!sweep.run()) return {};
  return std::move(sweep).result();
}

}  // namespace umbrella
