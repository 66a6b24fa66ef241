// Kruskal at every vertex: the first edge that closes a cycle ends it. Nearly
// always all triangles taken so far are on that cycle, which is seen by
// counting nodes and one walk around. If not, union-find over the link graph
// tells the edge, and peeling leaves off what was taken leaves the cycle alone.
// The paper searches the graph anew after each triangle; this is near linear in
// all. The usual few triangles are sorted without a jump that depends on them.
#include "umbrella/filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "umbrella/cycle_check_internal.h"
#include "umbrella/first_cycle_internal.h"
#include "umbrella/link_graph_internal.h"
#include "umbrella/vertex_filter_internal.h"

namespace umbrella {
namespace {

/// The umbrella of one vertex after another.
class UmbrellaPicker {
 public:
  UmbrellaPicker(std::size_t n_vertices, const RankedTriangles& triangles)
      : triangles_(triangles),
        check_(n_vertices),
        few_(n_vertices),
        graph_(n_vertices) {
    std::iota(unsorted_.begin(), unsorted_.end(), 0U);
  }

  /// @return positions in the star, none if it holds no umbrella; valid until
  ///   the next call
  std::span<const std::uint32_t> pick(const Star& star) {
    const std::size_t n = star.triangles.size();
    if (n > kFew) return pick_from_many(star);
    if (star.odd == 0 && is_umbrella(star))
      return std::span(unsorted_).first(n);
    if (n <= 2 * kAtOnce)
      sort_few<2>(star);
    else if (n <= 3 * kAtOnce)
      sort_few<3>(star);
    else if (n <= 4 * kAtOnce)
      sort_few<4>(star);
    else
      sort_few<8>(star);
    return pick_from_sorted(star);
  }

 private:
  static constexpr std::size_t kFew = FirstCycle::kMostEdges;
  static constexpr std::size_t kAtOnce = 4;

  /// Whether all its triangles make one: their order does not matter then.
  bool is_umbrella(const Star& star) {
    const std::size_t n = star.triangles.size();
    return n == check_.find(
                    n, [&](std::size_t i) { return star.triangles[i].edge; });
  }

  /// What is done to four at once, in one register.
  using FourKeys [[gnu::vector_size(16)]] = float;
  using FourPlaces [[gnu::vector_size(16)]] = std::int32_t;

  /// Puts the positions of the star's triangles in their order. How many go
  /// before each takes more comparisons than sorting, but no jump that depends
  /// on one, and many at once. Keys nearly always suffice.
  template <std::size_t kRegisters>
  void sort_few(const Star& star) {
    constexpr std::size_t kMost = kRegisters * kAtOnce;
    static_assert(kMost <= kFew && kMost <= 2 * Star::kPadding);
    const std::size_t n = star.keys.size();
    const float* const key_of = star.keys.data();
    std::array<FourKeys, kRegisters> keys;
    std::memcpy(keys.data(), key_of, sizeof(keys));
    std::array<FourPlaces, kRegisters> places = {};
    // What is no key is before none, and none before it.
    for (std::size_t i = 0; i < kMost; ++i) {
      const FourKeys key = FourKeys{} + key_of[i];
      // True is -1.
      for (std::size_t r = 0; r < kRegisters; ++r) places[r] -= key < keys[r];
    }
    FourPlaces sums = {};
    for (const FourPlaces& four : places) sums += four;
    std::array<std::int32_t, kMost> place_of;
    std::memcpy(place_of.data(), places.data(), sizeof(place_of));
    const std::int32_t sum = sums[0] + sums[1] + sums[2] + sums[3];
    if (static_cast<std::size_t>(sum) != n * (n - 1) / 2)
      part_equal(star, place_of);
    // What is no key comes first, and is written over.
    for (std::size_t i = kMost; i-- > 0;)
      order_[static_cast<std::size_t>(place_of[i])] =
          static_cast<std::uint32_t>(i);
  }

  /// Where keys are equal, as they are on the hull.
  void part_equal(const Star& star, std::span<std::int32_t> place) const {
    for (std::size_t i = 0; i < star.keys.size(); ++i)
      for (std::size_t k = 0; k < star.keys.size(); ++k)
        if (star.keys[k] == star.keys[i] && ranks_before(star, k, i))
          ++place[i];
  }
  const RankedTriangle& triangle(const Star& star, std::size_t i) const {
    return triangles_[star.triangles[i].triangle()];
  }
  bool ranks_before(const Star& star, std::size_t i, std::size_t k) const {
    return umbrella::ranks_before(triangle(star, i), triangle(star, k));
  }

