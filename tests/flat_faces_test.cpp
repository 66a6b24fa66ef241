// Flat faces of designed bodies, given by points on their edges alone.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "tests/support/designed_bodies.h"
#include "umbrella/facets.h"
#include "umbrella/flat_faces_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

using support::add_ring;
using support::Circle;
using support::placed;
using support::Points;

std::vector<FlatFace> faces_of(const delaunay::Triangulation3& triangulation) {
  std::vector<LocatedTriangle> all;
  for (const delaunay::Facet facet : facets(triangulation))
    all.push_back({corners(triangulation, facet), facet});
  std::sort(all.begin(), all.end(), by_corners);
  return find_flat_faces(triangulation, all);
}

/// A disc with a bore and four holes about it: its rings at one height.
Points pierced_disc(double z, int n) {
  Points points;
  add_ring({}, z, 3 * n, points);
  add_ring({.radius = 0.4}, z, 2 * n, points);
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      add_ring({.x = x, .y = y, .radius = 0.12}, z, n, points);
  return points;
}

TEST(FlatFaces, AreWhatLiesBetweenTheRings) {
  std::mt19937_64 rng(1);
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const int n = 8 + static_cast<int>(rng() % 12);
    Points points = pierced_disc(0, n);
    const std::size_t n_points = points.size();
    for (const Point3& p : pierced_disc(0.3, n)) points.push_back(p);
    const delaunay::Triangulation3 triangulation(placed(points, trial, rng));
    const std::vector<FlatFace> faces = faces_of(triangulation);
    ASSERT_GE(faces.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(faces[i].vertices.size(), n_points);
      EXPECT_EQ(faces[i].outline.size(), n_points);
      EXPECT_EQ(faces[i].n_holes(), 5U);
    }
  }
}

TEST(FlatFaces, HaveTheirOutlineAsBoundary) {
  std::mt19937_64 rng(2);
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Points points = pierced_disc(0, 8 + trial);
    for (const Point3& p : pierced_disc(0.2, 8 + trial)) points.push_back(p);
    const delaunay::Triangulation3 triangulation(placed(points, trial, rng));
    std::set<Triangle> met;
    const std::vector<FlatFace> faces = faces_of(triangulation);
    ASSERT_GE(faces.size(), 2U);
    for (const FlatFace& face : faces) {
      std::map<std::array<VertexId, 2>, int> count;
      for (const LocatedTriangle& t : face.triangles) {
        const auto& [a, b, c] = t.corners;
        EXPECT_TRUE(met.insert(t.corners).second);
        EXPECT_EQ(corners(triangulation, t.facet), t.corners);
        ++count[{a, b}], ++count[{a, c}], ++count[{b, c}];
      }
      std::vector<std::array<VertexId, 2>> boundary;
      for (const auto& [side, n] : count)
        if (n == 1) boundary.push_back(side);
      EXPECT_EQ(boundary, face.outline);
      EXPECT_EQ(boundary.size(), face.vertices.size());
    }
  }
}

TEST(FlatFaces, AreNotInARandomSample) {
  std::mt19937_64 rng(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Points points;
    for (int i = 0; i < 400; ++i)
      points.push_back(
          Point3(normal(rng), normal(rng), normal(rng)).normalized());
    EXPECT_TRUE(faces_of(delaunay::Triangulation3(points)).empty());
  }
}

/// A square plate, n points on each side, with a head on the one side and a
/// thinner shank on the other.
Points bolt(double height, int n, int n_ring) {
  Points points;
  for (const double z : {0.0, height})
    for (int i = 0; i < n; ++i) {
      const double x = 2.0 * i / n;
      points.emplace_back(x, 0, z);
      points.emplace_back(2, x, z);
      points.emplace_back(2 - x, 2, z);
      points.emplace_back(0, 2 - x, z);
    }
  for (const double z : {height, height + 0.2})
    add_ring({.x = 1, .y = 1, .radius = 0.5}, z, n_ring, points);
  for (const double z : {-0.6, 0.0})
    add_ring({.x = 1, .y = 1, .radius = 0.25}, z, n_ring, points);
  return points;
}

