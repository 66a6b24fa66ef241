#include "umbrella/certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "tests/support/meshes.h"

namespace umbrella {
namespace {

using tests::IndexedMesh;

SurfaceReport check(const IndexedMesh& mesh) {
  return check_surface(mesh.vertices, mesh.triangles);
}

TEST(CheckSurface, KnowsATetrahedron) {
  const SurfaceReport report = check(tests::tetrahedron());
  EXPECT_EQ(report.vertices, 4U);
  EXPECT_EQ(report.triangles, 4U);
  EXPECT_EQ(report.euler, 2);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.components, 1U);
  EXPECT_TRUE(report.closed && report.manifold && report.orientable &&
              report.oriented && report.outward);
  EXPECT_NEAR(report.volume, 1. / 6, 1e-15);
  EXPECT_NEAR(report.area, 1.5 + std::sqrt(3) / 2, 1e-15);
  EXPECT_TRUE(report.unused_vertices.empty());
}

TEST(CheckSurface, CountsHandlesAndPieces) {
  const IndexedMesh torus = tests::torus(9, 7);
  const SurfaceReport one = check(torus);
  EXPECT_EQ(one.euler, 0);
  EXPECT_EQ(one.genus, 1);
  EXPECT_TRUE(one.outward);
  const SurfaceReport three =
      check(tests::together(tests::together(torus, torus, {9, 0, 0}),
                            tests::tetrahedron(), {0, 9, 0}));
  EXPECT_EQ(three.components, 3U);
  EXPECT_EQ(three.genus, 2);
  EXPECT_EQ(three.euler, 2);
  EXPECT_TRUE(three.closed && three.manifold && three.outward);
}

TEST(CheckSurface, KnowsOutwardAtEveryScale) {
  for (const int exponent : {-1074, -1022, -500, -1, 500, 1023}) {
    SCOPED_TRACE(exponent);
    IndexedMesh mesh = tests::tetrahedron();
    for (auto& p : mesh.vertices) p *= std::ldexp(1, exponent);
    const SurfaceReport report = check(mesh);
    EXPECT_TRUE(report.outward);
    EXPECT_EQ(report.volume,
              std::ldexp(check(tests::tetrahedron()).volume, 3 * exponent));
    EXPECT_EQ(report.area,
              std::ldexp(check(tests::tetrahedron()).area, 2 * exponent));
  }
}

TEST(CheckSurface, DoesNotDependOnOrder) {
  IndexedMesh mesh = tests::torus(8, 5);
  const SurfaceReport expected = check(mesh);
  std::mt19937_64 rng(1);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), rng);
  for (auto& t : mesh.triangles)
    std::rotate(t.begin(), t.begin() + static_cast<int>(rng() % 3), t.end());
  const SurfaceReport report = check(mesh);
  EXPECT_EQ(report.genus, expected.genus);
  EXPECT_TRUE(report.outward);
  EXPECT_NEAR(report.volume, expected.volume, 1e-12);
}

TEST(CheckSurface, FindsAMissingTriangle) {
  for (std::size_t gone = 0; gone < 70; ++gone) {
    IndexedMesh mesh = tests::torus(7, 5);
    mesh.triangles.erase(mesh.triangles.begin() +
                         static_cast<std::ptrdiff_t>(gone));
    const SurfaceReport report = check(mesh);
    EXPECT_EQ(report.boundary_edges, 3U);
    EXPECT_FALSE(report.closed);
    EXPECT_TRUE(report.manifold && report.oriented);
    EXPECT_FALSE(report.genus.has_value());
    EXPECT_FALSE(report.outward);
  }
}

TEST(CheckSurface, FindsATurnedTriangle) {
  IndexedMesh mesh = tests::torus(7, 5);
  std::swap(mesh.triangles[30][0], mesh.triangles[30][1]);
  const SurfaceReport report = check(mesh);
  EXPECT_TRUE(report.closed && report.manifold && report.orientable);
  EXPECT_FALSE(report.oriented);
  EXPECT_FALSE(report.outward);
  EXPECT_EQ(report.genus, 1);
}

TEST(CheckSurface, FindsAPieceInsideOut) {
  IndexedMesh inner = tests::tetrahedron();
  for (auto& t : inner.triangles) std::swap(t[0], t[1]);
  const SurfaceReport report =
      check(tests::together(tests::torus(7, 5), inner, {9, 0, 0}));
  EXPECT_TRUE(report.closed && report.oriented);
  EXPECT_FALSE(report.outward);
}

