// What belongs to a region, against a look at every triangle and every cell.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <random>
#include <set>
#include <vector>

#include "tests/support/point_sets.h"
#include "umbrella/facets.h"
#include "umbrella/region_internal.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;
using Vertices = std::vector<VertexId>;

Vertices some_vertices(std::mt19937_64& rng, std::size_t n,
                       std::size_t n_wanted) {
  Vertices all, result;
  for (std::uint32_t v = 0; v < n; ++v) all.push_back(VertexId{v});
  std::sample(all.begin(), all.end(), std::back_inserter(result), n_wanted,
              rng);
  return result;
}

std::ptrdiff_t n_corners_in(const Triangle& t, const Vertices& vertices) {
  return std::count_if(t.begin(), t.end(), [&](VertexId v) {
    return std::binary_search(vertices.begin(), vertices.end(), v);
  });
}

std::vector<Triangle> corners_of(const std::vector<LocatedTriangle>& located) {
  std::vector<Triangle> result;
  for (const LocatedTriangle& t : located) result.push_back(t.corners);
  return result;
}

void expect_all_triangles(const std::vector<Point3>& points) {
  std::mt19937_64 rng(1);
  const std::size_t n = points.size();
  const Triangulation3 triangulation(points);
  const WorkingSurface surface(n);
  Neighborhoods neighborhoods(triangulation, surface);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Region region;
    region.vertices = some_vertices(rng, n, 5 + rng() % 30);
    region.stuck = some_vertices(rng, n, rng() % 6);
    region.reach = 1 + static_cast<unsigned>(trial % 3);
    std::vector<Triangle> expected;
    std::set<VertexId> touched(region.vertices.begin(), region.vertices.end());
    for (const delaunay::Facet facet : facets(triangulation)) {
      const Triangle t = corners(triangulation, facet);
      if (n_corners_in(t, region.vertices) < 3 &&
          n_corners_in(t, region.stuck) < std::ptrdiff_t{region.reach})
        continue;
      expected.push_back(t);
      touched.insert(t.begin(), t.end());
    }
    std::sort(expected.begin(), expected.end());
    const auto candidates = neighborhoods.candidates(region);
    EXPECT_EQ(corners_of(candidates), expected);
    for (const LocatedTriangle& c : candidates)
      EXPECT_EQ(corners(triangulation, c.facet), c.corners);
    EXPECT_EQ(vertices_of(region, candidates),
              Vertices(touched.begin(), touched.end()));
  }
}

TEST(Neighborhoods, OfferTheTrianglesOfARegion) {
  expect_all_triangles(tests::make_points<3>(Family::Uniform, 150, 1));
  std::vector<Point3> lattice;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) lattice.emplace_back(x, y, z);
  expect_all_triangles(lattice);
}

TEST(Neighborhoods, ReachOneEdgeFar) {
  std::mt19937_64 rng(2);
  const Triangulation3 triangulation(
      tests::make_points<3>(Family::Uniform, 200, 2));
  const WorkingSurface surface(200);
  Neighborhoods neighborhoods(triangulation, surface);
  for (const std::size_t n_wanted : {0U, 1U, 2U, 10U, 200U}) {
    SCOPED_TRACE(testing::Message() << n_wanted << " vertices");
    const Vertices inner = some_vertices(rng, 200, n_wanted);
    std::set<VertexId> expected(inner.begin(), inner.end());
    for (const delaunay::Facet facet : facets(triangulation)) {
      const Triangle t = corners(triangulation, facet);
      if (n_corners_in(t, inner) > 0) expected.insert(t.begin(), t.end());
    }
    EXPECT_EQ(neighborhoods.ring(inner),
              Vertices(expected.begin(), expected.end()));
  }
}

/// Joins sets that overlap, by brute force.
std::set<Vertices> merged(std::vector<Vertices> sets,
                          const std::vector<RankedTriangle>& triangles) {
  const auto meets = [&](const Vertices& a, const Vertices& b) {
    Vertices both, all;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                          std::back_inserter(both));
    if (!both.empty()) return true;
    all = united(a, b);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const RankedTriangle& t) {
                         return n_corners_in(t.corners, all) == 3 &&
                                n_corners_in(t.corners, a) % 3 != 0;
                       });
  };
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (meets(sets[i], sets[j])) {
        sets[j] = united(sets[i], sets[j]);
        sets.erase(sets.begin() + static_cast<std::ptrdiff_t>(i));
        i = j = 0;  // from the beginning
      }
  return {sets.begin(), sets.end()};
}

// Two holes at a time are joined by a triangle here: one with corners in three
// joins all of them, which joining by twos would not see.
TEST(MergeHoles, JoinsThoseThatShareAVertexOrATriangle) {
  std::mt19937_64 rng(3);
  const std::size_t n = 60;
  const Triangulation3 triangulation(
      tests::make_points<3>(Family::Uniform, n, 3));
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::vector<Hole> holes(2 + rng() % 4);
    std::vector<Vertices> sets;
    for (Hole& hole : holes) {
      hole.vertices = some_vertices(rng, n, 1 + rng() % 6);
      sets.push_back(hole.vertices);
    }
    const auto is_in_two_at_most = [&](const Triangle& t) {
      return std::count_if(sets.begin(), sets.end(), [&](const Vertices& s) {
               return n_corners_in(t, s) > 0;
             }) <= 2;
    };
    std::vector<RankedTriangle> triangles;
    for (const delaunay::Facet facet : facets(triangulation)) {
      const Triangle t = corners(triangulation, facet);
      if (rng() % 8 == 0 && is_in_two_at_most(t))
        triangles.push_back({t, facet, {}});
    }
    const WorkingSurface surface(n, triangles);
    std::set<Vertices> found;
    Vertices smallest;
    for (const Region& region : merge_holes(holes, surface)) {
      EXPECT_TRUE(region.stuck.empty());
      smallest.push_back(region.vertices.front());
      found.insert(region.vertices);
    }
    EXPECT_TRUE(std::is_sorted(smallest.begin(), smallest.end()));
    EXPECT_EQ(found, merged(sets, triangles));
  }
}

}  // namespace
}  // namespace umbrella
