// Kruskal at every vertex: union-find over the link graph tells the first edge
// that closes a cycle, and peeling leaves off what was taken so far leaves the
// cycle alone. The paper searches the graph anew after each triangle; this is
// near linear in all. The usual few triangles are sorted, and their cycle is
// found, without a jump that depends on them.
#include "umbrella/filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "umbrella/first_cycle_internal.h"
#include "umbrella/incidence_internal.h"
#include "umbrella/link_graph_internal.h"
#include "umbrella/vertex_filter_internal.h"

namespace umbrella {
namespace {

/// The umbrella of one vertex after another.
class UmbrellaPicker {
 public:
  UmbrellaPicker(std::size_t n_vertices, const RankedTriangles& triangles)
      : triangles_(triangles), few_(n_vertices), graph_(n_vertices) {}

  /// @param at_v  the triangles at v
  /// @return the umbrella at v, empty if there is none; valid until the next
  ///   call
  std::span<const TriangleIndex> pick(VertexId v,
                                      std::span<const TriangleIndex> at_v) {
    umbrella_.clear();
    if (at_v.size() <= kFew)
      pick_from_few(v, at_v);
    else
      pick_from_many(v, at_v);
    return umbrella_;
  }

 private:
  static constexpr std::size_t kFew = FirstCycle::kMostEdges;
  static constexpr std::size_t kAtOnce = 4;
  /// Keys in one register, and all of them.
  using FourKeys [[gnu::vector_size(16)]] = std::int32_t;
  using Keys = std::array<FourKeys, kFew / kAtOnce>;
  using Places = std::array<std::size_t, kFew>;

  void pick_from_few(VertexId v, std::span<const TriangleIndex> at_v) {
    const std::size_t n = at_v.size();
    Keys keys;
    std::array<LinkEdge, kFew> edge, sorted;
    for (std::size_t i = 0; i < n; ++i) {
      const RankedTriangle& t = triangles_[at_v[i]];
      keys[i / kAtOnce][i % kAtOnce] = upper_half(t.rank.primary);
      edge[i] = opposite_edge(t.corners, v);
    }
    const Places place = places(at_v, keys);
    std::array<TriangleIndex, kFew> order;
    for (std::size_t i = 0; i < n; ++i) {
      order[place[i]] = at_v[i];
      sorted[place[i]] = edge[i];
    }
    std::uint32_t bits = few_.find(std::span(sorted).first(n));
    // The edge that closes the cycle is the last one on it.
    if (bits != 0 &&
        settle_ties(std::span(order).first(n),
                    static_cast<std::size_t>(std::bit_width(bits) - 1))) {
      for (std::size_t i = 0; i < n; ++i)
        sorted[i] = opposite_edge(triangles_[order[i]].corners, v);
      bits = few_.find(std::span(sorted).first(n));
    }
    for (; bits != 0; bits &= bits - 1)
      umbrella_.push_back(
          order[static_cast<std::size_t>(std::countr_zero(bits))]);
  }

  /// The umbrella is among the triangles up to the one that closes it, whatever
  /// the order of these: so exact ranks matter only where others are as near to
  /// the closing one as doubles tell. Puts these in exact order.
  ///
  /// @param sorted  as doubles tell
  /// @return whether there are any
  bool settle_ties(std::span<TriangleIndex> sorted, std::size_t closing) const {
    const RankOrder& order = triangles_.order();
    const auto ties = [&](std::size_t i) {
      return order.is_near_tie(triangles_[sorted[i]],
                               triangles_[sorted[i + 1]]);
    };
    std::size_t begin = closing, last = closing;
    while (begin > 0 && ties(begin - 1)) --begin;
    while (last + 1 < sorted.size() && ties(last)) ++last;
    if (begin == last) return false;
    order.sort(triangles_, sorted.subspan(begin, last + 1 - begin));
    return true;
  }

  /// For each triangle how many go before it: more comparisons than sorting
  /// takes, but no jump that depends on one, and many at once. The upper halves
  /// of primaries, the keys, nearly always suffice.
  Places places(std::span<const TriangleIndex> at_v, Keys& keys) const {
    const std::size_t n = at_v.size();
    // Before none: so that comparisons go in full registers.
    std::size_t end = n;
    for (; end % kAtOnce != 0; ++end)
      keys[end / kAtOnce][end % kAtOnce] =
          std::numeric_limits<std::int32_t>::max();
    Places place;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t key = keys[i / kAtOnce][i % kAtOnce];
      FourKeys minus_before = {};  // true is -1
      for (std::size_t r = 0; r < end / kAtOnce; ++r)
        minus_before += keys[r] < key;
      const std::int32_t n_before = -(minus_before[0] + minus_before[1] +
                                      minus_before[2] + minus_before[3]);
      sum += place[i] = static_cast<std::size_t>(n_before);
    }
    if (sum != n * (n - 1) / 2) part_equal(at_v, keys, place);
    return place;
  }

  /// Where keys are equal, as they are on the hull.
  void part_equal(std::span<const TriangleIndex> at_v, const Keys& keys,
                  Places& place) const {
    const auto key = [&keys](std::size_t i) {
      return keys[i / kAtOnce][i % kAtOnce];
    };
    for (std::size_t i = 0; i < at_v.size(); ++i)
      for (std::size_t k = 0; k < at_v.size(); ++k)
        if (key(k) == key(i) &&
            ranks_before(triangles_[at_v[k]], triangles_[at_v[i]]))
          ++place[i];
  }

  void pick_from_many(VertexId v, std::span<const TriangleIndex> at_v) {
    order_.assign(at_v.begin(), at_v.end());
    std::sort(order_.begin(), order_.end(),
              [this](TriangleIndex a, TriangleIndex b) {
                return ranks_before(triangles_[a], triangles_[b]);
              });
    const std::size_t closing = add_until_closed(v);
    if (closing == order_.size()) return;
    if (settle_ties(order_, closing)) add_until_closed(v);
    const std::vector<std::uint8_t>& stays = graph_.peel();
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k] != 0) umbrella_.push_back(order_[k]);
  }

  /// Adds the triangles at v in their order to the graph.
  /// @return the place of the one that closes a cycle, or their number
  std::size_t add_until_closed(VertexId v) {
    graph_.clear();
    const auto closing =
        std::find_if(order_.begin(), order_.end(), [&](TriangleIndex t) {
          return graph_.add(opposite_edge(triangles_[t].corners, v));
        });
    return static_cast<std::size_t>(closing - order_.begin());
  }

  /// Ascends with x, and is the same for 0 and -0.
  static std::int32_t upper_half(double x) {
    constexpr std::int64_t kAllButSign =
        std::numeric_limits<std::int64_t>::max();
    const auto bits = std::bit_cast<std::int64_t>(x + 0.0);
    return static_cast<std::int32_t>((bits < 0 ? bits ^ kAllButSign : bits) >>
                                     32);
  }

  const RankedTriangles& triangles_;
  FirstCycle few_;
  LinkGraph graph_;
  std::vector<TriangleIndex> order_;
  std::vector<TriangleIndex> umbrella_;
};

}  // namespace

FilterResult umbrella_filter(std::size_t n_vertices,
                             const RankedTriangles& triangles,
                             unsigned threads) {
  return filter_by_vertex(n_vertices, triangles, threads, [&] {
    return UmbrellaPicker(n_vertices, triangles);
  });
}

}  // namespace umbrella