TEST(CheckSurface, FindsTwoPiecesThatShareAVertex) {
  IndexedMesh mesh =
      tests::together(tests::tetrahedron(), tests::tetrahedron(), {2, 0, 0});
  for (auto& t : mesh.triangles)
    for (auto& v : t) v = v == 4 ? 0 : v;
  const SurfaceReport report = check(mesh);
  EXPECT_EQ(report.nonmanifold_vertices, 1U);
  EXPECT_EQ(report.nonmanifold_edges, 0U);
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.unused_vertices, std::vector<std::uint32_t>{4});
  EXPECT_EQ(report.vertices, 7U);
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold);
}

TEST(CheckSurface, FindsTwoPiecesThatShareAnEdge) {
  IndexedMesh mesh =
      tests::together(tests::tetrahedron(), tests::tetrahedron(), {2, 0, 0});
  for (auto& t : mesh.triangles)
    for (auto& v : t) v = v == 4 ? 0 : v == 5 ? 1 : v;
  const SurfaceReport report = check(mesh);
  EXPECT_EQ(report.nonmanifold_edges, 1U);
  EXPECT_EQ(report.nonmanifold_vertices, 2U);
  EXPECT_FALSE(report.closed || report.manifold);
}

TEST(CheckSurface, KnowsSurfacesWithoutAnInside) {
  const SurfaceReport strip = check(tests::moebius_strip());
  EXPECT_EQ(strip.euler, 0);
  EXPECT_EQ(strip.boundary_edges, 5U);
  EXPECT_TRUE(strip.manifold);
  EXPECT_FALSE(strip.orientable || strip.oriented);
  const SurfaceReport plane = check(tests::projective_plane());
  EXPECT_EQ(plane.euler, 1);
  EXPECT_TRUE(plane.closed && plane.manifold);
  EXPECT_FALSE(plane.orientable || plane.oriented);
  EXPECT_FALSE(plane.genus.has_value());
}

TEST(CheckSurface, FindsDegenerateAndRepeatedTriangles) {
  IndexedMesh mesh = tests::tetrahedron();
  mesh.triangles.push_back({2, 1, 0});
  mesh.triangles.push_back({3, 3, 1});
  const SurfaceReport report = check(mesh);
  EXPECT_EQ(report.degenerate_triangles, 1U);
  EXPECT_EQ(report.duplicate_triangles, 1U);
  EXPECT_FALSE(report.closed || report.manifold);
}

TEST(CheckSurface, TakesATriangleThatMeetsItselfForOne) {
  for (const IndexedTriangle& t :
       {IndexedTriangle{0, 1, 1}, {0, 0, 1}, {1, 0, 1}}) {
    const SurfaceReport report =
        check_surface(tests::tetrahedron().vertices, std::vector{t});
    EXPECT_EQ(report.degenerate_triangles, 1U);
    EXPECT_EQ(report.duplicate_triangles, 0U);
    EXPECT_EQ(report.nonmanifold_vertices, 1U);
    EXPECT_FALSE(report.closed || report.manifold);
  }
}

TEST(CheckSurface, TakesATriangleWithItsBackForNoSurface) {
  const SurfaceReport report =
      check_surface(tests::tetrahedron().vertices,
                    std::vector<IndexedTriangle>{{0, 1, 2}, {0, 2, 1}});
  EXPECT_EQ(report.duplicate_triangles, 1U);
  EXPECT_EQ(report.nonmanifold_edges + report.nonmanifold_vertices, 0U);
  EXPECT_TRUE(report.closed && report.oriented);
  EXPECT_FALSE(report.manifold || report.outward);
  EXPECT_EQ(report.volume, 0);
  EXPECT_FALSE(report.genus.has_value());
}

/// Edges of a mesh with the triangles on each, as often as they run along it.
std::map<IndexedEdge, std::vector<std::size_t>> triangles_by_edge(
    const std::vector<IndexedTriangle>& triangles) {
  std::map<IndexedEdge, std::vector<std::size_t>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      if (low != high) edges[{low, high}].push_back(t);
    }
  return edges;
}

