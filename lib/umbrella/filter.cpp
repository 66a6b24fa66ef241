// Kruskal at every vertex: union-find over the link graph tells the first edge
// that closes a cycle, and peeling leaves off what was taken so far leaves the
// cycle alone. The paper searches the graph anew after each triangle; this is
// near linear in all.
#include "umbrella/filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "umbrella/incidence_internal.h"
#include "umbrella/link_graph_internal.h"
#include "umbrella/vertex_filter_internal.h"

namespace umbrella {
namespace {

/// The umbrella of one vertex after another.
class UmbrellaPicker {
 public:
  UmbrellaPicker(std::size_t n_vertices,
                 std::span<const RankedTriangle> triangles)
      : triangles_(triangles), graph_(n_vertices) {}

  /// @param at_v  the triangles at v
  /// @return the umbrella at v, empty if there is none; valid until the next
  ///   call
  std::span<const TriangleIndex> pick(VertexId v,
                                      std::span<const TriangleIndex> at_v) {
    sort_by_rank(at_v);
    graph_.clear();
    const auto closing =
        std::find_if(order_.begin(), order_.end(), [&](TriangleIndex t) {
          return graph_.add(opposite_edge(triangles_[t].corners, v));
        });
    if (closing == order_.end()) return {};

    const std::vector<std::uint8_t>& stays = graph_.peel();
    umbrella_.clear();
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k] != 0) umbrella_.push_back(order_[k]);
    return umbrella_;
  }

 private:
  /// Into order_.
  void sort_by_rank(std::span<const TriangleIndex> at_v) {
    if (sort_few_by_primary(at_v)) return;
    order_.assign(at_v.begin(), at_v.end());
    std::sort(order_.begin(), order_.end(),
              [this](TriangleIndex a, TriangleIndex b) {
                return ranks_before(triangles_[a], triangles_[b]);
              });
  }

  /// Puts each where as many go before it as there are smaller ones: more
  /// comparisons than sorting takes, but no jump that depends on one, and many
  /// at once. The upper halves of primaries nearly always suffice.
  /// @return whether they do, and the triangles are few
  bool sort_few_by_primary(std::span<const TriangleIndex> at_v) {
    constexpr std::size_t kMost = 32, kAtOnce = 8;
    const std::size_t n = at_v.size();
    if (n > kMost) return false;
    std::array<std::int32_t, kMost> key;
    for (std::size_t i = 0; i < n; ++i)
      key[i] = upper_half(triangles_[at_v[i]].rank.primary);
    // Before none: so that comparisons go in full blocks.
    std::size_t end = n;
    for (; end % kAtOnce != 0; ++end)
      key[end] = std::numeric_limits<std::int32_t>::max();
    order_.resize(n);
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::int32_t n_before = 0;
      for (std::size_t first = 0; first < end; first += kAtOnce)
        for (std::size_t k = first; k < first + kAtOnce; ++k)
          n_before += key[k] < key[i] ? 1 : 0;
      order_[static_cast<std::size_t>(n_before)] = at_v[i];
      sum += n_before;
    }
    // Less if some are equal.
    const auto all = static_cast<std::int32_t>(n);
    return sum == all * (all - 1) / 2;
  }

  /// Ascends with x.
  static std::int32_t upper_half(double x) {
    constexpr std::int64_t kAllButSign =
        std::numeric_limits<std::int64_t>::max();
    const auto bits = std::bit_cast<std::int64_t>(x);
    return static_cast<std::int32_t>((bits < 0 ? bits ^ kAllButSign : bits) >>
                                     32);
  }

  std::span<const RankedTriangle> triangles_;
  LinkGraph graph_;
  std::vector<TriangleIndex> order_;
  std::vector<TriangleIndex> umbrella_;
};

}  // namespace

FilterResult umbrella_filter(std::size_t n_vertices,
                             std::span<const RankedTriangle> triangles,
                             unsigned threads) {
  return filter_by_vertex(n_vertices, triangles, threads, [&] {
    return UmbrellaPicker(n_vertices, triangles);
  });
}

}  // namespace umbrella