  /// The umbrella is among the triangles up to the one that closes it, whatever
  /// the order of these. So exact ranks matter only where others are as near to
  /// that one as doubles tell: puts these in exact order.
  ///
  /// @param sorted  positions in the star, as doubles tell
  /// @param closing  place of the closing one
  /// @return whether there are others
  bool settle_ties(const Star& star, std::span<std::uint32_t> sorted,
                   std::size_t closing) const {
    // Ranks that are so near have keys next to each other, or equal ones.
    constexpr float kGap = 1 + 0x1p-22F;
    constexpr float kLeast = std::numeric_limits<float>::min();
    const auto ties_with_next = [&](std::size_t i) {
      const std::uint32_t a = sorted[i], b = sorted[i + 1];
      return !(star.keys[b] > kGap * star.keys[a] + kLeast) &&
             triangles_.order().is_near_tie(triangle(star, a),
                                            triangle(star, b));
    };
    std::size_t begin = closing, last = closing;
    while (begin > 0 && ties_with_next(begin - 1)) --begin;
    while (last + 1 < sorted.size() && ties_with_next(last)) ++last;
    if (begin == last) return false;
    triangles_.order().sort(sorted.subspan(begin, last + 1 - begin),
                            [&](std::uint32_t i) -> const RankedTriangle& {
                              return triangle(star, i);
                            });
    return true;
  }

  /// Whose positions are in order_.
  std::span<const std::uint32_t> pick_from_sorted(const Star& star) {
    const std::size_t n = star.triangles.size();
    const auto last = [](std::uint32_t bits) {
      return static_cast<std::size_t>(std::bit_width(bits) - 1);
    };
    std::uint32_t bits = first_cycle(star);
    if (bits == 0) return {};
    // The edge that closes the cycle is the last one on it.
    if (settle_ties(star, std::span(order_).first(n), last(bits)))
      bits = first_cycle(star);
    if ((bits & (bits + 1)) == 0)
      return std::span(order_).first(last(bits) + 1);
    std::size_t n_on_cycle = 0;
    for (; bits != 0; bits &= bits - 1)
      order_[n_on_cycle++] =
          order_[static_cast<std::size_t>(std::countr_zero(bits))];
    return std::span(order_).first(n_on_cycle);
  }

  /// Places in order_, as bits.
  std::uint32_t first_cycle(const Star& star) {
    const std::size_t n = star.triangles.size();
    const std::size_t n_taken = check_.find(
        n, [&](std::size_t i) { return star.triangles[order_[i]].edge; });
    if (n_taken > 0) return 0xffff'ffffU >> (kFew - n_taken);
    std::array<LinkEdge, kFew> edges;
    for (std::size_t i = 0; i < n; ++i)
      edges[i] = star.triangles[order_[i]].edge;
    return few_.find(std::span(edges).first(n));
  }

  std::span<const std::uint32_t> pick_from_many(const Star& star) {
    many_.resize(star.triangles.size());
    std::iota(many_.begin(), many_.end(), 0U);
    std::sort(many_.begin(), many_.end(),
              [&](std::uint32_t i, std::uint32_t k) {
                return ranks_before(star, i, k);
              });
    const std::size_t closing = add_until_closed(star);
    if (closing == many_.size()) return {};
    if (settle_ties(star, many_, closing)) add_until_closed(star);
    const std::vector<std::uint8_t>& stays = graph_.peel();
    std::size_t n_on_cycle = 0;
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k] != 0) many_[n_on_cycle++] = many_[k];
    return std::span(many_).first(n_on_cycle);
  }

  /// Of the triangles in many_, to graph_. @return the place of the one that
  ///   closes a cycle, or their number
  std::size_t add_until_closed(const Star& star) {
    graph_.clear();
    const auto closing = std::find_if(
        many_.begin(), many_.end(),
        [&](std::uint32_t i) { return graph_.add(star.triangles[i].edge); });
    return static_cast<std::size_t>(closing - many_.begin());
  }

  const RankedTriangles& triangles_;
  CycleCheck check_;
  FirstCycle few_;
  LinkGraph graph_;
  std::array<std::uint32_t, kFew> order_ = {};     // positions, by rank
  std::array<std::uint32_t, kFew> unsorted_ = {};  // positions
  std::vector<std::uint32_t> many_;
};

}  // namespace

FilterResult umbrella_filter(std::size_t n_vertices, RankedTriangles triangles,
                             unsigned threads) {
  return filter_by_vertex(n_vertices, std::move(triangles), threads,
                          [&](const RankedTriangles& all) {
                            return UmbrellaPicker(n_vertices, all);
                          });
}

}  // namespace umbrella
