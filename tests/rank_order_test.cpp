#include "umbrella/rank_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "tests/support/complexes.h"
#include "umbrella/clean_up.h"
#include "umbrella/filter.h"

namespace umbrella {
namespace {

/// Ranks that are known exactly, and the triangles that have them rounded:
/// triangle i has facet i.
struct Ranks {
  std::vector<ExactRank> exact;
  std::vector<RankedTriangle> rounded;

  void add(const ExactRank& rank, const Rank& near) {
    const auto i = static_cast<std::uint32_t>(exact.size());
    exact.push_back(rank);
    rounded.push_back({{VertexId{i}, VertexId{i + 1}, VertexId{i + 2}},
                       delaunay::Facet(delaunay::CellId{i}, 0),
                       near});
  }

  std::size_t number(const RankedTriangle& t) const {
    return static_cast<std::size_t>(t.facet.cell());
  }
  const ExactRank& exact_of(const RankedTriangle& t) const {
    return exact[number(t)];
  }

  /// @param n_asked  counts the exact ranks that were asked for
  RankedTriangles with_order(std::size_t& n_asked) const {
    return RankedTriangles(rounded,
                           RankOrder([this, &n_asked](delaunay::Facet facet) {
                             ++n_asked;
                             return exact[index(facet.cell())];
                           }));
  }
};

/// n / d 2^exponent, computed with an error below kNearTie / 2.
double blurred(std::int64_t n, std::int64_t d, int exponent,
               std::mt19937_64& rng) {
  std::uniform_real_distribution<double> error(-0.49, 0.49);
  return std::ldexp(static_cast<double>(n) / static_cast<double>(d), exponent) *
         (1 + error(rng) * kNearTie);
}

/// Clusters of up to four numbers that doubles so blurred cannot tell apart,
/// some of them equal, on a wide scale.
Ranks clusters(int n_clusters, std::mt19937_64& rng) {
  Ranks ranks;
  for (int k = 0; k < n_clusters; ++k) {
    const auto base =
        static_cast<std::int64_t>((1ULL << 45U) + rng() % (1ULL << 45U));
    const auto d = static_cast<std::int64_t>(1 + rng() % 1'000'000);
    const int exponent = static_cast<int>(rng() % 200) - 100;
    for (std::uint64_t i = 0, n = 1 + rng() % 4; i < n; ++i) {
      const auto above = base + static_cast<std::int64_t>(
                                    rng() % 3 == 0 ? 0 : rng() % (1U << 14U));
      const auto second = static_cast<std::int64_t>(rng() % 3);
      ranks.add(
          {ExactRatio(above, d, exponent), ExactRatio(second, 1, 0)},
          {blurred(above, d, exponent, rng), static_cast<double>(second)});
    }
  }
  return ranks;
}

/// Of all neighbours once they are sorted, one comparison after another.
void expect_exact_order(const Ranks& ranks, const RankedTriangles& triangles) {
  const RankOrder& order = triangles.order();
  const std::vector<RankedTriangle> sorted = tests::in_order(triangles);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const RankedTriangle &a = sorted[i - 1], &b = sorted[i];
    SCOPED_TRACE(testing::Message() << "triangles " << ranks.number(a)
                                    << " and " << ranks.number(b));
    const int exact = compare(ranks.exact_of(a), ranks.exact_of(b));
    EXPECT_LE(exact, 0);
    EXPECT_EQ(order.compare_ranks(a, b), exact);
    EXPECT_EQ(order.compare_ranks(b, a), -exact);
    EXPECT_TRUE(exact != 0 || a.corners < b.corners);
  }
}

/// All at once, each asked once.
///
/// @param n_asked  as the order counts
void expect_same_order_at_once(const RankedTriangles& triangles,
                               const std::size_t& n_asked) {
  std::vector<TriangleIndex> at_once(triangles.size());
  std::iota(at_once.begin(), at_once.end(), TriangleIndex{0});
  std::vector<TriangleIndex> one_by_one = at_once;
  std::sort(one_by_one.begin(), one_by_one.end(),
            [&](TriangleIndex a, TriangleIndex b) {
              return triangles.order().before(triangles[a], triangles[b]);
            });
  const std::size_t n_before = n_asked;
  triangles.order().sort(
      at_once,
      [&](TriangleIndex t) -> const RankedTriangle& { return triangles[t]; });
  EXPECT_EQ(at_once, one_by_one);
  EXPECT_EQ(n_asked - n_before, triangles.size());
}

/// @return how many exact ranks one comparison after another has asked for
std::size_t expect_exact_order_either_way(const Ranks& ranks) {
  std::size_t n_asked = 0;
  const RankedTriangles triangles = ranks.with_order(n_asked);
  expect_exact_order(ranks, triangles);
  const std::size_t n_one_by_one = n_asked;
  expect_same_order_at_once(triangles, n_asked);
  return n_one_by_one;
}

TEST(RankOrder, GivesNearNumbersTheOrderOfTheExactOnes) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Ranks ranks = clusters(1000, rng);
    EXPECT_GT(expect_exact_order_either_way(ranks), 1000U);
  }
}

TEST(RankOrder, OrdersTheSecondariesAtZero) {
  std::mt19937_64 rng(7);
  Ranks ranks;
  for (int i = 0; i < 2000; ++i) {
    const auto n = static_cast<std::int64_t>(
        (1ULL << 45U) + (rng() % 100 << 30U) + rng() % (1U << 12U) / 4 * 4);
    ranks.add({ExactRatio(), ExactRatio(n, 3, 0)}, {0, blurred(n, 3, 0, rng)});
  }
  EXPECT_GT(expect_exact_order_either_way(ranks), 0U);
}

