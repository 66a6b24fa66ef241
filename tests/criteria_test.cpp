#include "umbrella/criteria.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/support/complexes.h"
#include "tests/support/point_sets.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;

/// Of balls of radii R through a circle of radius r, by their centres at signed
/// heights over it: the definition.
double overlap(double r, double height_1, double height_2) {
  const double R1 = std::hypot(r, height_1), R2 = std::hypot(r, height_2);
  return (R1 + R2 - std::abs(height_1 - height_2)) / std::min(R1, R2);
}

double squared_lambda(double r, double height) {
  const double R = std::hypot(r, height);
  return (r / R) * (r / R);
}

TEST(IntersectionRatio, IsTheOverlapOfTheBallsOverTheSmallerRadius) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> height(-3, 3), radius(0.1, 3);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double r = radius(rng), h1 = height(rng), h2 = height(rng);
    const bool is_gabriel = (h1 <= 0) != (h2 <= 0);
    const double ratio = intersection_ratio(
        {squared_lambda(r, h1), squared_lambda(r, h2)}, is_gabriel);
    EXPECT_NEAR(ratio, overlap(r, h1, h2), 1e-9);
    EXPECT_GE(ratio, 0);
    EXPECT_LE(ratio, 2 + 1e-12);
  }
}

TEST(IntersectionRatio, TakesAHalfSpaceForTheBallBeyondTheHull) {
  for (const double h : {0.1, 1.0, 5.0}) {
    SCOPED_TRACE(h);
    const double lambda2 = squared_lambda(1, h);
    EXPECT_NEAR(intersection_ratio({0, lambda2}, true), overlap(1, h, -1e7),
                1e-6);
    EXPECT_NEAR(intersection_ratio({lambda2, 0}, false), overlap(1, h, 1e7),
                1e-6);
  }
}

RankedTriangles ranked(std::string_view criterion, const Triangulation3& t) {
  return ranked_by(criterion, t, Circumspheres(t));
}

std::vector<Triangle> corners(std::span<const RankedTriangle> triangles) {
  std::vector<Triangle> result;
  for (const RankedTriangle& t : triangles) result.push_back(t.corners);
  return result;
}

TEST(Criteria, WithoutGabrielAdmitEveryDelaunayTriangleInThePapersOrder) {
  const Triangulation3 t(tests::make_points<3>(Family::Uniform, 60, 4));
  const auto all = tests::in_order(ranked("no-gabriel", t));
  EXPECT_EQ(all.size(), facets(t).size());
  const auto gabriel = tests::in_order(ranked("paper", t));
  EXPECT_LT(gabriel.size(), all.size());
  const std::vector<Triangle> kept = corners(gabriel);
  std::vector<Triangle> filtered;
  for (const Triangle& triangle : corners(all))
    if (std::find(kept.begin(), kept.end(), triangle) != kept.end())
      filtered.push_back(triangle);
  EXPECT_EQ(filtered, kept);
}

TEST(Criteria, MixedRanksByTheProductOfLambdaAndRadius) {
  const Triangulation3 t(tests::make_points<3>(Family::Uniform, 60, 4));
  const Circumspheres spheres(t);
  std::size_t n_inside = 0;
  for (const RankedTriangle& ranked : ranked_by("mixed", t, spheres)) {
    const DelaunayTriangle triangle(t, spheres, ranked.facet);
    const double product =
        triangle.lambda().lower * triangle.circumradius() * spheres.scale();
    EXPECT_NEAR(ranked.rank.primary, product * product, 1e-9 * product);
    EXPECT_EQ(ranked.rank.primary == 0, triangle.on_hull());
    n_inside += triangle.on_hull() ? 0 : 1;
  }
  EXPECT_GT(n_inside, 20U);
}

TEST(Criteria, MixedWithOnePowerAloneIsThePapersOrCircumradius) {
  const Triangulation3 t(tests::make_points<3>(Family::Uniform, 60, 8));
  const auto order = [&](auto criterion) {
    return corners(tests::in_order(ranked_triangles(t, criterion)));
  };
  EXPECT_EQ(order(MixedCriterion{1, 0}), order(PaperCriterion{}));
  EXPECT_EQ(order(MixedCriterion{0, 1}), order(CircumradiusCriterion{}));
  EXPECT_NE(order(MixedCriterion{1, 1}), order(PaperCriterion{}));
}

TEST(Criteria, GiveRanksThatSort) {
  for (const Family family : tests::kFamilies) {
    const Triangulation3 t(tests::make_points<3>(family, 10, 3));
    for (const std::string_view name : criterion_names()) {
      SCOPED_TRACE(testing::Message() << tests::name(family) << ' ' << name);
      for (const RankedTriangle& triangle : ranked(name, t)) {
        EXPECT_GE(triangle.rank.primary, 0);  // false for NaN
        EXPECT_GE(triangle.rank.secondary, 0);
      }
    }
  }
}

TEST(Criteria, DoNotDependOnTheOrderOfThePoints) {
  std::mt19937_64 rng(9);
  auto points = tests::make_points<3>(Family::Uniform, 50, 1);
  const Triangulation3 before(points);
  std::shuffle(points.begin(), points.end(), rng);
  const Triangulation3 after(points);
  for (const std::string_view name : criterion_names()) {
    SCOPED_TRACE(name);
    const auto a = ranked(name, before), b = ranked(name, after);
    ASSERT_EQ(corners(a), corners(b));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].rank, b[i].rank);
  }
}

TEST(Criteria, WithUnknownNamesAreRefused) {
  EXPECT_THROW(require_criterion("papre"), std::invalid_argument);
  EXPECT_NO_THROW(require_criterion("paper"));
}

}  // namespace
}  // namespace umbrella
