#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/criterion.h"
#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/filter.h"
#include "umbrella/point_groups_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {
namespace {

/// The size of each vertex's group, by its definition.
std::vector<std::size_t> group_sizes(
    const delaunay::Triangulation3& triangulation,
    std::span<const RankedTriangle> triangles) {
  const std::size_t n = triangulation.points().size();
  const auto squared = [&](VertexId a, VertexId b) {
    return (triangulation.point(a) - triangulation.point(b)).squaredNorm();
  };
  std::vector<double> reach(n);
  for (const RankedTriangle& t : triangles)
    for (const VertexId a : t.corners)
      for (const VertexId b : t.corners)
        reach[index(a)] = std::max(reach[index(a)], 4 * squared(a, b));
  std::replace(reach.begin(), reach.end(), 0.0,
               *std::max_element(reach.begin(), reach.end()));
  DisjointSets sets(n);
  for (const delaunay::Cell& cell :
       triangulation.cells().first(triangulation.n_finite_cells()))
    for (const VertexId a : cell.vertex)
      for (const VertexId b : cell.vertex)
        if (squared(a, b) <= std::min(reach[index(a)], reach[index(b)]))
          sets.unite(index(a), index(b));
  std::vector<std::size_t> at_root(n), result(n);
  for (std::size_t v = 0; v < n; ++v) ++at_root[sets.root(v)];
  for (std::size_t v = 0; v < n; ++v) result[v] = at_root[sets.root(v)];
  return result;
}

TEST(PointGroups, AreThoseOfAllShortEdgesHoweverFewPointsAreApart) {
  std::mt19937_64 rng(4);
  constexpr std::size_t kPoints = 1500;
  const double spacing =
      std::sqrt(4 * std::numbers::pi / static_cast<double>(kPoints));
  for (int trial = 0; trial < 6; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto points = shapes::sample("sphere", kPoints, {.seed = 5, .noise = 0.2});
    for (int i = 0; i < 2 * trial; ++i)
      points.push_back((1 + i * spacing) *
                       points[40 * static_cast<unsigned>(i)]);
    const delaunay::Triangulation3 triangulation(points);
    const std::size_t n = triangulation.points().size();
    std::vector<RankedTriangle> kept;
    for (const RankedTriangle& t :
         umbrella_filter(n, ranked_triangles(triangulation)).triangles)
      if (index(t.corners[0]) >= 20 && rng() % 50 != 0) kept.push_back(t);
    const WorkingSurface surface(n, kept);
    PointGroups groups(triangulation, kept, surface);
    const std::vector<std::size_t> expected = group_sizes(triangulation, kept);
    for (std::uint32_t v = 0; v < n; ++v)
      ASSERT_EQ(groups.n_points_with(std::array{VertexId{v}}), expected[v]);
  }
}

}  // namespace
}  // namespace umbrella
