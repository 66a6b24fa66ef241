#include "umbrella/methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "tests/support/complexes.h"
#include "tests/support/point_sets.h"
#include "umbrella/certificate.h"
#include "umbrella/reconstruct.h"
#include "umbrella/solids.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;

std::vector<Triangle> corners(const std::vector<LocatedTriangle>& triangles) {
  std::vector<Triangle> result;
  for (const LocatedTriangle& t : triangles) result.push_back(t.corners);
  return result;
}

SurfaceReport certificate(const Triangulation3& t,
                          const std::vector<LocatedTriangle>& triangles) {
  std::vector<IndexedTriangle> indexed;
  for (const LocatedTriangle& triangle : triangles) {
    IndexedTriangle rows{};
    for (std::size_t i = 0; i < 3; ++i)
      rows[i] = static_cast<std::uint32_t>(triangle.corners[i]);
    indexed.push_back(rows);
  }
  return check_surface(t.points(), indexed);
}

constexpr auto kOrders = {CarveOrder::Bulge, CarveOrder::Gamma};

TEST(Sculpture, IsASphereWhateverThePoints) {
  for (const Family family : tests::kFamilies) {
    const Triangulation3 t(tests::make_points<3>(family, 16, 2));
    if (t.dimension() < 3) continue;
    for (const CarveOrder order : kOrders) {
      SCOPED_TRACE(tests::name(family));
      const auto report = certificate(t, sculpture(t, Circumspheres(t), order));
      EXPECT_TRUE(report.closed);
      EXPECT_TRUE(report.manifold);
      EXPECT_EQ(report.components, 1U);
      EXPECT_EQ(report.euler, 2);
    }
  }
}

TEST(Sculpture, GoesThroughEveryPointOfAConcaveBody) {
  const Triangulation3 t(shapes::sample("bumpy", 500));
  for (const CarveOrder order : kOrders) {
    const auto report = certificate(t, sculpture(t, Circumspheres(t), order));
    EXPECT_TRUE(report.unused_vertices.empty());
    EXPECT_EQ(report.triangles, 996U);
  }
}

