#include "umbrella/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/support/meshes.h"
#include "umbrella/certificate.h"
#include "umbrella/closed_sweep_internal.h"

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

std::vector<LocatedTriangle> located(const std::vector<Triangle>& triangles) {
  std::vector<LocatedTriangle> result;
  for (const Triangle& t : triangles) result.push_back({t, {}});
  return result;
}

/// With the vertices in another order, drawn from rng.
IndexedMesh renumbered(const IndexedMesh& mesh, std::mt19937_64& rng) {
  std::vector<std::uint32_t> new_row(mesh.vertices.size());
  std::iota(new_row.begin(), new_row.end(), 0U);
  std::shuffle(new_row.begin(), new_row.end(), rng);
  IndexedMesh result = mesh;
  for (std::size_t v = 0; v < new_row.size(); ++v)
    result.vertices[new_row[v]] = mesh.vertices[v];
  for (auto& t : result.triangles)
    for (auto& v : t) v = new_row[v];
  return result;
}

TEST(Orient, TurnsClosedSurfacesOutward) {
  std::mt19937_64 rng(4);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    IndexedMesh shuffled =
        renumbered(tests::together(tests::torus(3 + trial % 7, 3 + trial % 5),
                                   tests::tetrahedron(), {7, 0, 0}),
                   rng);
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), rng);

    const auto triangles = forget(shuffled);
    const auto surface = orient(shuffled.vertices, located(triangles));
    EXPECT_TRUE(surface.is_closed);
    EXPECT_EQ(surface.n_components, 2U);
    const IndexedMesh result{shuffled.vertices, surface.triangles};
    EXPECT_EQ(forget(result), triangles);
    EXPECT_TRUE(check_surface(result.vertices, result.triangles).outward);
    for (const OrientedTriangle& t : surface.triangles)
      EXPECT_EQ(t[0], *std::min_element(t.begin(), t.end()));
  }
}

/// By ascending corners.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Orient, DoesNotDependOnTheOrderOfTheTriangles) {
  std::mt19937_64 rng(5);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const IndexedMesh mesh =
        renumbered(tests::together(tests::torus(3 + trial % 7, 3 + trial % 5),
                                   tests::tetrahedron(), {7, 0, 0}),
                   rng);
    const auto in_order = sorted(forget(mesh));
    auto shuffled = in_order;
    std::shuffle(shuffled.begin(), shuffled.end(), rng);
    const auto swept = orient(mesh.vertices, located(in_order));
    auto walked = orient(mesh.vertices, located(shuffled));
    std::sort(walked.triangles.begin(), walked.triangles.end(),
              [](OrientedTriangle a, OrientedTriangle b) {
                std::sort(a.begin(), a.end());
                std::sort(b.begin(), b.end());
                return a < b;
              });
    EXPECT_EQ(swept.triangles, walked.triangles);
    EXPECT_EQ(swept.n_components, walked.n_components);
    EXPECT_TRUE(swept.is_closed);
  }
}

TEST(SweepClosed, TurnsNeighborsAlikeWhateverTheNumbersOfTheVertices) {
  std::mt19937_64 rng(6);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const IndexedMesh mesh = renumbered(tests::torus(5, 3 + trial % 9), rng);
    const auto triangles = sorted(forget(mesh));
    const auto turned = sweep_closed(mesh.vertices.size(), located(triangles));
    ASSERT_TRUE(turned.has_value());
    EXPECT_EQ(turned->n_components(), 1U);
    EXPECT_FALSE(turned->is_turned(0));
    IndexedMesh alike{mesh.vertices, {}};
    for (TriangleIndex t = 0; t < triangles.size(); ++t) {
      const auto [a, b, c] = triangles[t];
      alike.triangles.push_back({static_cast<std::uint32_t>(a),
                                 static_cast<std::uint32_t>(b),
                                 static_cast<std::uint32_t>(c)});
      if (turned->is_turned(t))
        std::swap(alike.triangles.back()[1], alike.triangles.back()[2]);
    }
    EXPECT_TRUE(check_surface(alike.vertices, alike.triangles).oriented);
  }
}

