// Bodies with bores and without, given by points on their edges alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

#include "tests/support/designed_bodies.h"
#include "umbrella/bores_internal.h"
#include "umbrella/flat_lids_internal.h"
#include "umbrella/lidded_bores_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

using support::add_ring;
using support::Circle;
using support::placed;
using support::Points;

/// A rectangle from the origin, n points on each side.
void add_outline(double width, double height, double z, int n, Points& points) {
  for (int i = 0; i < n; ++i) {
    const double part = static_cast<double>(i) / n;
    points.emplace_back(width * part, 0, z);
    points.emplace_back(width, height * part, z);
    points.emplace_back(width * (1 - part), height, z);
    points.emplace_back(0, height * (1 - part), z);
  }
}

/// Two rings of n points at either end.
Points tube(double inner_radius, double length, int n) {
  Points points;
  for (const double z : {0.0, length}) {
    add_ring({}, z, n, points);
    add_ring({.radius = inner_radius}, z, n, points);
  }
  return points;
}

Reconstruction closed(const Points& points, bool open_bores) {
  ReconstructOptions options;
  options.closing.open_bores = open_bores;
  return reconstruct(points, options);
}

/// A closed surface of these points, ready to be looked at.
struct Closed {
  delaunay::Triangulation3 triangulation;
  WorkingSurface surface;

  Closed(const Points& points, const Reconstruction& result)
      : triangulation(points),
        surface(triangulation.points().size(), triangles(result)) {}

  std::vector<RankedTriangle> triangles(const Reconstruction& result) const {
    std::map<Triangle, delaunay::Facet> facets;
    for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i) {
        const delaunay::Facet facet(delaunay::CellId{c}, i);
        facets.emplace(corners(triangulation, facet), facet);
      }
    std::vector<RankedTriangle> ranked;
    for (const IndexedTriangle& t : result.triangles) {
      Triangle c;
      for (unsigned i = 0; i < 3; ++i)
        c[i] = triangulation.vertex_of_row()[t[i]];
      std::sort(c.begin(), c.end());
      ranked.push_back({c, facets.at(c), {}});
    }
    return ranked;
  }
};

std::vector<FlatLid> lids_of(const Points& points) {
  const Closed closed_surface(points, closed(points, false));
  std::vector<FlatLid> lids =
      find_flat_lids(closed_surface.triangulation, closed_surface.surface);
  const int exponent = closed_surface.triangulation.scale_exponent();
  for (FlatLid& lid : lids) lid.radius = std::ldexp(lid.radius, exponent);
  return lids;
}

TEST(FlatLids, AreTheTwoEndsOfACylinder) {
  std::mt19937_64 rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const int n = 8 + static_cast<int>(rng() % 60);
    Points points;
    for (const double z : {0.0, 1.5}) add_ring({.radius = 0.5}, z, n, points);
    const auto lids = lids_of(placed(points, trial, rng));
    ASSERT_EQ(lids.size(), 2U);
    for (const FlatLid& lid : lids) {
      EXPECT_EQ(lid.rim.size(), static_cast<std::size_t>(n));
      EXPECT_EQ(lid.triangles.size(), lid.rim.size() - 2);
      EXPECT_NEAR(lid.radius, 0.5, 1e-4);
      EXPECT_EQ(lid.n_flat, 0U);
    }
  }
}

TEST(FlatLids, HaveNoGapOfMoreThanAnEighth) {
  const auto n_lids = [](const std::vector<int>& sixteenths) {
    Points points;
    for (const double z : {0.0, 1.0})
      for (const int i : sixteenths) {
        const double angle = std::numbers::pi * i / 8;
        points.emplace_back(std::cos(angle), std::sin(angle), z);
      }
    return lids_of(points).size();
  };
  EXPECT_EQ(n_lids({0, 2, 4, 6, 8, 10, 12, 14}), 2U);
  EXPECT_EQ(n_lids({0, 2, 4, 6, 8, 10, 12}), 0U);
  EXPECT_EQ(n_lids({0, 1, 2, 3, 4, 6, 8, 10, 12, 13}), 0U);
  EXPECT_EQ(n_lids({0, 1, 2, 3, 4, 6, 8, 10, 12, 14}), 2U);
}

