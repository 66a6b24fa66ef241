#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/point_groups_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

/// A sphere and one of half its radius, as densely sampled and with noise, some
/// spacings apart. The large one first.
constexpr std::size_t kLarge = 1200, kSmall = kLarge / 4;

std::vector<Point3> two_spheres(double gap, std::uint64_t seed) {
  const double spacing =
      std::sqrt(4 * std::numbers::pi / static_cast<double>(kLarge));
  std::vector<Point3> points;
  for (Point3 p :
       shapes::sample("sphere", kLarge, {.seed = seed, .noise = 0.2}))
    points.push_back(p);
  for (Point3 p :
       shapes::sample("sphere", kSmall, {.seed = seed, .noise = 0.2}))
    points.emplace_back(p / 2 + Point3(1.5 + gap * spacing, 0.01, 0.02));
  return points;
}

TEST(PointGroups, ArePartedByGapsOnly) {
  for (const double gap : {0.5, 4.0}) {
    SCOPED_TRACE(testing::Message() << "gap " << gap);
    const delaunay::Triangulation3 triangulation(two_spheres(gap, 3));
    const auto ranked = ranked_triangles(triangulation);
    const auto filtered =
        umbrella_filter(triangulation.points().size(), ranked);
    PointGroups groups(triangulation, filtered.triangles);
    const auto rows = triangulation.vertex_of_row();
    const std::size_t n_all = kLarge + kSmall;
    EXPECT_EQ(groups.n_points_with(rows.first(1)), gap > 1 ? kLarge : n_all);
    EXPECT_EQ(groups.n_points_with(rows.last(2)), gap > 1 ? kSmall : n_all);
    EXPECT_EQ(groups.n_points_with(std::array{rows.front(), rows.back()}),
              n_all);
  }
}

TEST(Topology, KeepsSpheresApartThatHaveAGapBetweenThem) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Reconstruction result = reconstruct(two_spheres(4, seed));
    EXPECT_GT(result.closing.regions, 0U);
    EXPECT_EQ(result.surface.components, 2U);
    EXPECT_EQ(result.surface.genus, 0);
    EXPECT_TRUE(result.surface.unused_vertices.empty());
  }
}

}  // namespace
}  // namespace umbrella
