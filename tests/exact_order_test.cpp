#include "umbrella/exact_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

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

  std::vector<RankedTriangle> ordered(std::size_t& n_asked) const {
    std::vector<RankedTriangle> result = rounded;
    order_exactly(result, [&](delaunay::Facet facet) {
      ++n_asked;
      return exact[static_cast<std::size_t>(facet.cell())];
    });
    return result;
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

void expect_exact_order(const Ranks& ranks,
                        std::vector<RankedTriangle> triangles) {
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const RankedTriangle& a, const RankedTriangle& b) {
                     return a.rank < b.rank;
                   });
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    const RankedTriangle &a = triangles[i - 1], &b = triangles[i];
    const int order = compare(ranks.exact_of(a), ranks.exact_of(b));
    EXPECT_LE(order, 0) << "triangles " << ranks.number(a) << " and "
                        << ranks.number(b);
    EXPECT_EQ(a.rank == b.rank, order == 0);
  }
}

TEST(OrderExactly, GivesNearNumbersTheOrderOfTheExactOnes) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Ranks ranks = clusters(1000, rng);
    std::size_t n_asked = 0;
    const auto triangles = ranks.ordered(n_asked);
    expect_exact_order(ranks, triangles);
    EXPECT_GT(n_asked, 1000U);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      EXPECT_EQ(triangles[i].facet, ranks.rounded[i].facet);
      EXPECT_NEAR(triangles[i].rank.primary / ranks.rounded[i].rank.primary, 1,
                  kNearTie);
    }
  }
}

TEST(OrderExactly, OrdersTheSecondariesAtZero) {
  std::mt19937_64 rng(7);
  Ranks ranks;
  for (int i = 0; i < 2000; ++i) {
    const auto n = static_cast<std::int64_t>(
        (1ULL << 45U) + (rng() % 100 << 30U) + rng() % (1U << 12U) / 4 * 4);
    ranks.add({ExactRatio(), ExactRatio(n, 3, 0)}, {0, blurred(n, 3, 0, rng)});
  }
  std::size_t n_asked = 0;
  expect_exact_order(ranks, ranks.ordered(n_asked));
}

TEST(OrderExactly, AsksNothingWhereAllStandApart) {
  Ranks ranks;
  for (int i = 1; i <= 1000; ++i)
    ranks.add({ExactRatio(i, 1, 0), ExactRatio()},
              {static_cast<double>(i), static_cast<double>(i % 7)});
  std::size_t n_asked = 0;
  const auto triangles = ranks.ordered(n_asked);
  EXPECT_EQ(n_asked, 0U);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    EXPECT_EQ(triangles[i].rank, ranks.rounded[i].rank);
}

}  // namespace
}  // namespace umbrella