/// By the definition: no three triangles at an edge of the vertex, and from
/// each of its triangles every other is reached across such edges.
bool is_fan_or_umbrella(const std::vector<IndexedTriangle>& triangles,
                        std::uint32_t v) {
  std::set<std::size_t> at_v, reached;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (std::count(triangles[t].begin(), triangles[t].end(), v) > 0)
      at_v.insert(t);
  reached.insert(*at_v.begin());
  const auto edges = triangles_by_edge(triangles);
  for (std::size_t round = 0; round < at_v.size(); ++round)
    for (const auto& [edge, on_edge] : edges) {
      if (edge[0] != v && edge[1] != v) continue;
      if (on_edge.size() > 2) return false;
      for (const std::size_t t : on_edge)
        if (reached.contains(t)) reached.insert(on_edge.begin(), on_edge.end());
    }
  return reached == at_v;
}

std::vector<IndexedTriangle> random_triangles(std::uint32_t n_vertices,
                                              std::mt19937_64& rng) {
  std::vector<std::uint32_t> rows(n_vertices);
  std::iota(rows.begin(), rows.end(), 0U);
  std::vector<IndexedTriangle> triangles(1 + rng() % 9);
  for (IndexedTriangle& t : triangles) {
    std::shuffle(rows.begin(), rows.end(), rng);
    t = {rows[0], rows[1], rows[2]};
  }
  return triangles;
}

TEST(CheckSurface, CountsEdgesAndRepetitionsAsTheDefinitionsSay) {
  std::mt19937_64 rng(4);
  const std::vector<Eigen::Vector3d> vertices(7, Eigen::Vector3d::Zero());
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto triangles = random_triangles(7, rng);
    const SurfaceReport report = check_surface(vertices, triangles);
    std::size_t n_boundary = 0, n_nonmanifold = 0;
    const auto edges = triangles_by_edge(triangles);
    for (const auto& [edge, on_edge] : edges) {
      n_boundary += on_edge.size() == 1 ? 1 : 0;
      n_nonmanifold += on_edge.size() > 2 ? 1 : 0;
    }
    EXPECT_EQ(report.boundary_edges, n_boundary);
    EXPECT_EQ(report.nonmanifold_edges, n_nonmanifold);
    EXPECT_EQ(report.euler, static_cast<std::int64_t>(report.vertices) -
                                static_cast<std::int64_t>(edges.size()) +
                                static_cast<std::int64_t>(triangles.size()));
    std::set<std::set<std::uint32_t>> corner_sets;
    for (const IndexedTriangle& t : triangles)
      corner_sets.insert({t.begin(), t.end()});
    EXPECT_EQ(report.duplicate_triangles,
              triangles.size() - corner_sets.size());
  }
}

TEST(CheckSurface, CountsVerticesAsTheDefinitionsSay) {
  std::mt19937_64 rng(5);
  const std::vector<Eigen::Vector3d> vertices(6, Eigen::Vector3d::Zero());
  std::size_t n_sound_in_all = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto triangles = random_triangles(6, rng);
    std::set<std::uint32_t> used, bad;
    for (const IndexedTriangle& t : triangles) used.insert(t.begin(), t.end());
    for (const std::uint32_t v : used)
      if (!is_fan_or_umbrella(triangles, v)) bad.insert(v);
    const SurfaceReport report = check_surface(vertices, triangles);
    EXPECT_EQ(report.vertices, used.size());
    EXPECT_EQ(report.nonmanifold_vertices, bad.size());
    n_sound_in_all += used.size() - bad.size();
  }
  EXPECT_GT(n_sound_in_all, 1000U);
}

/// Each triangle on five vertices is there, or there the other way round, or
/// not: meshes 0 to 3^10 - 1.
std::vector<IndexedTriangle> small_mesh(std::uint32_t number) {
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t a = 0; a < 5; ++a)
    for (std::uint32_t b = a + 1; b < 5; ++b)
      for (std::uint32_t c = b + 1; c < 5; ++c) {
        if (number % 3 == 1) triangles.push_back({a, b, c});
        if (number % 3 == 2) triangles.push_back({a, c, b});
        number /= 3;
      }
  return triangles;
}

