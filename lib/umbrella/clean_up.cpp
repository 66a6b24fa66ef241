// A deletion changes types only at the three corners, so each round looks at
// the corners of the round before; triangles of type 3 wait in a heap and are
// looked at again when they come up. Where a vertex has one umbrella and no
// other triangles, a deletion leaves no cycle: it is never the cause of another
// one, and need not be looked at.
#include "umbrella/clean_up.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "delaunay/lazy_vector.h"
#include "umbrella/cycle_check_internal.h"
#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/link_graph_internal.h"

namespace umbrella {
namespace {

enum class Fate : std::uint8_t { Alive, Type2, Type3, Dissolved };

/// The triangles at some vertices.
class TrianglesAt {
 public:
  /// @param vertices  which
  TrianglesAt(std::size_t n_vertices, std::span<const VertexId> vertices,
              std::span<const RankedTriangle> triangles)
      : is_here_(n_vertices),
        first_(n_vertices, kNone),
        next_(3 * triangles.size()) {
    for (const VertexId v : vertices) is_here_[index(v)] = 1;
    for (TriangleIndex t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t].corners;
      if ((is_here_[index(a)] | is_here_[index(b)] | is_here_[index(c)]) == 0)
        continue;
      for (std::uint32_t i = 0; i < 3; ++i)
        next_[3 * t + i] =
            std::exchange(first_[index(triangles[t].corners[i])], 3 * t + i);
    }
  }

  bool has(VertexId v) const { return is_here_[index(v)] != 0; }
  /// Calls visit(t) for each triangle at v, which must be here.
  template <class Visit>
  void for_each(VertexId v, Visit visit) const {
    for (std::uint32_t i = first_[index(v)]; i != kNone; i = next_[i])
      visit(i / 3);
  }

 private:
  static constexpr std::uint32_t kNone =
      std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint8_t> is_here_;
  // Lists of 3 t + i: corner i of triangle t is the vertex.
  std::vector<std::uint32_t> first_;
  delaunay::UnsetVector<std::uint32_t> next_;
};

std::vector<VertexId> all_vertices(std::size_t n) {
  std::vector<VertexId> all(n);
  for (std::size_t v = 0; v < n; ++v)
    all[v] = VertexId{static_cast<std::uint32_t>(v)};
  return all;
}

/// Vertices at which there are other triangles than one umbrella, or none.
std::vector<VertexId> find_unsettled(
    std::size_t n_vertices, std::span<const RankedTriangle> triangles) {
  std::vector<VertexId> vertices = all_vertices(n_vertices);
  const TrianglesAt at(n_vertices, vertices, triangles);
  CycleCheck check(n_vertices);
  std::vector<LinkEdge> edges;
  std::erase_if(vertices, [&](VertexId v) {
    edges.clear();
    at.for_each(v, [&](TriangleIndex t) {
      edges.push_back(opposite_edge(triangles[t].corners, v));
    });
    const auto edge = [&](std::size_t i) { return edges[i]; };
    return !edges.empty() && check.find(edges.size(), edge) == edges.size();
  });
  return vertices;
}

class CleanUp {
 public:
  /// @param unsettled  all other vertices have one umbrella and no other
  ///   triangles
  CleanUp(std::size_t n_vertices, RankedTriangles triangles,
          std::span<const VertexId> unsettled)
      : triangles_(std::move(triangles)),
        at_(n_vertices, unsettled, triangles_),
        graph_(n_vertices),
        fate_(triangles_.size(), Fate::Alive),
        type3_corners_(triangles_.size()),
        has_umbrella_(n_vertices, 1),
        is_dirty_(n_vertices),
        is_waiting_(triangles_.size()),
        worst_first_(RanksBefore{&triangles_}) {}

  CleanUp(const CleanUp&) = delete;  // the heap looks at triangles_
  CleanUp& operator=(const CleanUp&) = delete;

  /// @param dirty  the unsettled vertices
  void delete_types_2_and_3(std::vector<VertexId> dirty);
  void dissolve_pieces(std::size_t largest);
  CleanUpResult result() &&;

 private:
  struct RanksBefore {
    const RankedTriangles* triangles;
    bool operator()(TriangleIndex a, TriangleIndex b) const {
      return triangles->order().before((*triangles)[a], (*triangles)[b]);
    }
  };

