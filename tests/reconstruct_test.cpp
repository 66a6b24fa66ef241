#include "umbrella/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "tests/support/point_sets.h"

namespace umbrella {
namespace {

using tests::Family;

struct Sample {
  const char* shape;
  std::size_t n;
  std::int64_t genus;
};

TEST(Reconstruct, ClosesAnalyticShapes) {
  for (const auto& [shape, n, genus] :
       {Sample{"sphere", 500, 0}, Sample{"torus", 1000, 1},
        Sample{"ellipsoid", 800, 0}, Sample{"3holes", 4000, 3}}) {
    SCOPED_TRACE(shape);
    const auto result = reconstruct(shapes::sample(shape, n, {}));
    EXPECT_EQ(result.dimension, 3);
    EXPECT_EQ(result.surface.genus, genus);
    EXPECT_EQ(result.surface.components, 1U);
    EXPECT_EQ(result.surface.vertices, n);
    EXPECT_TRUE(result.surface.manifold && result.surface.outward);
    EXPECT_TRUE(result.surface.unused_vertices.empty());
    EXPECT_TRUE(result.dropped_rows.empty());
    EXPECT_EQ(result.lambda.size(), result.triangles.size());
    for (const double lambda : result.lambda)
      EXPECT_TRUE(lambda >= 0 && lambda <= 1);
  }
}

TEST(Reconstruct, DoesNotDependOnTheOrderOfTheRows) {
  std::mt19937_64 rng(8);
  auto points = shapes::sample("bumpy", 1200, {});
  const auto expected = reconstruct(points);
  std::vector<std::uint32_t> row(points.size());
  std::iota(row.begin(), row.end(), 0U);
  std::shuffle(row.begin(), row.end(), rng);
  const auto original = points;
  for (std::size_t i = 0; i < row.size(); ++i) points[i] = original[row[i]];
  auto result = reconstruct(points);
  for (auto& t : result.triangles)
    for (auto& v : t) v = row[v];
  EXPECT_EQ(result.triangles, expected.triangles);
  EXPECT_EQ(result.lambda, expected.lambda);
}

TEST(Reconstruct, NamesTheFirstOfEqualRows) {
  auto points = shapes::sample("sphere", 200, {});
  const auto expected = reconstruct(points);
  const auto original = points;
  points.insert(points.end(), original.begin(), original.end());
  points.push_back(original[7]);
  const auto result = reconstruct(points);
  EXPECT_EQ(result.counts.duplicates, 201U);
  EXPECT_EQ(result.triangles, expected.triangles);
  EXPECT_TRUE(result.surface.unused_vertices.empty());
}

TEST(Reconstruct, IsTheSameAtEveryPowerOfTwo) {
  const auto points = shapes::sample("torus", 500, {});
  const auto expected = reconstruct(points);
  for (const int exponent : {-900, -300, 300, 900}) {
    SCOPED_TRACE(exponent);
    auto scaled = points;
    for (Point3& p : scaled) p *= std::ldexp(1, exponent);
    const auto result = reconstruct(scaled);
    EXPECT_EQ(result.triangles, expected.triangles);
    EXPECT_EQ(result.lambda, expected.lambda);
  }
}

TEST(Reconstruct, StopsWhereItIsTold) {
  const auto points = shapes::sample("knot", 2000, {});
  std::vector<std::string> stages;
  const auto filtered = reconstruct(
      points, {.stage = Stage::Filter, .progress = [&](std::string_view name) {
                 stages.emplace_back(name);
               }});
  EXPECT_EQ(filtered.triangles.size(), filtered.counts.filter_triangles);
  const std::vector<std::string> expected = {
      "delaunay", "lambda", "lambda", "filter", "surface", "certificate"};
  EXPECT_EQ(stages, expected);
  const auto clean = reconstruct(points, {.stage = Stage::Clean});
  EXPECT_EQ(clean.triangles.size(), clean.counts.clean_triangles);
  EXPECT_EQ(clean.counts.filter_triangles,
            clean.counts.clean_triangles + clean.counts.deleted_type2 +
                clean.counts.deleted_type3 + clean.counts.dissolved);
  const auto closed = reconstruct(points);
  EXPECT_TRUE(closed.surface.closed);
}

TEST(Reconstruct, HasAnAnswerForEveryInput) {
  for (const Family family : tests::kFamilies)
    for (const std::size_t n : {0U, 1U, 2U, 3U, 4U, 5U, 30U}) {
      SCOPED_TRACE(testing::Message() << name(family) << " n " << n);
      ReconstructOptions options;
      options.closing.conflicts = 500;
      const auto result =
          reconstruct(tests::make_points<3>(family, n, 1), options);
      EXPECT_EQ(result.triangles.empty(), result.surface.triangles == 0);
      if (result.dimension < 3) {
        EXPECT_TRUE(result.triangles.empty());
      }
      if (result.closing.infeasible + result.closing.undecided == 0 &&
          !result.triangles.empty()) {
        EXPECT_TRUE(result.surface.closed && result.surface.manifold);
      }
    }
}

TEST(Reconstruct, KnowsItsCriteria) {
  const auto points = shapes::sample("sphere", 300, {});
  for (const std::string_view name : criterion_names()) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(reconstruct(points, {.criterion = name}).surface.closed);
  }
  EXPECT_THROW(reconstruct(points, {.criterion = "none"}),
               std::invalid_argument);
}

TEST(Reconstruct, RefusesWhatIsNoNumber) {
  auto points = shapes::sample("sphere", 50, {});
  points[17][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(reconstruct(points), std::invalid_argument);
}

}  // namespace
}  // namespace umbrella
