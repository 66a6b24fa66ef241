// A deletion changes types only at the three corners, so each round looks at
// the corners of the round before; triangles of type 3 wait in a heap and are
// looked at again when they come up.
#include "umbrella/clean_up.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>

#include "umbrella/cycle_check_internal.h"
#include "umbrella/link_graph_internal.h"

namespace umbrella {
namespace {

enum class Fate : std::uint8_t { Alive, Type2, Type3, Dissolved };

std::vector<VertexId> all_vertices(std::size_t n) {
  std::vector<VertexId> all(n);
  for (std::size_t v = 0; v < n; ++v)
    all[v] = VertexId{static_cast<std::uint32_t>(v)};
  return all;
}

class CleanUp {
 public:
  /// All vertices are taken to have one umbrella and no other triangles.
  CleanUp(std::size_t n_vertices, std::span<const RankedTriangle> triangles)
      : triangles_(triangles),
        incidence_(n_vertices, triangles.size(),
                   [&](TriangleIndex t) -> const Triangle& {
                     return triangles[t].corners;
                   }),
        cycle_(n_vertices),
        graph_(n_vertices),
        fate_(triangles.size(), Fate::Alive),
        type3_corners_(triangles.size()),
        has_umbrella_(n_vertices, true),
        is_dirty_(n_vertices),
        is_waiting_(triangles.size()),
        worst_first_(RanksBefore{triangles}) {}

  /// @param dirty  vertices where that is not so
  void delete_types_2_and_3(std::vector<VertexId> dirty);
  void dissolve_pieces(std::size_t largest);
  CleanUpResult result() const;

 private:
  struct RanksBefore {
    std::span<const RankedTriangle> triangles;
    bool operator()(TriangleIndex a, TriangleIndex b) const {
      return ranks_before(triangles[a], triangles[b]);
    }
  };

  template <class Visit>
  void for_each_alive(Visit visit) {
    for (TriangleIndex t = 0; t < triangles_.size(); ++t)
      if (fate_[t] == Fate::Alive) visit(t);
  }
  std::uint8_t corner_bit(TriangleIndex t, VertexId v) const {
    const Triangle& corners = triangles_[t].corners;
    return static_cast<std::uint8_t>((corners[0] == v ? 1U : 0U) |
                                     (corners[1] == v ? 2U : 0U) |
                                     (corners[2] == v ? 4U : 0U));
  }
  std::uint8_t without_corner(TriangleIndex t, VertexId v) const {
    return static_cast<std::uint8_t>(type3_corners_[t] & ~corner_bit(t, v));
  }
  std::span<const VertexId> piece_from(VertexId lowest,
                                       std::size_t most_triangles);
  void classify(VertexId v, std::vector<TriangleIndex>& type2);
  void classify_in_full(VertexId v, std::vector<TriangleIndex>& type2);
  std::vector<TriangleIndex> worst_type3();
  std::vector<VertexId> delete_all(std::span<const TriangleIndex> doomed,
                                   Fate fate);