  template <class Visit>
  void for_each_alive(Visit visit) const {
    for (TriangleIndex t = 0; t < triangles_.size(); ++t)
      if (fate_[t] == Fate::Alive) visit(t);
  }
  std::uint8_t corner_bit(TriangleIndex t, VertexId v) const {
    const Triangle& corners = triangles_[t].corners;
    return static_cast<std::uint8_t>((corners[0] == v ? 1U : 0U) |
                                     (corners[1] == v ? 2U : 0U) |
                                     (corners[2] == v ? 4U : 0U));
  }
  bool is_of_type3(TriangleIndex t) const {
    return fate_[t] == Fate::Alive && type3_corners_[t] != 0;
  }
  std::uint8_t without_corner(TriangleIndex t, VertexId v) const {
    return static_cast<std::uint8_t>(type3_corners_[t] & ~corner_bit(t, v));
  }
  void classify(VertexId v, std::vector<TriangleIndex>& type2);
  std::vector<TriangleIndex> worst_type3();
  std::vector<VertexId> delete_all(std::span<const TriangleIndex> doomed,
                                   Fate fate);
  /// A way down from a vertex goes to the lowest corner of a triangle, again
  /// and again.
  struct Valleys {
    std::vector<std::uint32_t> bottom;  // of a vertex: where it ends
    std::vector<std::uint32_t> size;    // of a bottom: triangles
  };
  Valleys find_valleys() const;

