#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "apps/shapes.h"
#include "tests/support/point_sets.h"
#include "umbrella/ranges.h"
#include "umbrella/reconstruct.h"
#include "umbrella/umbrella_choice.h"

namespace umbrella {
namespace {

using tests::Family;

TEST(ForRanges, MakesUpTheWholeInOrder) {
  for (const std::size_t n : {0U, 1U, 2U, 7U, 1000U})
    for (const unsigned threads :
         {0U, 1U, 2U, 3U, 8U, std::numeric_limits<unsigned>::max()}) {
      SCOPED_TRACE(testing::Message() << n << ", " << threads << " threads");
      const auto parts = for_ranges(n, threads, [](IndexRange range) {
        std::vector<std::size_t> indices;
        for (std::size_t i = range.begin; i < range.end; ++i)
          indices.push_back(i);
        return indices;
      });
      EXPECT_GE(parts.size(), 1U);
      EXPECT_LE(parts.size(), std::max(1U, threads));
      const auto all = joined(parts);
      ASSERT_EQ(all.size(), n);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(all[i], i);
    }
}

ReconstructOptions limited() {
  ReconstructOptions options;
  options.closing.conflicts = 200;  // not seconds: they depend on timing
  return options;
}

void expect_equal(const Reconstruction& result,
                  const Reconstruction& expected) {
  EXPECT_EQ(result.triangles, expected.triangles);
  EXPECT_EQ(result.lambda, expected.lambda);
  EXPECT_TRUE(result.counts == expected.counts);
  EXPECT_EQ(result.dropped_rows, expected.dropped_rows);
  EXPECT_EQ(result.drop_reasons, expected.drop_reasons);
  EXPECT_EQ(result.closing.regions, expected.closing.regions);
  EXPECT_EQ(result.closing.variables, expected.closing.variables);
  EXPECT_EQ(result.closing.feasible, expected.closing.feasible);
  EXPECT_EQ(result.closing.grown, expected.closing.grown);
  EXPECT_EQ(result.closing.infeasible, expected.closing.infeasible);
  EXPECT_EQ(result.closing.undecided, expected.closing.undecided);
  EXPECT_EQ(result.closing.conflicts, expected.closing.conflicts);
  EXPECT_EQ(result.surface.euler, expected.surface.euler);
  EXPECT_EQ(result.surface.unused_vertices, expected.surface.unused_vertices);
}

/// @return how many triangles there are
std::size_t expect_same_on_any_number_of_threads(
    const std::vector<Point3>& points, ReconstructOptions options) {
  options.threads = 1;
  const Reconstruction expected = reconstruct(points, options);
  for (const unsigned threads : {2U, 3U, 8U}) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    options.threads = threads;
    expect_equal(reconstruct(points, options), expected);
  }
  return expected.triangles.size();
}

/// Enough points for a triangulation on two threads: its cells then have other
/// numbers.
constexpr std::size_t kManyPoints = 10'000;

TEST(ReconstructThreads, GiveTheSameSurfaceOfANoisyKnot) {
  EXPECT_GT(expect_same_on_any_number_of_threads(
                shapes::sample("knot", kManyPoints, {}), limited()),
            kManyPoints);
}

TEST(ReconstructThreads, GiveTheSameTrianglesOfAGrid) {
  // All ranks tie.
  ReconstructOptions options = limited();
  options.stage = Stage::Clean;
  EXPECT_GT(expect_same_on_any_number_of_threads(
                tests::make_points<3>(Family::Grid, kManyPoints, 1), options),
            0U);
}

TEST(ReconstructThreads, GiveTheSameUmbrellasByEveryChoice) {
  const auto points = shapes::sample("torus", 400, {.noise = 0.2});
  for (const UmbrellaChoice choice :
       {UmbrellaChoice::LeastSum, UmbrellaChoice::Flattest}) {
    ReconstructOptions options = limited();
    options.stage = Stage::Filter;
    options.umbrella = choice;
    EXPECT_GT(expect_same_on_any_number_of_threads(points, options), 400U);
  }
}

}  // namespace
}  // namespace umbrella