  std::span<const RankedTriangle> triangles_;
  Incidence incidence_;
  CycleCheck cycle_;
  LinkGraph graph_;
  std::vector<Fate> fate_;
  std::vector<std::uint8_t> type3_corners_;  // bit i: of type 3 at corner i
  std::vector<bool> has_umbrella_;
  std::vector<bool> is_dirty_;
  std::vector<bool> is_waiting_;  // in worst_first_
  /// All triangles of type 3, and some that were, each once.
  std::priority_queue<TriangleIndex, std::vector<TriangleIndex>, RanksBefore>
      worst_first_;
  std::vector<TriangleIndex> alive_at_v_;
  std::vector<VertexId> piece_;
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
  for (const TriangleIndex t : incidence_.at(v)) {
    if (fate_[t] != Fate::Alive) continue;
    alive_at_v_.push_back(t);
    type3_corners_[t] = without_corner(t, v);
  }
  const std::size_t n = alive_at_v_.size();
  has_umbrella_[index(v)] = n > 0 && n == cycle_.find(n, [&](std::size_t i) {
    return opposite_edge(triangles_[alive_at_v_[i]].corners, v);
  });
  if (!has_umbrella_[index(v)]) classify_in_full(v, type2);
}

/// The same where the triangles at v, all in alive_at_v_, are not one umbrella.
void CleanUp::classify_in_full(VertexId v, std::vector<TriangleIndex>& type2) {
  graph_.clear();
  for (const TriangleIndex t : alive_at_v_)
    graph_.add(opposite_edge(triangles_[t].corners, v));
  has_umbrella_[index(v)] = graph_.has_cycle();
  if (!graph_.has_cycle()) return;

  const bool is_of_type3 = !graph_.has_one_cycle();
  const std::vector<std::uint8_t>& in_umbrella = graph_.drop_bridges();
  for (std::size_t k = 0; k < alive_at_v_.size(); ++k) {
    const TriangleIndex t = alive_at_v_[k];
    if (in_umbrella[k] == 0) type2.push_back(t);
    if (in_umbrella[k] == 0 || !is_of_type3) continue;
    type3_corners_[t] |= corner_bit(t, v);
    if (!is_waiting_[t]) worst_first_.push(t);
    is_waiting_[t] = true;
  }
}

/// The triangle of type 3 that ranks last; none if there is none.
std::vector<TriangleIndex> CleanUp::worst_type3() {
  while (!worst_first_.empty()) {
    const TriangleIndex t = worst_first_.top();
    worst_first_.pop();
    is_waiting_[t] = false;
    if (fate_[t] == Fate::Alive && type3_corners_[t] != 0) return {t};
  }
  return {};
}

/// @return the corners of the doomed, each once
std::vector<VertexId> CleanUp::delete_all(std::span<const TriangleIndex> doomed,
                                          Fate fate) {
  std::vector<VertexId> dirty;
  for (const TriangleIndex t : doomed) {
    fate_[t] = fate;
    for (const VertexId v : triangles_[t].corners) {
      if (is_dirty_[index(v)]) continue;
      is_dirty_[index(v)] = true;
      dirty.push_back(v);
    }
  }
  return dirty;
}

/// Deletes closed pieces of at most `largest` triangles. By now triangles that
/// share a vertex with an umbrella are all in it, so pieces are what triangles
/// join, and closed if each vertex has an umbrella. A piece is looked for from
/// its lowest vertex: few are lower than all around them, and from these most
/// searches soon meet a lower one.
void CleanUp::dissolve_pieces(std::size_t largest) {
  std::vector<std::uint8_t> is_lowest(has_umbrella_.size(), 1);
  for_each_alive([&](TriangleIndex t) {
    is_lowest[index(triangles_[t].corners[1])] = 0;
    is_lowest[index(triangles_[t].corners[2])] = 0;
  });
  for (std::uint32_t v = 0; v < is_lowest.size(); ++v) {
    if (is_lowest[v] == 0) continue;
    for (const VertexId w : piece_from(VertexId{v}, largest)) {
      has_umbrella_[index(w)] = false;
      for (const TriangleIndex t : incidence_.at(w))
        if (fate_[t] == Fate::Alive) fate_[t] = Fate::Dissolved;
    }
  }
}

/// The vertices of the piece with that lowest vertex; none if there is a lower
/// one, or the piece is open or has more triangles.
std::span<const VertexId> CleanUp::piece_from(VertexId lowest,
                                              std::size_t most_triangles) {
  std::size_t n_triangles = 0;
  piece_.assign(1, lowest);
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    if (!has_umbrella_[index(piece_[i])]) return {};
    for (const TriangleIndex t : incidence_.at(piece_[i])) {
      if (fate_[t] != Fate::Alive) continue;
      const Triangle& corners = triangles_[t].corners;
      n_triangles += corners[0] == piece_[i] ? 1 : 0;
      // Each vertex of a closed piece has three triangles or more.
      if (corners[0] < lowest || n_triangles > most_triangles ||
          piece_.size() > most_triangles)
        return {};
      for (const VertexId v : corners)
        if (std::find(piece_.begin(), piece_.end(), v) == piece_.end())
          piece_.push_back(v);
    }
  }
  return piece_;
}

CleanUpResult CleanUp::result() const {
  CleanUpResult result;
  const auto n_alive = static_cast<std::size_t>(
      std::count(fate_.begin(), fate_.end(), Fate::Alive));
  result.triangles.reserve(n_alive);
  result.deleted.reserve(triangles_.size() - n_alive);
  for (TriangleIndex t = 0; t < triangles_.size(); ++t) {
    const bool is_alive = fate_[t] == Fate::Alive;
    (is_alive ? result.triangles : result.deleted).push_back(triangles_[t]);
    result.n_type2 += fate_[t] == Fate::Type2 ? 1 : 0;
    result.n_type3 += fate_[t] == Fate::Type3 ? 1 : 0;
    result.n_dissolved += fate_[t] == Fate::Dissolved ? 1 : 0;
  }
  for (std::size_t v = 0; v < has_umbrella_.size(); ++v)
    if (!has_umbrella_[v])
      result.without_umbrella.push_back(
          VertexId{static_cast<std::uint32_t>(v)});
  return result;
}

}  // namespace

CleanUpResult clean_up(std::size_t n_vertices,
                       std::span<const RankedTriangle> triangles,
                       const CleanUpOptions& options,
                       const std::optional<std::vector<VertexId>>& unsettled) {
  CleanUp work(n_vertices, triangles);
  work.delete_types_2_and_3(unsettled ? *unsettled : all_vertices(n_vertices));
  work.dissolve_pieces(options.largest_dissolved);
  return work.result();
}

}  // namespace umbrella