  RankedTriangles triangles_;
  TrianglesAt at_;  // unsettled vertices
  LinkGraph graph_;
  std::vector<Fate> fate_;
  std::vector<std::uint8_t> type3_corners_;  // bit i: of type 3 at corner i
  std::vector<std::uint8_t> has_umbrella_;
  std::vector<bool> is_dirty_;
  std::vector<bool> is_waiting_;  // in one of the next two
  // All triangles of type 3, and some that were, each once.
  std::vector<TriangleIndex> found_;  // since the last one was deleted
  std::priority_queue<TriangleIndex, std::vector<TriangleIndex>, RanksBefore>
      worst_first_;
  std::vector<TriangleIndex> alive_at_v_;
};

void CleanUp::delete_types_2_and_3(std::vector<VertexId> dirty) {
  while (!dirty.empty()) {
    std::vector<TriangleIndex> type2;
    for (const VertexId v : dirty) classify(v, type2);
    dirty = type2.empty() ? delete_all(worst_type3(), Fate::Type3)
                          : delete_all(type2, Fate::Type2);
  }
}

/// Brings what is known about v up to date, and appends its triangles of type
/// 2, alive until the round ends.
void CleanUp::classify(VertexId v, std::vector<TriangleIndex>& type2) {
  is_dirty_[index(v)] = false;
  alive_at_v_.clear();
  graph_.clear();
  at_.for_each(v, [&](TriangleIndex t) {
    if (fate_[t] != Fate::Alive) return;
    alive_at_v_.push_back(t);
    type3_corners_[t] = without_corner(t, v);
    graph_.add(opposite_edge(triangles_[t].corners, v));
  });
  has_umbrella_[index(v)] = graph_.has_cycle() ? 1 : 0;
  if (!graph_.has_cycle()) return;

  const bool has_type3 = !graph_.has_one_cycle();
  const std::vector<std::uint8_t>& in_umbrella = graph_.drop_bridges();
  for (std::size_t k = 0; k < alive_at_v_.size(); ++k) {
    const TriangleIndex t = alive_at_v_[k];
    if (in_umbrella[k] == 0) type2.push_back(t);
    if (in_umbrella[k] == 0 || !has_type3) continue;
    type3_corners_[t] |= corner_bit(t, v);
    if (!is_waiting_[t]) found_.push_back(t);
    is_waiting_[t] = true;
  }
}

/// The triangle of type 3 that ranks last; none if there is none.
std::vector<TriangleIndex> CleanUp::worst_type3() {
  // Most that were found are gone by now.
  for (const TriangleIndex t : found_)
    if (is_of_type3(t))
      worst_first_.push(t);
    else
      is_waiting_[t] = false;
  found_.clear();
  while (!worst_first_.empty()) {
    const TriangleIndex t = worst_first_.top();
    worst_first_.pop();
    is_waiting_[t] = false;
    if (is_of_type3(t)) return {t};
  }
  return {};
}

/// @return the unsettled corners of the doomed, each once
std::vector<VertexId> CleanUp::delete_all(std::span<const TriangleIndex> doomed,
                                          Fate fate) {
  std::vector<VertexId> dirty;
  for (const TriangleIndex t : doomed) {
    fate_[t] = fate;
    for (const VertexId v : triangles_[t].corners) {
      if (!at_.has(v)) has_umbrella_[index(v)] = 0;
      if (!at_.has(v) || is_dirty_[index(v)]) continue;
      is_dirty_[index(v)] = true;
      dirty.push_back(v);
    }
  }
  return dirty;
}

/// Deletes closed pieces of at most `largest` triangles. By now triangles that
/// share a vertex with an umbrella are all in it, so pieces are what triangles
/// join, and closed if each vertex has an umbrella.
void CleanUp::dissolve_pieces(std::size_t largest) {
  Valleys valleys = find_valleys();
  std::vector<std::uint32_t>& size = valleys.size;  // of a piece, at its root
  std::vector<std::uint8_t> is_small(size.size());
  for (std::size_t v = 0; v < size.size(); ++v)
    is_small[v] = size[valleys.bottom[v]] <= largest ? 1 : 0;
  // Most valleys are too large to be part of such a piece.
  DisjointSets pieces(std::move(valleys.bottom));
  for_each_alive([&](TriangleIndex t) {
    const auto& [a, b, c] = triangles_[t].corners;
    if ((is_small[index(a)] | is_small[index(b)] | is_small[index(c)]) == 0)
      return;
    pieces.unite(index(a), index(b));
    pieces.unite(index(a), index(c));
  });
  for (std::uint32_t v = 0; v < size.size(); ++v)
    if (size[v] > 0 && pieces.root(v) != v)
      size[pieces.root(v)] += std::exchange(size[v], 0);
  for (std::uint32_t v = 0; v < size.size(); ++v)
    if (has_umbrella_[v] == 0) size[pieces.root(v)] = 0;  // it is open
  const auto is_doomed = [&](std::uint32_t n) { return n > 0 && n <= largest; };
  if (std::none_of(size.begin(), size.end(), is_doomed)) return;
  for_each_alive([&](TriangleIndex t) {
    const Triangle& corners = triangles_[t].corners;
    if (!is_doomed(size[pieces.root(index(corners[0]))])) return;
    fate_[t] = Fate::Dissolved;
    for (const VertexId v : corners) has_umbrella_[index(v)] = 0;
  });
}

CleanUp::Valleys CleanUp::find_valleys() const {
  Valleys result;
  std::vector<std::uint32_t>& down = result.bottom;
  down.resize(has_umbrella_.size());
  std::iota(down.begin(), down.end(), 0U);
  std::vector<std::uint32_t> n_lowest_at(down.size());
  for_each_alive([&](TriangleIndex t) {
    const auto& [a, b, c] = triangles_[t].corners;
    const auto lowest = static_cast<std::uint32_t>(a);
    ++n_lowest_at[lowest];
    down[index(b)] = std::min(down[index(b)], lowest);
    down[index(c)] = std::min(down[index(c)], lowest);
  });
  result.size.resize(down.size());
  // Lower ones first: each is at the end of its way then.
  for (std::size_t v = 0; v < down.size(); ++v) {
    down[v] = down[down[v]];
    result.size[down[v]] += n_lowest_at[v];
  }
  return result;
}

// In place, as the filter does.
CleanUpResult CleanUp::result() && {
  CleanUpResult result;
  std::vector<RankedTriangle> triangles = std::move(triangles_).list();
  auto kept = triangles.begin();
  for (TriangleIndex t = 0; t < triangles.size(); ++t) {
    if (fate_[t] == Fate::Alive) {
      *kept++ = triangles[t];
      continue;
    }
    result.deleted.push_back(triangles[t]);
    result.n_type2 += fate_[t] == Fate::Type2 ? 1 : 0;
    result.n_type3 += fate_[t] == Fate::Type3 ? 1 : 0;
    result.n_dissolved += fate_[t] == Fate::Dissolved ? 1 : 0;
  }
  triangles.erase(kept, triangles.end());
  result.triangles = std::move(triangles);
  for (std::size_t v = 0; v < has_umbrella_.size(); ++v)
    if (has_umbrella_[v] == 0)
      result.without_umbrella.push_back(
          VertexId{static_cast<std::uint32_t>(v)});
  return result;
}

}  // namespace

CleanUpResult clean_up(std::size_t n_vertices, RankedTriangles triangles,
                       const CleanUpOptions& options,
                       const std::optional<std::vector<VertexId>>& unsettled) {
  const std::vector<VertexId> dirty =
      unsettled ? *unsettled : find_unsettled(n_vertices, triangles);
  CleanUp work(n_vertices, std::move(triangles), dirty);
  work.delete_types_2_and_3(dirty);
  work.dissolve_pieces(options.largest_dissolved);
  return std::move(work).result();
}

}  // namespace umbrella
