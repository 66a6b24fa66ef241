#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/exchange_internal.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;

/// Every triangle of a triangulation, in random order.
std::vector<LocatedTriangle> shuffled_triangles(const Triangulation3& t,
                                                std::mt19937_64& rng) {
  std::vector<LocatedTriangle> result;
  for (std::uint32_t i = 0; i < 4 * t.n_finite_cells(); ++i) {
    const delaunay::Facet facet(delaunay::CellId{i / 4}, i % 4);
    result.push_back({corners(t, facet), facet});
  }
  const auto before = [](const auto& a, const auto& b) {
    return a.corners < b.corners;
  };
  const auto same = [](const auto& a, const auto& b) {
    return a.corners == b.corners;
  };
  std::sort(result.begin(), result.end(), before);
  result.erase(std::unique(result.begin(), result.end(), same), result.end());
  std::shuffle(result.begin(), result.end(), rng);
  return result;
}

/// First those that go, then those that come, then some that stay.
struct Swap {
  std::vector<LocatedTriangle> going, coming, staying;

  Swap(const Triangulation3& t, std::mt19937_64& rng) {
    const std::vector<LocatedTriangle> all = shuffled_triangles(t, rng);
    const auto some = [&](std::size_t first) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(20 * first);
      return std::vector(begin, begin + 1 + static_cast<int>(rng() % 19));
    };
    going = some(0);
    coming = some(1);
    staying = some(2);
  }
};

Exchange exchanged(const Triangulation3& t, std::vector<LocatedTriangle> before,
                   std::vector<LocatedTriangle> after, CloseWeight weight) {
  const WorkingSurface surface(t.points().size(), before);
  Attempt attempt;
  attempt.chosen = std::move(after);
  for (TriangleIndex i = 0; i < before.size(); ++i) attempt.freed.push_back(i);
  return exchange_of(attempt, surface, Badness(t, weight));
}

void expect_laws(const Triangulation3& t, const Swap& swap,
                 CloseWeight weight) {
  const Exchange exchange = exchanged(t, swap.going, swap.coming, weight);
  const Badness badness(t, weight);
  double worst = 0, sum = 0;
  for (const auto& [triangle, facet] : swap.going) {
    const double above = badness(triangle, facet) - badness.least();
    worst = std::max(worst, above);
    sum += above;
  }
  EXPECT_EQ(exchange.worst_going, worst);
  EXPECT_NEAR(exchange.mean_going, sum / static_cast<double>(swap.going.size()),
              1e-12 * worst);
  EXPECT_GE(exchange.mean_coming, 0);

  const Exchange back = exchanged(t, swap.coming, swap.going, weight);
  EXPECT_EQ(back.mean_going, exchange.mean_coming);
  EXPECT_EQ(back.mean_coming, exchange.mean_going);

  auto before = swap.staying, after = swap.going;
  before.insert(before.end(), swap.coming.begin(), swap.coming.end());
  after.insert(after.end(), swap.staying.begin(), swap.staying.end());
  const Exchange with_others = exchanged(t, before, after, weight);
  EXPECT_EQ(with_others.mean_going, exchange.mean_coming);
  EXPECT_EQ(with_others.mean_coming, exchange.mean_going);
  EXPECT_EQ(with_others.worst_going, back.worst_going);
}

TEST(Exchange, CountsWhatIsOnOneSideOnly) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Triangulation3 t(
        shapes::sample("uniform", 40, {.seed = rng(), .noise = 0}));
    const Swap swap(t, rng);
    for (const CloseWeight weight :
         {CloseWeight::BallOverlap, CloseWeight::Circumradius,
          CloseWeight::LambdaLower, CloseWeight::Area})
      expect_laws(t, swap, weight);
  }
}

TEST(Exchange, IsNothingWhereNothingChanges) {
  std::mt19937_64 rng(20261123);
  const Triangulation3 t(
      shapes::sample("uniform", 40, {.seed = rng(), .noise = 0}));
  const Swap swap(t, rng);
  const Exchange none =
      exchanged(t, swap.staying, swap.staying, CloseWeight::BallOverlap);
  EXPECT_EQ(none.worst_going, 0);
  EXPECT_EQ(none.mean_going, 0);
  EXPECT_EQ(none.mean_coming, 0);
}

}  // namespace
}  // namespace umbrella
