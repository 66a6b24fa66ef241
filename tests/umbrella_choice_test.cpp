#include "umbrella/umbrella_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/support/complexes.h"

namespace umbrella {
namespace {

using tests::ranked;
using tests::vertex;

std::vector<Point3> random_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point3> points(n);
  for (Point3& p : points)
    for (double& x : p) x = unit(rng);
  return points;
}

/// All simple cycles of G_v by plain search.
void each_cycle(std::span<const RankedTriangle> triangles, VertexId v,
                const std::function<void(const std::vector<VertexId>&)>& use) {
  const tests::LinkEdges edges = tests::link(triangles, v);
  const auto joined = [&](VertexId p, VertexId q) {
    return std::count(edges.begin(), edges.end(), std::pair(p, q)) +
               std::count(edges.begin(), edges.end(), std::pair(q, p)) >
           0;
  };
  std::vector<VertexId> path;
  std::size_t n = 0;
  for (const auto& [p, q] : edges)
    n = std::max({n, index(p) + 1, index(q) + 1});
  const std::function<void()> extend = [&] {
    if (path.size() > 2 && joined(path.back(), path.front())) use(path);
    for (std::size_t i = index(path.front()) + 1; i < n; ++i)
      if (std::find(path.begin(), path.end(), vertex(i)) == path.end() &&
          joined(path.back(), vertex(i))) {
        path.push_back(vertex(i));
        extend();
        path.pop_back();
      }
  };
  for (std::size_t i = 0; i < n; ++i) {
    path = {vertex(i)};
    extend();
  }
}

/// The triangles at v, as if it were alone: no other vertex adds to them.
std::vector<RankedTriangle> star(std::span<const RankedTriangle> triangles,
                                 VertexId v) {
  std::vector<RankedTriangle> result(triangles.begin(), triangles.end());
  std::erase_if(result, [&](const RankedTriangle& t) {
    return std::find(t.corners.begin(), t.corners.end(), v) == t.corners.end();
  });
  return result;
}

/// The rim of the one umbrella that `triangles` are at v.
std::vector<VertexId> rim(std::span<const RankedTriangle> triangles,
                          VertexId v) {
  std::vector<VertexId> cycle;
  each_cycle(triangles, v,
             [&](const std::vector<VertexId>& found) { cycle = found; });
  return cycle;
}

/// A star of some points at one vertex: the rest of a random complex is left
/// out. Only that vertex can have an umbrella: every other edge of the star has
/// the vertex in it, so no cycle closes elsewhere unless it runs through it,
/// which G_p of a star does for a single edge each.
struct Star {
  std::vector<Point3> points;
  std::vector<RankedTriangle> triangles;
  VertexId center = vertex(4);
};

/// In 60 stars the umbrella chosen costs as little as any cycle.
void expect_least_of_all_cycles(
    UmbrellaChoice choice,
    const std::function<double(const Star&, const std::vector<VertexId>&)>&
        cost) {
  std::size_t n_found = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Star at = {random_points(9, trial), tests::random_complex(9, 0.35, trial)};
    at.triangles = star(at.triangles, at.center);
    const FilterResult result =
        umbrella_filter(at.points, RankedTriangles(at.triangles), choice);
    double least = std::numeric_limits<double>::infinity();
    each_cycle(at.triangles, at.center,
               [&](const std::vector<VertexId>& cycle) {
                 least = std::min(least, cost(at, cycle));
               });
    ASSERT_EQ(result.triangles.empty(), std::isinf(least));
    if (result.triangles.empty()) continue;
    EXPECT_TRUE(
        tests::is_simple_cycle(tests::link(result.triangles, at.center)));
    const auto cycle = rim(result.triangles, at.center);
    EXPECT_EQ(cycle.size(), result.triangles.size());
    EXPECT_NEAR(cost(at, cycle), least, 1e-9);
    ++n_found;
  }
  EXPECT_GT(n_found, 20U);
}

double sum_of_ranks(const Star& at, const std::vector<VertexId>& cycle) {
  double sum = 0;
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    Triangle abc = {at.center, cycle[i], cycle[(i + 1) % cycle.size()]};
    std::sort(abc.begin(), abc.end());
    for (const RankedTriangle& t : at.triangles)
      if (t.corners == abc) sum += t.rank.primary;
  }
  return sum;
}

TEST(UmbrellaChoice, LeastSumIsTheLeastOfAllCycles) {
  expect_least_of_all_cycles(UmbrellaChoice::LeastSum, sum_of_ranks);
}

