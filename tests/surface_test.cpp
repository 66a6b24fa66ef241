#include "umbrella/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/support/meshes.h"
#include "umbrella/certificate.h"

namespace umbrella {
namespace {

using tests::IndexedMesh;

/// The triangles without their orientation.
std::vector<Triangle> forget(const IndexedMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({VertexId{a}, VertexId{b}, VertexId{c}});
    std::sort(triangles.back().begin(), triangles.back().end());
  }
  return triangles;
}

IndexedMesh oriented(const IndexedMesh& mesh, const OrientedSurface& surface) {
  IndexedMesh result{mesh.vertices, {}};
  for (const auto& [a, b, c] : surface.triangles)
    result.triangles.push_back({static_cast<std::uint32_t>(a),
                                static_cast<std::uint32_t>(b),
                                static_cast<std::uint32_t>(c)});
  return result;
}

TEST(Orient, TurnsClosedSurfacesOutward) {
  std::mt19937_64 rng(4);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    IndexedMesh mesh =
        tests::together(tests::torus(3 + trial % 7, 3 + trial % 5),
                        tests::tetrahedron(), {7, 0, 0});
    std::vector<std::uint32_t> new_row(mesh.vertices.size());
    std::iota(new_row.begin(), new_row.end(), 0U);
    std::shuffle(new_row.begin(), new_row.end(), rng);
    IndexedMesh shuffled = mesh;
    for (std::size_t v = 0; v < new_row.size(); ++v)
      shuffled.vertices[new_row[v]] = mesh.vertices[v];
    for (auto& t : shuffled.triangles)
      for (auto& v : t) v = new_row[v];
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), rng);

    const auto triangles = forget(shuffled);
    const auto surface = orient(shuffled.vertices, triangles);
    EXPECT_TRUE(surface.is_closed);
    EXPECT_EQ(surface.n_components, 2U);
    const auto result = oriented(shuffled, surface);
    EXPECT_EQ(forget(result), triangles);
    EXPECT_TRUE(check_surface(result.vertices, result.triangles).outward);
    for (const OrientedTriangle& t : surface.triangles)
      EXPECT_EQ(t[0], *std::min_element(t.begin(), t.end()));
  }
}

TEST(Orient, TurnsHugeAndTinySurfacesOutward) {
  for (const double size : {1e300, 1e-300}) {
    IndexedMesh mesh = tests::tetrahedron();
    for (auto& p : mesh.vertices) p *= size;
    const auto surface = orient(mesh.vertices, forget(mesh));
    const auto unit = orient(tests::tetrahedron().vertices, forget(mesh));
    EXPECT_EQ(surface.triangles, unit.triangles);
  }
}

/// Volumes as seen from the origin would be lost in rounding.
TEST(Orient, TurnsFarSurfacesOutward) {
  for (const double far : {1e7, 1e9, 1e11}) {
    IndexedMesh mesh = tests::torus(6, 5);
    for (auto& p : mesh.vertices) p += Point3(far, -far, far / 3);
    const auto surface = orient(mesh.vertices, forget(mesh));
    for (auto& p : mesh.vertices) p -= Point3(far, -far, far / 3);
    const auto result = oriented(mesh, surface);
    EXPECT_TRUE(check_surface(result.vertices, result.triangles).outward);
  }
}

TEST(Orient, LeavesWhatHasNoVolumeAsItsFirstTriangleIs) {
  const IndexedMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                         {{0, 1, 2}, {1, 2, 3}}};
  const auto surface = orient(flat.vertices, forget(flat));
  EXPECT_EQ(surface.triangles[0],
            (OrientedTriangle{VertexId{0}, VertexId{1}, VertexId{2}}));
  EXPECT_EQ(surface.triangles[1],
            (OrientedTriangle{VertexId{1}, VertexId{3}, VertexId{2}}));
}

TEST(Orient, TurnsOpenSurfacesAlike) {
  IndexedMesh mesh = tests::torus(6, 6);
  mesh.triangles.resize(40);
  const auto surface = orient(mesh.vertices, forget(mesh));
  EXPECT_FALSE(surface.is_closed);
  const auto result = oriented(mesh, surface);
  EXPECT_TRUE(check_surface(result.vertices, result.triangles).oriented);
}

TEST(Orient, SaysWhereThereIsNoOrientation) {
  const IndexedMesh mesh = tests::projective_plane();
  EXPECT_FALSE(orient(mesh.vertices, forget(mesh)).is_closed);
  EXPECT_FALSE(orient({}, {}).is_closed);
}

TEST(Orient, ManagesAVertexOfVeryHighDegree) {
  constexpr std::uint32_t kRim = 100'000;
  IndexedMesh mesh{{{0, 0, 1}, {0, 0, -1}}, {}};
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const double a = 2 * M_PI * i / kRim;
    mesh.vertices.emplace_back(std::cos(a), std::sin(a), 0);
    const std::uint32_t p = 2 + i, q = 2 + (i + 1) % kRim;
    mesh.triangles.push_back({0, p, q});
    mesh.triangles.push_back({1, q, p});
  }
  EXPECT_TRUE(orient(mesh.vertices, forget(mesh)).is_closed);
}

}  // namespace
}  // namespace umbrella