/// A loose triangle makes the quick walk around all vertices fail, so that all
/// is counted in full; both must say the same of the rest.
TEST(CheckSurface, SaysTheSameQuicklyAndInFull) {
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i < 8; ++i) vertices.emplace_back(i, i * i, i * i * i);
  constexpr std::uint32_t kMeshes = 59'049;
  int n_quick = 0;
  for (std::uint32_t number = 1; number < kMeshes; ++number) {
    std::vector<IndexedTriangle> triangles = small_mesh(number);
    const SurfaceReport alone = check_surface(vertices, triangles);
    triangles.push_back({5, 6, 7});
    const SurfaceReport with = check_surface(vertices, triangles);
    const bool is_same =
        alone.boundary_edges + 3 == with.boundary_edges &&
        alone.nonmanifold_edges == with.nonmanifold_edges &&
        alone.nonmanifold_vertices == with.nonmanifold_vertices &&
        alone.manifold == with.manifold && alone.oriented == with.oriented &&
        alone.orientable == with.orientable && alone.euler + 1 == with.euler &&
        alone.components + 1 == with.components;
    ASSERT_TRUE(is_same) << "mesh " << number;
    n_quick += alone.closed && alone.manifold && alone.oriented ? 1 : 0;
  }
  // Five tetrahedra and ten double ones, two ways round.
  EXPECT_EQ(n_quick, 30);
}

/// The triangles of bits in `turned` the other way round.
bool runs_opposite_ways(const std::vector<IndexedTriangle>& triangles,
                        std::size_t turned) {
  std::map<IndexedEdge, std::array<int, 2>> n_runs;  // down, up
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      const bool is_up = (a < b) != ((turned >> t) % 2 == 1);
      ++n_runs[{std::min(a, b), std::max(a, b)}][is_up ? 1 : 0];
    }
  return std::ranges::all_of(n_runs, [](const auto& edge_and_runs) {
    const auto [down, up] = edge_and_runs.second;
    return down + up != 2 || down == up;
  });
}

TEST(CheckSurface, KnowsWhatCanBeOrientedByTrying) {
  std::mt19937_64 rng(6);
  const std::vector<Eigen::Vector3d> vertices(5, Eigen::Vector3d::Zero());
  int n_orientable = 0;
  constexpr int kTrials = 500;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto triangles = small_mesh(static_cast<std::uint32_t>(rng() >> 32U));
    bool can_be = false;
    for (std::size_t turned = 0; turned >> triangles.size() == 0; ++turned)
      can_be = can_be || runs_opposite_ways(triangles, turned);
    EXPECT_EQ(check_surface(vertices, triangles).orientable, can_be)
        << "trial " << trial;
    n_orientable += can_be ? 1 : 0;
  }
  EXPECT_GT(n_orientable, kTrials / 10);
  EXPECT_LT(n_orientable, kTrials);
}

TEST(CheckSurface, KnowsTheEmptyMesh) {
  const SurfaceReport report = check({{{0, 0, 0}}, {}});
  EXPECT_EQ(report.vertices, 0U);
  EXPECT_EQ(report.components, 0U);
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.unused_vertices.size(), 1U);
}

TEST(CheckSurface, RefusesARowThatIsNotThere) {
  IndexedMesh mesh = tests::tetrahedron();
  mesh.triangles[2][1] = 4;
  EXPECT_THROW(check(mesh), std::invalid_argument);
}

TEST(CheckCurve, KnowsClosedCurves) {
  std::vector<IndexedEdge> edges = {{0, 1}, {1, 2}, {2, 0},
                                    {4, 5}, {5, 6}, {6, 4}};
  const CurveReport two = check_curve(8, edges);
  EXPECT_EQ(two.components, 2U);
  EXPECT_TRUE(two.closed && two.manifold);
  EXPECT_EQ(two.unused_vertices, (std::vector<std::uint32_t>{3, 7}));
  edges.pop_back();
  const CurveReport open = check_curve(8, edges);
  EXPECT_EQ(open.ends, 2U);
  EXPECT_FALSE(open.closed);
  EXPECT_TRUE(open.manifold);
  edges.push_back({4, 0});
  const CurveReport branched = check_curve(8, edges);
  EXPECT_EQ(branched.branchings, 1U);
  EXPECT_EQ(branched.components, 1U);
  EXPECT_FALSE(branched.manifold);
}

TEST(CheckCurve, FindsDegenerateAndRepeatedEdges) {
  const std::vector<IndexedEdge> edges = {{0, 1}, {1, 0}, {2, 2}};
  const CurveReport report = check_curve(3, edges);
  EXPECT_EQ(report.duplicate_edges, 1U);
  EXPECT_EQ(report.degenerate_edges, 1U);
  EXPECT_FALSE(report.closed || report.manifold);
  EXPECT_THROW(check_curve(2, edges), std::invalid_argument);
}

}  // namespace
}  // namespace umbrella