TEST(FlatLids, AreFlatAllRoundInAFace) {
  const auto lids = lids_of(tube(0.7, 2, 40));
  ASSERT_EQ(lids.size(), 2U);
  for (const FlatLid& lid : lids) {
    EXPECT_NEAR(lid.radius, 0.7, 1e-6);
    EXPECT_EQ(lid.n_flat, 40U);
    EXPECT_EQ(lid.spacing, 0);  // its neighbors are on the edge of the shape
  }
}

/// Many such tubes have two lids without it.
TEST(Bores, GoThroughLongTubes) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t n_lidded = 0, n_opened = 0;
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double inner = 0.5 + 0.2 * unit(rng), length = 2 + unit(rng);
    const Points points = placed(
        tube(inner, length, 32 + static_cast<int>(rng() % 32)), trial, rng);
    const Reconstruction before = closed(points, false);
    const Reconstruction after = closed(points, true);
    n_lidded += before.surface.genus == 0 ? 1 : 0;
    n_opened += after.closing.bores_opened;
    EXPECT_EQ(before.closing.bores_opened, 0U);
    EXPECT_EQ(after.surface.genus, 1);
    EXPECT_EQ(after.surface.components, 1U);
    EXPECT_TRUE(after.surface.unused_vertices.empty());
    EXPECT_EQ(after.triangles.size(),
              before.triangles.size() + 4 * after.closing.bores_opened);
  }
  EXPECT_GE(n_lidded, 3U);
  EXPECT_EQ(n_opened, n_lidded);
}

TEST(Bores, GoThroughBodiesOfAnySize) {
  const Points points = tube(0.7, 2, 40);
  const Reconstruction expected = closed(points, true);
  ASSERT_EQ(expected.closing.bores_opened, 1U);
  for (const int exponent : {-900, -300, -150, 150, 300, 900}) {
    SCOPED_TRACE(testing::Message() << "2^" << exponent);
    Points scaled = points;
    for (Point3& p : scaled) p *= std::ldexp(1, exponent);
    EXPECT_EQ(closed(scaled, true).triangles, expected.triangles);
  }
}

/// Each bore that is opened is one handle more.
void open_each(const Points& points, std::int64_t most_handles,
               std::size_t& n_opened) {
  const Reconstruction before = closed(points, false);
  const Reconstruction after = closed(points, true);
  ASSERT_TRUE(before.surface.genus && after.surface.genus);
  EXPECT_EQ(static_cast<std::size_t>(*after.surface.genus),
            static_cast<std::size_t>(*before.surface.genus) +
                after.closing.bores_opened);
  EXPECT_LE(*after.surface.genus, most_handles);
  n_opened += after.closing.bores_opened;
}

/// Each on its own, whatever the others do.
TEST(Bores, GoThroughAFlange) {
  std::mt19937_64 rng(3);
  std::size_t n_opened = 0;
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::uniform_real_distribution<double> thickness(0.05, 0.3);
    const double z_top = thickness(rng);
    const int n = 8 + static_cast<int>(rng() % 16);
    Points points;
    for (const double z : {0.0, z_top}) {
      add_ring({}, z, 48, points);
      add_ring({.radius = 0.4}, z, 32, points);
      for (int i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi * i / 3;
        add_ring({0.7 * std::cos(angle), 0.7 * std::sin(angle), 0.1}, z, n,
                 points);
      }
    }
    open_each(placed(points, trial, rng), 7, n_opened);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GE(n_opened, 6U);
}

/// A flange with six bores, with a pipe on it. About many of these bores a part
/// of the face has been lost, and the air is between their walls and the outer
/// one.
TEST(Bores, BringTheFaceAboutThemBack) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t n_opened = 0;
  for (int trial = 0; trial < 6; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double h = 0.05 + 0.1 * unit(rng), height = 0.4 + 0.6 * unit(rng);
    const int n = 8 + static_cast<int>(rng() % 16);
    Points points;
    for (const double z : {0.0, h}) {
      add_ring({}, z, 48, points);
      for (int i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi * i / 3;
        add_ring({0.75 * std::cos(angle), 0.75 * std::sin(angle), 0.08}, z, n,
                 points);
      }
    }
    for (const double z : {h, height}) add_ring({.radius = 0.5}, z, 32, points);
    for (const double z : {0.0, height})
      add_ring({.radius = 0.35}, z, 24, points);
    open_each(placed(points, trial, rng), 7, n_opened);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GE(n_opened, 9U);  // a half of them without the faces
}

