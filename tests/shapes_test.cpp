#include "apps/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "apps/shapes_internal.h"

namespace {

using Eigen::Vector3d;

using Row = std::tuple<double, double, double>;
Row row(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

double nearest(const std::vector<Vector3d>& points, std::size_t i) {
  double d = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < points.size(); ++k)
    if (k != i) d = std::min(d, (points[i] - points[k]).norm());
  return d;
}

TEST(Shapes, GiveDistinctFinitePointsOfTheirDimension) {
  for (const shapes::Shape& shape : shapes::all()) {
    for (const std::size_t n : {0U, 1U, 2U, 7U, 300U}) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(n));
      const auto points = shapes::sample(shape.name, n);
      ASSERT_EQ(points.size(), n);
      std::set<Row> distinct;
      for (const Vector3d& p : points) {
        EXPECT_TRUE(p.allFinite());
        EXPECT_TRUE(shape.dimension == 3 || p.z() == 0);
        distinct.insert(row(p));
      }
      EXPECT_EQ(distinct.size(), n);
    }
  }
}

TEST(Shapes, DependOnTheSeedAndNothingElse) {
  for (const shapes::Shape& shape : shapes::all()) {
    SCOPED_TRACE(shape.name);
    const auto one = shapes::sample(shape.name, 100, {.seed = 1});
    EXPECT_EQ(one, shapes::sample(shape.name, 100, {.seed = 1}));
    const auto two = shapes::sample(shape.name, 100, {.seed = 2});
    EXPECT_EQ(one == two, shape.name == "grid");
  }
}

// The sum over the bits of a sample: changes if any machine or compiler
// computes one bit differently.
TEST(Shapes, AreTheSameOnEveryMachine) {
  std::uint64_t sum = 0;
  for (const shapes::Shape& shape : shapes::all())
    for (const Vector3d& p : shapes::sample(shape.name, 500, {.noise = 0.01}))
      for (const double x : p)
        sum = sum * 0x9E37'79B9'7F4A'7C15U + std::bit_cast<std::uint64_t>(x);
  EXPECT_EQ(sum, 11728549620591548667U);
}

TEST(Shapes, RefuseUnknownNamesAndBadNoise) {
  EXPECT_THROW(shapes::sample("klein-bottle", 10), std::invalid_argument);
  EXPECT_THROW(shapes::sample("sphere", 10, {.noise = -1}),
               std::invalid_argument);
  EXPECT_THROW(shapes::sample("sphere", 10, {.noise = std::nan("")}),
               std::invalid_argument);
}

TEST(Shapes, KeepTheirPointsApart) {
  for (const auto& [name, area] :
       {std::pair("sphere", 4 * std::numbers::pi), std::pair("cube", 6.0),
        std::pair("torus", 1.6 * std::numbers::pi * std::numbers::pi)}) {
    SCOPED_TRACE(name);
    const auto points = shapes::sample(name, 1000);
    const double hexagonal = std::sqrt(area / 1000 * 2 / std::sqrt(3.0));
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_GT(nearest(points, i), 0.55 * hexagonal);
      EXPECT_LT(nearest(points, i), 1.5 * hexagonal);
    }
  }
}

TEST(Shapes, NoiseMovesPointsByAPartOfTheirDistance) {
  const auto still = shapes::sample("sphere", 500, {.noise = 0});
  const auto moved = shapes::sample("sphere", 500, {.noise = 0.1});
  double largest = 0;
  for (std::size_t i = 0; i < still.size(); ++i)
    largest = std::max(largest, (moved[i] - still[i]).norm());
  EXPECT_GT(largest, 0.1 * 0.05);
  EXPECT_LT(largest, 0.1 * std::sqrt(3.0) * 0.15);
}

// All strands of the knot are at least the tube's radius from each other: no
// point is nearer to another part of the core than to its own.
TEST(Shapes, KnotIsATubeThatDoesNotTouchItself) {
  constexpr int kSteps = 2000;
  std::vector<Vector3d> core;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * std::numbers::pi * i / kSteps;
    const double p = 1 + 0.5 * std::cos(3 * t);
    core.push_back(
        {p * std::cos(2 * t), p * std::sin(2 * t), 0.5 * std::sin(3 * t)});
  }
  for (const Vector3d& p : shapes::sample("knot", 500, {.noise = 0})) {
    double d = std::numeric_limits<double>::infinity();
    for (const Vector3d& c : core) d = std::min(d, (p - c).norm());
    EXPECT_NEAR(d, 0.2, 1e-4);
  }
}

TEST(Shapes, ThreeHolesLiesOnItsEquation) {
  for (const Vector3d& p : shapes::sample("3holes", 500)) {
    double sum = 0;
    for (const double center : {-2.2, 0.0, 2.2}) {
      const double off = std::hypot(p.x() - center, p.y()) - 1;
      sum += std::pow(0.42 / std::hypot(off, p.z()), 4);
    }
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(Shapes, CosphericalPointsAreExactlyOnOneSphere) {
  const auto points = shapes::sample("cospherical", 2000);
  for (const Vector3d& p : points) {
    for (const double x : p) EXPECT_EQ(x, std::floor(x));
    EXPECT_EQ(p.squaredNorm(), points[0].squaredNorm());  // integers: exact
  }
}

TEST(Shapes, GridIsTheLattice) {
  const auto points = shapes::sample("grid", 27);
  std::set<Row> expected;
  for (int i = 0; i < 27; ++i) expected.insert({i / 9, i / 3 % 3, i % 3});
  std::set<Row> found;
  for (const Vector3d& p : points) found.insert(row(p));
  EXPECT_EQ(found, expected);
}

TEST(Turn, AgreesWithTheLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const double t = i / 3200.0;
    SCOPED_TRACE(t);
    const shapes::Turn turn = shapes::turn(t);
    EXPECT_NEAR(turn.cos, std::cos(2 * std::numbers::pi * t), 4e-15);
    EXPECT_NEAR(turn.sin, std::sin(2 * std::numbers::pi * t), 4e-15);
  }
  EXPECT_EQ(shapes::turn(0.25).sin, 1);
  EXPECT_EQ(shapes::turn(0.5).sin, 0);
}

}  // namespace
