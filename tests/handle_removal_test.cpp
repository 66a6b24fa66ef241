#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/clean_up.h"
#include "umbrella/closing.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/holes.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

/// Of a plate with noise as large as it is thick. Only loops of more than five
/// edges go round two of the handles.
TEST(HandleRemoval, CutsHandlesAtLongerLoops) {
  const Reconstruction result =
      reconstruct(shapes::sample("plate", 1000, {.seed = 20, .noise = 1.5}));
  EXPECT_EQ(result.closing.handles_removed, 11U);
  EXPECT_EQ(result.surface.genus, 0);
  EXPECT_EQ(result.surface.components, 1U);
  EXPECT_TRUE(result.surface.manifold && result.surface.outward);
  EXPECT_TRUE(result.surface.unused_vertices.empty());
}

/// Short loops go round these handles. Of ten samples each, eight, four and
/// eight kept them when only the worst triangle was asked.
TEST(HandleRemoval, KeepsHandlesOfFewPointsWithGoodTriangles) {
  for (const auto& [shape, n, genus, least] : {std::tuple{"torus", 90, 1, 10},
                                               {"3holes", 300, 3, 9},
                                               {"3holes", 400, 3, 10}}) {
    int n_right = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const std::vector<Point3> points = shapes::sample(
          shape, static_cast<std::size_t>(n), {.seed = seed, .noise = 0});
      n_right += reconstruct(points).surface.genus == genus ? 1 : 0;
    }
    EXPECT_GE(n_right, least) << shape << ", " << n << " points";
  }
}

TEST(HandleRemoval, AddsItsEffortToTheReport) {
  const delaunay::Triangulation3 triangulation(
      shapes::sample("plate", 1000, {.seed = 20, .noise = 1.5}));
  const std::size_t n = triangulation.points().size();
  const auto cleaned = clean_up(
      n, umbrella_filter(n, ranked_triangles(triangulation)).triangles);
  const auto close = [&](const ClosingOptions& options) {
    return close_holes(triangulation, cleaned.triangles,
                       find_holes(n, cleaned.triangles, cleaned.deleted,
                                  cleaned.without_umbrella),
                       options);
  };
  const ClosingOptions options = {.open_bores = false};
  ClosingResult before = close({.handle_edges = 0, .open_bores = false});
  const LocalRepair repair =
      repair_locally(triangulation, options, before.triangles);
  EXPECT_GT(repair.handles_removed, 0U);
  EXPECT_GT(repair.spent.conflicts, 0U);
  const ClosingReport after = close(options).report;
  EXPECT_EQ(after.conflicts, before.report.conflicts + repair.spent.conflicts);
  EXPECT_EQ(after.propagations,
            before.report.propagations + repair.spent.propagations);
}

/// Wherever it is up.
TEST(HandleRemoval, SaysThatTheTimeWasUp) {
  const auto points = shapes::sample("plate", 1000, {.seed = 20, .noise = 1.5});
  const Reconstruction whole = reconstruct(points);
  for (int part = 1; part <= 20; ++part) {
    SCOPED_TRACE(testing::Message() << "part " << part);
    ReconstructOptions options;
    options.closing.seconds = whole.seconds.closing * part / 20;
    const Reconstruction cut = reconstruct(points, options);
    EXPECT_TRUE(cut.surface.closed && cut.surface.manifold);
    EXPECT_TRUE(cut.closing.timed_out || cut.triangles == whole.triangles);
  }
}

}  // namespace
}  // namespace umbrella