TEST(RankOrder, AsksNothingWhereAllStandApart) {
  Ranks ranks;
  for (int i = 1; i <= 1000; ++i)
    ranks.add({ExactRatio(i, 1, 0), ExactRatio()},
              {static_cast<double>(i), static_cast<double>(i % 7)});
  std::size_t n_asked = 0;
  expect_exact_order(ranks, ranks.with_order(n_asked));
  EXPECT_EQ(n_asked, 0U);
}

TEST(RankOrder, ComparesInfiniteRanksExactly) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Ranks ranks;
  for (const std::int64_t n : {3, 1, 2})
    ranks.add({ExactRatio(), ExactRatio(n, 1, 1100)}, {0, kInfinity});
  std::size_t n_asked = 0;
  expect_exact_order(ranks, ranks.with_order(n_asked));
}

TEST(RankOrder, TakesRanksAsTheyAreWithoutExactOnes) {
  Ranks ranks;
  for (int i = 0; i < 100; ++i)
    ranks.add({}, {1 + std::ldexp(i * 37 % 100, -52), 0});
  const RankedTriangles triangles(ranks.rounded);
  std::vector<TriangleIndex> sorted(triangles.size());
  std::iota(sorted.begin(), sorted.end(), TriangleIndex{0});
  triangles.order().sort(sorted, [&](TriangleIndex t) -> const RankedTriangle& {
    return triangles[t];
  });
  for (std::size_t i = 1; i < sorted.size(); ++i)
    EXPECT_LT(triangles[sorted[i - 1]].rank, triangles[sorted[i]].rank);
}

/// Triangles of few points with ranks in clusters, which doubles tell apart,
/// but not the ranks within one. Some primaries are zero.
struct Blurred {
  std::vector<RankedTriangle> rounded;
  std::vector<RankedTriangle> plain;  ///< places in the exact order for ranks

  /// @param scale  of the rounded primaries, a power of two
  Blurred(std::size_t n_vertices, double part, double scale,
          std::mt19937_64& rng)
      : rounded(tests::random_complex(n_vertices, part, rng())) {
    // Half way between two floats: near ranks may differ there.
    constexpr std::int64_t kBase = (1LL << 50U) + (1LL << 26U);
    const std::uint64_t n_clusters = 1 + rng() % 8;
    const auto number = [&] {
      return kBase +
             static_cast<std::int64_t>((rng() % n_clusters << 19U) + rng() % 6);
    };
    for (std::uint32_t i = 0; i < rounded.size(); ++i) {
      exact.push_back({rng() % 4 == 0 ? 0 : number(), number()});
      rounded[i].facet = delaunay::Facet(delaunay::CellId{i}, 0);
      rounded[i].rank = {scale * blurred(exact[i][0], 1, 0, rng),
                         blurred(exact[i][1], 1, 0, rng)};
    }
    plain = rounded;
    for (std::uint32_t i = 0; i < rounded.size(); ++i)
      plain[i].rank = {static_cast<double>(std::ranges::count_if(
                           exact, [&](const auto& e) { return e < exact[i]; })),
                       0};
  }
  RankedTriangles with_order() const {
    return RankedTriangles(
        rounded, RankOrder([this](delaunay::Facet facet) {
          const auto& [n, m] = exact[index(facet.cell())];
          return ExactRank{ExactRatio(n, 1, 0), ExactRatio(m, 1, 0)};
        }));
  }

 private:
  std::vector<std::array<std::int64_t, 2>> exact;
};

std::vector<Triangle> corners_of(std::span<const RankedTriangle> triangles) {
  std::vector<Triangle> result;
  for (const RankedTriangle& t : triangles) result.push_back(t.corners);
  return result;
}

TEST(RankOrder, DecidesWhatTheFilterTakes) {
  std::mt19937_64 rng(11);
  std::size_t n_different = 0;
  // Few triangles at a vertex, and so many that they are sorted. The last two
  // scales are too small and too large for a float.
  constexpr std::array kScales = {1.0, 0x1p-190, 0x1p+900};
  for (const std::size_t n_vertices : {7, 12})
    for (int trial = 0; trial < 300; ++trial) {
      SCOPED_TRACE(testing::Message() << n_vertices << " points, " << trial);
      const Blurred ranks(n_vertices, 0.7, kScales[trial % 3], rng);
      const auto exact =
          umbrella_filter(n_vertices, RankedTriangles(ranks.plain));
      const auto found = umbrella_filter(n_vertices, ranks.with_order());
      const auto rounded =
          umbrella_filter(n_vertices, RankedTriangles(ranks.rounded));
      EXPECT_EQ(corners_of(found.triangles), corners_of(exact.triangles));
      n_different +=
          corners_of(rounded.triangles) != corners_of(exact.triangles) ? 1 : 0;
    }
  EXPECT_GT(n_different, 100U);
}

TEST(RankOrder, DecidesWhatTheCleanUpDeletes) {
  constexpr std::size_t kVertices = 9;
  std::mt19937_64 rng(13);
  std::size_t n_different = 0;
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Blurred ranks(kVertices, 0.4, 1, rng);
    const auto exact = clean_up(kVertices, RankedTriangles(ranks.plain));
    const auto found = clean_up(kVertices, ranks.with_order());
    const auto rounded = clean_up(kVertices, RankedTriangles(ranks.rounded));
    EXPECT_EQ(corners_of(found.deleted), corners_of(exact.deleted));
    n_different +=
        corners_of(rounded.deleted) != corners_of(exact.deleted) ? 1 : 0;
  }
  EXPECT_GT(n_different, 20U);
}

}  // namespace
}  // namespace umbrella