double bending(const Star& star, const std::vector<VertexId>& cycle) {
  const auto at = [&](VertexId p) -> Point3 {
    return star.points[index(p)] - star.points[index(star.center)];
  };
  double sum = 0;
  const std::size_t n = cycle.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point3 axis = at(cycle[i]).normalized();
    Point3 before = at(cycle[(i + n - 1) % n]), after = at(cycle[(i + 1) % n]);
    before -= axis.dot(before) * axis;
    after -= axis.dot(after) * axis;
    sum += 1 + before.normalized().dot(after.normalized());
  }
  return sum;
}

TEST(UmbrellaChoice, FlattestBendsLeastOfAllCycles) {
  expect_least_of_all_cycles(UmbrellaChoice::Flattest, bending);
}

TEST(UmbrellaChoice, FlattestPrefersTheDiscToTheTip) {
  // A hexagon around 0, and two points above that close a cheap tip with it.
  std::vector<Point3> points = {Point3::Zero()};
  std::vector<RankedTriangle> triangles;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
    triangles.push_back(ranked(0, 1 + k, 1 + (k + 1) % 6, 1));
  }
  points.emplace_back(0.5, 0.3, 1);
  triangles.push_back(ranked(0, 1, 7, 0.5));
  triangles.push_back(ranked(0, 2, 7, 0.5));
  const auto rim_of = [&](UmbrellaChoice choice) {
    return rim(
        umbrella_filter(points, RankedTriangles(triangles), choice).triangles,
        vertex(0));
  };
  EXPECT_EQ(rim_of(UmbrellaChoice::Flattest).size(), 6U);
  EXPECT_EQ(rim_of(UmbrellaChoice::LeastSum).size(), 3U);
}

// Flat, but for rounding: no cost may be negative, or the search runs in rings.
TEST(UmbrellaChoice, FlattestEndsOnAFlatDisc) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const Point3 u(unit(rng), unit(rng), unit(rng));
    const Point3 v(unit(rng), unit(rng), unit(rng));
    std::vector<Point3> points = {Point3::Zero()};
    std::vector<RankedTriangle> triangles;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4;
      points.push_back(std::cos(angle) * u + std::sin(angle) * v);
      triangles.push_back(ranked(0, 1 + k, 1 + (k + 1) % 8, 1));
      triangles.push_back(ranked(0, 1 + k, 1 + (k + 2) % 8, 1));
    }
    const auto chosen = umbrella_filter(points, RankedTriangles(triangles),
                                        UmbrellaChoice::Flattest);
    const auto at_center = star(chosen.triangles, vertex(0));
    EXPECT_LT(
        bending({points, at_center, vertex(0)}, rim(at_center, vertex(0))),
        1e-9);
  }
}

TEST(UmbrellaChoice, FirstIsTheFilter) {
  const auto points = random_points(12, 3);
  const auto triangles = tests::random_complex(12, 0.2, 3);
  const auto chosen = umbrella_filter(points, RankedTriangles(triangles),
                                      UmbrellaChoice::First);
  const auto filtered = umbrella_filter(12, RankedTriangles(triangles));
  ASSERT_EQ(chosen.triangles.size(), filtered.triangles.size());
  EXPECT_EQ(chosen.without_umbrella, filtered.without_umbrella);
}

// Which vertices have an umbrella does not depend on which is chosen.
TEST(UmbrellaChoice, LeavesTheSameVerticesWithoutOne) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto points = random_points(12, trial);
    const auto triangles = tests::random_complex(12, 0.08, trial);
    const auto expected =
        umbrella_filter(12, RankedTriangles(triangles)).without_umbrella;
    for (const auto choice :
         {UmbrellaChoice::LeastSum, UmbrellaChoice::Flattest})
      EXPECT_EQ(umbrella_filter(points, RankedTriangles(triangles), choice)
                    .without_umbrella,
                expected);
  }
}

TEST(UmbrellaChoice, IsFoundByName) {
  EXPECT_EQ(umbrella_choice("first"), UmbrellaChoice::First);
  EXPECT_EQ(umbrella_choice("least-sum"), UmbrellaChoice::LeastSum);
  EXPECT_EQ(umbrella_choice("flattest"), UmbrellaChoice::Flattest);
  EXPECT_THROW(umbrella_choice("last"), std::invalid_argument);
}

}  // namespace
}  // namespace umbrella
