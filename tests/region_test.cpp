#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "umbrella/facets.h"
#include "umbrella/region_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Triangulation3;

/// Some triangles of the triangulation, each with the given chance.
std::vector<RankedTriangle> some_triangles(const Triangulation3& triangulation,
                                           double chance,
                                           std::mt19937_64& rng) {
  std::bernoulli_distribution is_taken(chance);
  std::vector<RankedTriangle> result;
  for (const delaunay::Facet facet : facets(triangulation)) {
    if (!is_taken(rng)) continue;
    Triangle t;
    for (unsigned k = 0; k < 3; ++k)
      t[k] = triangulation.cell(facet.cell())
                 .vertex[delaunay::kFacetCorners[facet.index()][k]];
    std::sort(t.begin(), t.end());
    result.push_back({t, facet, {}});
  }
  return result;
}

std::vector<VertexId> some_vertices(std::size_t n, std::size_t n_wanted,
                                    std::mt19937_64& rng) {
  std::vector<VertexId> all(n), result;
  for (std::uint32_t v = 0; v < n; ++v) all[v] = VertexId{v};
  std::sample(all.begin(), all.end(), std::back_inserter(result), n_wanted,
              rng);
  return result;
}

std::vector<CellId> cells_at(const Triangulation3& triangulation,
                             const std::vector<VertexId>& vertices) {
  std::vector<CellId> result;
  for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c) {
    const auto& corners = triangulation.cell(CellId{c}).vertex;
    if (std::find_first_of(corners.begin(), corners.end(), vertices.begin(),
                           vertices.end()) != corners.end())
      result.push_back(CellId{c});
  }
  return result;
}

void expect_all_cells(const std::vector<Point3>& points, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  const Triangulation3 triangulation(points);
  const std::size_t n = triangulation.points().size();
  // Without triangles every cell is found by a walk.
  for (const double chance : {0.0, 0.01, 0.5}) {
    SCOPED_TRACE(testing::Message() << "chance " << chance);
    const auto triangles = some_triangles(triangulation, chance, rng);
    const WorkingSurface surface(n, triangles);
    CellSet set(triangulation, surface);
    for (const std::size_t n_wanted : {1U, 2U, 7U, 60U, 3U, 0U}) {
      const auto vertices = some_vertices(n, n_wanted, rng);
      set.collect(vertices);
      std::vector<CellId> found(set.cells().begin(), set.cells().end());
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, cells_at(triangulation, vertices));
    }
  }
}

TEST(CellSet, CollectsAllCellsAtTheVertices) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 rng(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Point3> points;
    for (int i = 0; i < 300; ++i) {
      const double x = unit(rng), y = unit(rng), z = unit(rng);
      points.emplace_back(x, y, z);
    }
    expect_all_cells(points, seed);
  }
}

TEST(CellSet, CollectsThemWhereManyPointsAreCosphericalAndCoplanar) {
  std::vector<Point3> points;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 7; ++z) points.emplace_back(x, y, z);
  expect_all_cells(points, 1);
  for (Point3& p : points) p *= 1e-200;
  expect_all_cells(points, 2);
}

TEST(CellSet, KnowsWhereEachCellIs) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point3> points;
  for (int i = 0; i < 500; ++i) {
    const double x = unit(rng), y = unit(rng), z = unit(rng);
    points.emplace_back(x, y, z);
  }
  const Triangulation3 triangulation(points);
  const WorkingSurface surface(points.size());
  CellSet set(triangulation, surface);
  for (const std::size_t n_wanted : {200U, 1U, 20U}) {
    set.collect(some_vertices(points.size(), n_wanted, rng));
    std::vector<std::uint32_t> expected(
        triangulation.n_finite_cells(),
        std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t p = 0; p < set.cells().size(); ++p)
      expected[index(set.cells()[p])] = p;
    for (std::uint32_t c = 0; c < triangulation.cells().size(); ++c)
      EXPECT_EQ(set.position(CellId{c}),
                c < expected.size() ? expected[c] : set.cells().size());
  }
}

}  // namespace
}  // namespace umbrella