Points disc_with_studs(std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double h = 0.08 + 0.22 * unit(rng);
  const int n = 10 + static_cast<int>(rng() % 14);
  Points points;
  for (const double z : {0.0, h}) add_ring({}, z, 48, points);
  for (int i = 0; i < 6; ++i)
    for (const double z : {h, 2 * h}) {
      const double angle = std::numbers::pi * i / 3;
      add_ring({0.7 * std::cos(angle), 0.7 * std::sin(angle), 0.1}, z, n,
               points);
    }
  return placed(points, 0, rng);
}

/// The tops of the studs lie in one plane, but there is no face all round them.
/// Handles that the surface may have by then come from elsewhere.
TEST(Bores, GoThroughNoStuds) {
  for (const std::uint64_t seed : {50, 51, 52, 53}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EXPECT_EQ(closed(disc_with_studs(seed), true).closing.bores_opened, 0U);
  }
}

Points pocket_over_boss(std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double h = 0.3 + 0.5 * unit(rng);
  const double boss = 0.1 + 0.3 * unit(rng), pocket = 0.1 + 0.3 * unit(rng);
  const int n = 8 + static_cast<int>(rng() % 24);
  const int n_side = 4 + static_cast<int>(rng() % 8);
  Points points;
  for (const double z : {0.0, h}) add_outline(2, 1, z, n_side, points);
  for (const double z : {-h, 0.0}) add_ring({1, 0.5, boss}, z, n, points);
  for (const double z : {h / 2, h}) add_ring({1, 0.5, pocket}, z, n, points);
  return placed(points, 0, rng);
}

/// The end of the boss is right, so one end alone would have its face.
TEST(Bores, GoThroughNoPocketOverABoss) {
  for (const std::uint64_t seed : {133, 134, 135, 335}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EXPECT_EQ(closed(pocket_over_boss(seed), true).closing.bores_opened, 0U);
  }
}

/// A body with a pit that ends in a point, and on its other side a circle.
Points pitted(double radius, int n_points_of_mouth) {
  Points points;
  for (const double z : {0.0, 1.0}) add_ring({}, z, 40, points);
  add_ring({.radius = 0.4}, 0, 24, points);
  Points mouth;
  add_ring({.radius = radius}, 1, 24, mouth);
  mouth.resize(n_points_of_mouth);
  points.insert(points.end(), mouth.begin(), mouth.end());
  points.emplace_back(0, 0, 0.4);
  return points;
}

std::vector<LiddedBore> bores_of(const Points& points) {
  const Closed closed_surface(points, closed(points, false));
  Effort effort = {0, 10000};
  return find_lidded_bores(closed_surface.triangulation, closed_surface.surface,
                           effort);
}

/// The point in the pit is what keeps a lid off its mouth.
TEST(Bores, GoFromALidToAMouth) {
  const Points points = pitted(0.4, 24);
  const std::vector<LiddedBore> bores = bores_of(points);
  ASSERT_EQ(bores.size(), 1U);
  EXPECT_EQ(bores[0].lids.size(), 22U);
  EXPECT_EQ(bores[0].ends.size(), 2U);
  EXPECT_EQ(bores[0].rims.size(), 48U);
  EXPECT_EQ(closed(points, false).surface.genus, 0);
  EXPECT_EQ(closed(points, true).surface.genus, 1);
}

TEST(Bores, GoFromALidToAMouthOfItsSizeOnly) {
  EXPECT_TRUE(bores_of(pitted(0.45, 24)).empty());
}

TEST(Bores, GoFromALidToAMouthThatIsAllRound) {
  EXPECT_EQ(bores_of(pitted(0.4, 23)).size(), 1U);
  EXPECT_TRUE(bores_of(pitted(0.4, 20)).empty());
}

/// The lid at the wide end alone has no reason to be there.
TEST(Bores, GoThroughAStep) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> length(0.2, 0.8);
  std::size_t n_opened = 0;
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double h = length(rng);
    const int n = 12 + static_cast<int>(rng() % 24);
    Points points;
    for (const double z : {0.0, h}) add_ring({}, z, 40, points);
    for (const double z : {0.0, h / 2}) add_ring({.radius = 0.3}, z, n, points);
    for (const double z : {h / 2, h}) add_ring({.radius = 0.5}, z, n, points);
    open_each(placed(points, trial, rng), 1, n_opened);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GE(n_opened, 2U);
}