// One point in a regular tetrahedron, nearest to one facet: the cell behind it
// has the largest ball beyond its facet, and is carved off.
TEST(Sculpture, CarvesTheLargestBulgeFirst) {
  const std::vector<Point3> points = {
      {1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {-0.2, -0.2, -0.2}};
  const Triangulation3 t(points);
  const auto row = t.vertex_of_row();
  Triangle nearest = {row[1], row[2], row[3]};
  std::sort(nearest.begin(), nearest.end());
  for (const CarveOrder order : kOrders) {
    const auto surface = corners(sculpture(t, Circumspheres(t), order));
    EXPECT_EQ(surface.size(), 6U);
    EXPECT_FALSE(std::binary_search(surface.begin(), surface.end(), nearest));
  }
}

bool all_edges_are_even(const std::vector<LocatedTriangle>& triangles) {
  std::map<std::pair<VertexId, VertexId>, int> count;
  for (const LocatedTriangle& t : triangles) {
    const auto& [a, b, c] = t.corners;
    for (const auto& edge : {std::pair(a, b), std::pair(a, c), std::pair(b, c)})
      ++count[edge];
  }
  return std::all_of(count.begin(), count.end(),
                     [](const auto& entry) { return entry.second % 2 == 0; });
}

TEST(BallMerge, IsTheBoundaryOfABody) {
  for (const Family family : tests::kFamilies) {
    const Triangulation3 t(tests::make_points<3>(family, 14, 2));
    const Circumspheres spheres(t);
    for (const double ratio : {0.5, 1.2, 1.8}) {
      SCOPED_TRACE(testing::Message() << tests::name(family) << ' ' << ratio);
      EXPECT_TRUE(all_edges_are_even(ball_merge(t, spheres, ratio)));
    }
  }
}

TEST(BallMerge, MergesAllOrNothingAtTheEnds) {
  const Triangulation3 t(tests::make_points<3>(Family::Uniform, 60, 2));
  const Circumspheres spheres(t);
  EXPECT_TRUE(ball_merge(t, spheres, 0).empty());
  EXPECT_EQ(ball_merge(t, spheres, 2).size(), 4U);  // one cell
}

TEST(BallMerge, FindsTheTorus) {
  const Triangulation3 t(shapes::sample("torus", 700));
  const auto report = certificate(t, ball_merge(t, Circumspheres(t)));
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_EQ(report.genus, 1);
  EXPECT_TRUE(report.unused_vertices.empty());
}

TEST(Methods, AreParsed) {
  EXPECT_TRUE(parse_method("umbrella").is_umbrella());
  EXPECT_EQ(parse_method("crust").name, "crust");
  EXPECT_EQ(parse_method("alpha=0.25").parameters[0], 0.25);
  const Method gamma = parse_method("gamma=-0.5:1e-1");
  EXPECT_EQ(gamma.parameters, (std::array{-0.5, 0.1}));
  for (const char* text :
       {"", "crusty", "crust=1", "alpha=", "alpha=x", "alpha=-1", "alpha=1:2",
        "beta=0.5", "beta=nan", "lambda=0.5", "lambda=0.7:0.2", "lambda=0:2",
        "gamma=0:", "cocone=91", "ballmerge=2.5", "umbrella=1"}) {
    SCOPED_TRACE(text);
    EXPECT_THROW(parse_method(text), std::invalid_argument);
  }
}

TEST(Methods, GiveWhatTheFilterWouldHaveChosen) {
  for (const MethodInfo& info : all_methods()) {
    if (info.name == "umbrella") continue;
    for (const Family family : {Family::Uniform, Family::Grid}) {
      SCOPED_TRACE(testing::Message() << info.name << tests::name(family));
      const Triangulation3 t(tests::make_points<3>(family, 40, 6));
      const Circumspheres spheres(t);
      const Method method = parse_method(info.name);
      const auto filtered = method_filter(method, t, spheres);
      const auto chosen = corners(method_triangles(method, t, spheres));
      ASSERT_EQ(filtered.triangles.size(), chosen.size());
      for (std::size_t i = 0; i < chosen.size(); ++i)
        EXPECT_EQ(filtered.triangles[i].corners, chosen[i]);
      for (std::size_t v = 0; v < t.points().size(); ++v)
        EXPECT_EQ(std::binary_search(filtered.without_umbrella.begin(),
                                     filtered.without_umbrella.end(),
                                     tests::vertex(v)),
                  !tests::has_cycle(
                      tests::link(filtered.triangles, tests::vertex(v))));
    }
  }
}

ReconstructOptions by_method(std::string_view method) {
  ReconstructOptions options;
  options.method = method;
  return options;
}

/// Definition 3.2 of [Adamy02], word by word.
bool is_surface_complex(const Reconstruction& result, std::size_t n_points) {
  std::vector<RankedTriangle> triangles;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> n_at_edge;
  for (const IndexedTriangle& t : result.triangles) {
    triangles.push_back(tests::ranked(t[0], t[1], t[2], 0));
    for (std::size_t i = 0; i < 3; ++i)
      ++n_at_edge[std::minmax(t[i], t[(i + 1) % 3])];
  }
  for (const auto& [edge, n] : n_at_edge)
    if (n != 2) return false;                 // (b)
  for (std::size_t v = 0; v < n_points; ++v)  // (a) and (c)
    if (!tests::is_simple_cycle(tests::link(triangles, tests::vertex(v))))
      return false;
  return true;
}

// Theorem 3.2 of [Adamy02]: what satisfies the program is a surface complex,
// wherever its triangles came from; and the certificate says the same.
TEST(Methods, CloseToASurfaceComplex) {
  for (const std::string_view shape : {"sphere", "torus", "cube"}) {
    const auto points = shapes::sample(shape, 100, {.noise = 0.1});
    for (const MethodInfo& info : all_methods()) {
      SCOPED_TRACE(testing::Message() << shape << ' ' << info.name);
      const auto result = reconstruct(points, by_method(info.name));
      EXPECT_EQ(is_surface_complex(result, points.size()),
                result.surface.closed && result.surface.manifold &&
                    result.surface.unused_vertices.empty());
      const ClosingReport& closing = result.closing;
      if (closing.regions > 0 && closing.feasible == closing.regions &&
          result.dropped_rows.empty()) {
        EXPECT_TRUE(is_surface_complex(result, points.size()));
      }
    }
  }
}

TEST(Methods, CloseADenseSphere) {
  const auto points = shapes::sample("sphere", 800, {.noise = 0.02});
  for (const MethodInfo& info : all_methods()) {
    SCOPED_TRACE(info.name);
    const auto result = reconstruct(points, by_method(info.name));
    EXPECT_TRUE(result.surface.closed && result.surface.manifold);
    EXPECT_TRUE(result.surface.outward);
    EXPECT_EQ(result.surface.genus, 0);
    EXPECT_TRUE(result.surface.unused_vertices.empty());
  }
}

TEST(Methods, FindTheHoleOfADenseTorus) {
  const auto points = shapes::sample("torus", 700);
  for (const MethodInfo& info : all_methods()) {
    SCOPED_TRACE(info.name);
    const auto result = reconstruct(points, by_method(info.name));
    EXPECT_TRUE(result.surface.closed && result.surface.manifold);
    const bool carves = info.name == "sculpture" || info.name == "constriction";
    EXPECT_EQ(result.surface.genus, carves ? 0 : 1);  // see sculpture()
  }
}

TEST(Methods, OtherThanKnownAreRefused) {
  const auto points = shapes::sample("sphere", 20);
  EXPECT_THROW(reconstruct(points, by_method("magic")), std::invalid_argument);
}

}  // namespace
}  // namespace umbrella
