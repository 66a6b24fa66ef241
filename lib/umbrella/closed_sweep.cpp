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
  Sweep(std::size_t n_vertices, std::span<const Triangle> triangles)
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
    VertexId low = delaunay::kInfinite;
    bool is_met_twice = false;
    TriangleIndex both = 0;  // exclusive or of the two
  };

  bool visit(VertexId v, TriangleIndex begin, TriangleIndex end);
  bool find_edges(VertexId v, TriangleIndex begin, TriangleIndex end);
  bool pass_on(VertexId v, TriangleIndex t);
  bool relate(TriangleIndex t, std::uint32_t label);
  template <class Visit>
  void for_each_back(VertexId v, Visit visit) const {
    for (TriangleIndex t = first_back_[index(v)]; t != kNone; t = next_back_[t])
      visit(t);
  }
  /// Whether t, as it is, runs up along its edge from v to `high`.
  bool runs_up(TriangleIndex t, VertexId v, VertexId high) const {
    const auto& [a, b, c] = triangles_[t];
    return a != v || b == high;
  }

  std::span<const Triangle> triangles_;
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
    while (next < triangles_.size() && triangles_[next][0] == VertexId{v})
      ++next;
    if (!visit(VertexId{v}, begin, next)) return false;
  }
  return next == triangles_.size();
}

/// @param begin, end  the triangles whose first corner is v
bool Sweep::visit(VertexId v, TriangleIndex begin, TriangleIndex end) {
  if (!find_edges(v, begin, end)) return false;
  bool agrees = true;
  for_each_back(v, [&](TriangleIndex t) { agrees = pass_on(v, t) && agrees; });
  for (TriangleIndex t = begin; t < end; ++t) {
    if (labels_[t] != kNone) continue;
    labels_[t] = 2 * patches_.add();
    agrees = pass_on(v, t) && agrees;
  }
  return agrees;
}

/// Those up from v. @return whether each has two triangles
bool Sweep::find_edges(VertexId v, TriangleIndex begin, TriangleIndex end) {
  std::size_t n_with_one = 0;
  bool has_more = false;
  const auto meet = [&](VertexId high, TriangleIndex t) {
    Edge& edge = edge_to_[index(high)];
    if (edge.low != v) {
      edge = {v, false, t};
      ++n_with_one;
      return;
    }
    has_more = has_more || edge.is_met_twice;
    edge = {v, true, edge.both ^ t};
    --n_with_one;
  };
  for_each_back(v, [&](TriangleIndex t) { meet(triangles_[t][2], t); });
  for (TriangleIndex t = begin; t < end; ++t) {
    const auto& [a, b, c] = triangles_[t];
    meet(b, t);
    meet(c, t);
    next_back_[t] = std::exchange(first_back_[index(b)], t);
  }
  return n_with_one == 0 && !has_more;
}

/// Turns the triangles that follow t around v like it, beyond its last corner
/// first, up to one that has been turned. @return whether that agrees
bool Sweep::pass_on(VertexId v, TriangleIndex t) {
  VertexId high = triangles_[t][2];
  while (true) {
    const TriangleIndex next = edge_to_[index(high)].both ^ t;
    const bool is_same_way = runs_up(next, v, high) == runs_up(t, v, high);
    const std::uint32_t label = labels_[t] ^ (is_same_way ? 1U : 0U);
    if (labels_[next] != kNone) return relate(next, label);
    labels_[next] = label;
    const auto& [a, b, c] = triangles_[next];
    high = high == b ? c : b;
    t = next;
  }
}

/// Takes note that t should have another label as well.
bool Sweep::relate(TriangleIndex t, std::uint32_t label) {
  return labels_[t] == label ||
         patches_.relate(labels_[t] / 2, label / 2, (labels_[t] ^ label) & 1U);
}

TurnedTriangles Sweep::result() && {
  struct Component {
    std::uint32_t name = kNone;
    std::uint32_t parity = 0;  // of the first triangle
  };
  std::vector<Component> components(patches_.size());  // by root
  std::uint32_t n_components = 0;
  for (std::uint32_t& label : labels_) {
    const auto [root, parity] = patches_.find(label / 2);
    const std::uint32_t turned = (label & 1U) ^ parity;
    if (components[root].name == kNone)
      components[root] = {n_components++, turned};
    label = 2 * components[root].name + (turned ^ components[root].parity);
  }
  return {std::move(labels_), n_components};
}

}  // namespace

std::optional<TurnedTriangles> sweep_closed(
    std::size_t n_vertices, std::span<const Triangle> triangles) {
  Sweep sweep(n_vertices, triangles);
  if (!sweep.run()) return {};
  return std::move(sweep).result();
}

}  // namespace umbrella