TEST(SweepClosed, CountsComponentsByEdges) {
  // Two tetrahedra that share vertex 3.
  const auto tetrahedron = [](std::array<std::uint32_t, 4> v) {
    std::vector<Triangle> result;
    for (std::size_t i = 0; i < 4; ++i)
      result.push_back({VertexId{v[i < 1 ? 1 : 0]}, VertexId{v[i < 2 ? 2 : 1]},
                        VertexId{v[i < 3 ? 3 : 2]}});
    return result;
  };
  auto triangles = tetrahedron({0, 1, 2, 3});
  for (const Triangle& t : tetrahedron({3, 4, 5, 6})) triangles.push_back(t);
  const auto turned = sweep_closed(7, located(sorted(triangles)));
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ(turned->n_components(), 2U);
  EXPECT_EQ(turned->component(0), 0U);
  EXPECT_EQ(turned->component(7), 1U);
}

TEST(SweepClosed, RefusesWhatIsNotClosed) {
  const auto torus = sorted(forget(tests::torus(5, 6)));
  const std::size_t n = 30;
  ASSERT_TRUE(sweep_closed(n, located(torus)).has_value());
  for (std::size_t t = 0; t < torus.size(); ++t) {
    SCOPED_TRACE(testing::Message() << "without triangle " << t);
    auto open = torus;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(t));
    EXPECT_FALSE(sweep_closed(n, located(open)).has_value());
  }
  // Two more at the edge from 0 to 1, with four at it.
  auto pinched = torus;
  for (const Triangle& t :
       {Triangle{VertexId{0}, VertexId{1}, VertexId{n}},
        Triangle{VertexId{0}, VertexId{1}, VertexId{n + 1}},
        Triangle{VertexId{0}, VertexId{n}, VertexId{n + 1}},
        Triangle{VertexId{1}, VertexId{n}, VertexId{n + 1}}})
    pinched.push_back(t);
  EXPECT_FALSE(sweep_closed(n + 2, located(sorted(pinched))).has_value());
  EXPECT_FALSE(
      orient(std::vector<Point3>(n + 2), located(sorted(pinched))).is_closed);
}

TEST(SweepClosed, RefusesWhatCannotBeTurnedAlikeOrIsNotInOrder) {
  const auto plane = sorted(forget(tests::projective_plane()));
  EXPECT_FALSE(
      sweep_closed(tests::projective_plane().vertices.size(), located(plane)));
  auto torus = sorted(forget(tests::torus(5, 6)));
  std::swap(torus.front(), torus.back());
  EXPECT_FALSE(sweep_closed(30, located(torus)).has_value());
}

TEST(Orient, TurnsHugeAndTinySurfacesOutward) {
  for (const double size : {1e300, 1e-300}) {
    IndexedMesh mesh = tests::tetrahedron();
    for (auto& p : mesh.vertices) p *= size;
    const auto surface = orient(mesh.vertices, located(forget(mesh)));
    const auto unit =
        orient(tests::tetrahedron().vertices, located(forget(mesh)));
    EXPECT_EQ(surface.triangles, unit.triangles);
  }
}

/// Volumes as seen from the origin would be lost in rounding.
TEST(Orient, TurnsFarSurfacesOutward) {
  for (const double far : {1e7, 1e9, 1e11}) {
    IndexedMesh mesh = tests::torus(6, 5);
    for (auto& p : mesh.vertices) p += Point3(far, -far, far / 3);
    const auto surface = orient(mesh.vertices, located(forget(mesh)));
    for (auto& p : mesh.vertices) p -= Point3(far, -far, far / 3);
    EXPECT_TRUE(check_surface(mesh.vertices, surface.triangles).outward);
  }
}

TEST(Orient, LeavesWhatHasNoVolumeAsItsFirstTriangleIs) {
  const IndexedMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                         {{0, 1, 2}, {1, 2, 3}}};
  const auto surface = orient(flat.vertices, located(forget(flat)));
  EXPECT_EQ(surface.triangles[0], (OrientedTriangle{0, 1, 2}));
  EXPECT_EQ(surface.triangles[1], (OrientedTriangle{1, 3, 2}));
}

TEST(Orient, TurnsOpenSurfacesAlike) {
  IndexedMesh mesh = tests::torus(6, 6);
  mesh.triangles.resize(40);
  const auto surface = orient(mesh.vertices, located(forget(mesh)));
  EXPECT_FALSE(surface.is_closed);
  const IndexedMesh result{mesh.vertices, surface.triangles};
  EXPECT_TRUE(check_surface(result.vertices, result.triangles).oriented);
}

TEST(Orient, SaysWhereThereIsNoOrientation) {
  const IndexedMesh mesh = tests::projective_plane();
  EXPECT_FALSE(orient(mesh.vertices, located(forget(mesh))).is_closed);
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
  EXPECT_TRUE(orient(mesh.vertices, located(forget(mesh))).is_closed);
}

}  // namespace
}  // namespace umbrella