struct Solid {
  std::string_view name;
  Points points;
};

/// Bodies with discs that are meant.
std::vector<Solid> solids(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> length(0.2, 1);
  const double h = length(rng);
  const int n = 12 + static_cast<int>(rng() % 24);
  std::vector<Solid> result(7);
  Points* next = &result[0].points;
  const auto at = [&](double radius, double z) {
    add_ring({.radius = radius}, z, n, *next);
  };
  result[0].name = "cylinder";
  for (const double z : {0.0, h}) at(1, z);
  result[1].name = "shaft with a collar";
  next = &result[1].points;
  for (const double z : {-h, 0.0, h, 2 * h}) at(0.5, z);
  for (const double z : {0.0, h}) at(1, z);
  result[2].name = "discs in rings about a centre";
  next = &result[2].points;
  for (const double z : {0.0, h}) {
    for (const double radius : {0.25, 0.5, 0.75, 1.0}) at(radius, z);
    next->emplace_back(0, 0, z);
  }
  result[3].name = "discs in rings about no centre";
  next = &result[3].points;
  for (const double z : {0.0, h})
    for (const double radius : {0.25, 0.5, 0.75, 1.0}) at(radius, z);
  result[4].name = "plate with a boss";
  next = &result[4].points;
  for (const double z : {0.0, h}) add_outline(2, 1, z, 6, *next);
  for (const double z : {h, 2 * h}) add_ring({1, 0.5, 0.3}, z, n, *next);
  result[5].name = "sphere without poles";
  next = &result[5].points;
  for (int i = 1; i < n; ++i)
    at(std::sin(std::numbers::pi * i / n), std::cos(std::numbers::pi * i / n));
  result[6].name = "grid of a box";
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      for (int z = 0; z <= 2; ++z)
        if (x % n == 0 || y % n == 0 || z % 2 == 0)
          result[6].points.emplace_back(x, y, z);
  return result;
}

TEST(Bores, GoThroughNoSolid) {
  std::mt19937_64 rng(4);
  for (int trial = 0; trial < 4; ++trial)
    for (const Solid& solid : solids(rng)) {
      SCOPED_TRACE(testing::Message()
                   << "trial " << trial << " " << solid.name);
      const Points points = placed(solid.points, trial, rng);
      const Reconstruction before = closed(points, false);
      const Reconstruction after = closed(points, true);
      EXPECT_EQ(after.closing.bores_opened, 0U);
      EXPECT_EQ(after.triangles, before.triangles);
    }
}

/// The nearest two of four lids on one axis have air between them.
TEST(Bores, GoThroughBodiesOnly) {
  Points points;
  for (const double z : {0.0, 2.5, 4.0, 6.5}) {
    add_ring({}, z, 40, points);
    add_ring({.radius = 0.6}, z, 40, points);
  }
  ReconstructOptions options;
  options.closing.joined_part = 0;  // two bodies are meant
  const Reconstruction after = reconstruct(points, options);
  EXPECT_EQ(after.surface.components, 2U);
  EXPECT_EQ(after.closing.bores_opened, 2U);
  EXPECT_EQ(after.surface.genus, 2);
}

TEST(Bores, LeaveASurfaceWithoutLidsAlone) {
  const Points points = tube(0.7, 1.8, 40);
  const Reconstruction opened = closed(points, true);
  Closed again(points, opened);
  const std::size_t n_indices = again.surface.n_indices();
  EXPECT_EQ(open_bores(again.triangulation, {}, again.surface).count, 0U);
  EXPECT_EQ(again.surface.n_indices(), n_indices);
}

/// They are meant.
TEST(Bores, LeaveGivenLidsAlone) {
  const Points points = tube(0.7, 2, 40);
  const Reconstruction lidded = closed(points, false);
  ASSERT_EQ(lidded.surface.genus, 0);
  ReconstructOptions options;
  options.faces = lidded.triangles;
  EXPECT_EQ(reconstruct(points, options).triangles, lidded.triangles);
}

}  // namespace
}  // namespace umbrella