Reconstruction closed(const Points& points, bool regain_faces,
                      unsigned threads = 1) {
  ReconstructOptions options;
  options.closing.regain_faces = regain_faces;
  options.closing.open_bores = false;
  options.closing.handle_edges = 0;
  options.threads = threads;
  return reconstruct(points, options);
}

/// The area of triangles at some height.
double area_at(const Points& points, const Reconstruction& result, double z) {
  double area = 0;
  for (const auto& [a, b, c] : result.triangles)
    if (std::abs(points[a].z() - z) < 1e-4 &&
        std::abs(points[b].z() - z) < 1e-4 &&
        std::abs(points[c].z() - z) < 1e-4)
      area += (points[b] - points[a]).cross(points[c] - points[a]).norm() / 2;
  return area;
}

TEST(LostFaces, ArePutInWithoutPiecesOrHandles) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> height(0.1, 0.4);
  std::size_t n_regained = 0;
  for (int trial = 0; trial < 16; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const int n = 4 + static_cast<int>(rng() % 6);
    const Points points = placed(bolt(height(rng), n, 10 + 2 * n), trial, rng);
    const Reconstruction before = closed(points, false);
    const Reconstruction after = closed(points, true);
    ASSERT_TRUE(after.surface.closed && after.surface.manifold);
    EXPECT_EQ(before.closing.faces_regained, 0U);
    EXPECT_LE(after.surface.components, before.surface.components);
    EXPECT_LE(*after.surface.genus, *before.surface.genus);
    EXPECT_EQ(after.surface.unused_vertices, before.surface.unused_vertices);
    if (after.closing.faces_regained == 0) {
      EXPECT_EQ(after.triangles, before.triangles);
    }
    n_regained += after.closing.faces_regained;
  }
  EXPECT_GE(n_regained, 4U);
}

TEST(LostFaces, AreFlatAfterwards) {
  std::size_t n_regained = 0;
  for (int n = 4; n < 10; ++n) {
    SCOPED_TRACE(testing::Message() << "n " << n);
    const Points points = bolt(0.2, n, 2 * n + 4);
    const Reconstruction before = closed(points, false);
    const Reconstruction after = closed(points, true);
    if (after.closing.faces_regained == 0) continue;
    n_regained += after.closing.faces_regained;
    EXPECT_GT(area_at(points, after, 0) + area_at(points, after, 0.2),
              area_at(points, before, 0) + area_at(points, before, 0.2));
  }
  EXPECT_GE(n_regained, 1U);
}

TEST(LostFaces, DependNeitherOnUnitNorOnThreads) {
  std::mt19937_64 rng(5);
  std::size_t n_regained = 0;
  for (int n = 4; n < 8; ++n) {
    SCOPED_TRACE(testing::Message() << "n " << n);
    Points points = placed(bolt(0.2, n, 18), 0, rng);
    const Reconstruction expected = closed(points, true);
    n_regained += expected.closing.faces_regained;
    EXPECT_EQ(closed(points, true, 3).triangles, expected.triangles);
    for (const int exponent : {-600, -30, 40, 500}) {
      Points scaled = points;
      for (Point3& p : scaled) p *= std::ldexp(1, exponent);
      EXPECT_EQ(closed(scaled, true).triangles, expected.triangles);
    }
  }
  EXPECT_GE(n_regained, 3U);
}

/// Rings of two radii in each of some planes: only the first and the last plane
/// hold a face, and that is there.
TEST(LostFaces, AreNoSections) {
  std::mt19937_64 rng(6);
  for (int trial = 0; trial < 8; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const int n = 12 + 4 * trial;
    Points points;
    for (const double z : {0.0, 0.4, 0.8, 1.2, 1.6}) {
      add_ring({}, z, n, points);
      add_ring({.radius = 0.4}, z, n / 2, points);
    }
    points = placed(points, trial, rng);
    const Reconstruction result = closed(points, true);
    EXPECT_EQ(result.closing.faces_regained, 0U);
    EXPECT_EQ(result.triangles, closed(points, false).triangles);
  }
}

}  // namespace
}  // namespace umbrella
