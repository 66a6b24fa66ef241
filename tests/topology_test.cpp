#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/cell_labels.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/criterion.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/filter.h"
#include "umbrella/given_faces.h"
#include "umbrella/labelling_internal.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/point_groups_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

/// A torus of k x l squares, each cut along a diagonal.
std::vector<Triangle> grid_torus(std::uint32_t k, std::uint32_t l,
                                 std::uint32_t first) {
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return VertexId{first + (i % k) * l + j % l};
  };
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < k; ++i)
    for (std::uint32_t j = 0; j < l; ++j)
      for (Triangle t : {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                         Triangle{at(i, j), at(i, j + 1), at(i + 1, j + 1)}}) {
        std::sort(t.begin(), t.end());
        triangles.push_back(t);
      }
  return triangles;
}

TEST(EssentialLoops, GoRoundATorusTheShortWay) {
  EssentialLoops loops(5 * 9, grid_torus(5, 9, 0));
  EXPECT_EQ(loops.n_generators(), 2U);
  EXPECT_TRUE(loops.shortest(4).vertices.empty());
  EXPECT_EQ(loops.shortest(5).vertices.size(), 5U * 9);
}

/// Also far from the edges that labels make out.
TEST(EssentialLoops, GoThroughEveryVertexOfALongTube) {
  constexpr std::uint32_t kRings = 60;
  EssentialLoops loops(4 * kRings, grid_torus(4, kRings, 0));
  EXPECT_EQ(loops.shortest(4).vertices.size(), 4U * kRings);
}

TEST(EssentialLoops, AreThereOnSurfacesWithHandlesOnly) {
  const std::vector<Triangle> tetrahedron = {
      {VertexId{0}, VertexId{1}, VertexId{2}},
      {VertexId{0}, VertexId{1}, VertexId{3}},
      {VertexId{0}, VertexId{2}, VertexId{3}},
      {VertexId{1}, VertexId{2}, VertexId{3}}};
  EssentialLoops none(4, tetrahedron);
  EXPECT_EQ(none.n_generators(), 0U);
  EXPECT_TRUE(none.shortest(8).vertices.empty());

  // Vertex 0 is on no triangle.
  std::vector<Triangle> two = grid_torus(4, 6, 1);
  const std::vector<Triangle> other = grid_torus(6, 7, 25);
  two.insert(two.end(), other.begin(), other.end());
  EssentialLoops loops(1 + 24 + 42, two);
  EXPECT_EQ(loops.n_generators(), 4U);
  const auto on_loops = loops.shortest(5).vertices;
  EXPECT_EQ(on_loops.size(), 24U);  // of the first torus
  EXPECT_LT(on_loops.back(), VertexId{25});
}

TEST(EssentialLoops, TellTubesByLoopsThatDoNotMeet) {
  EssentialLoops long_tube(5 * 9, grid_torus(5, 9, 0));
  EXPECT_TRUE(long_tube.shortest(5).loops.empty());
  EssentialLoops four(3 * 4, grid_torus(3, 4, 0));
  EXPECT_TRUE(four.shortest(3).loops.empty());
  EssentialLoops three(3 * 3, grid_torus(3, 3, 0));
  const auto found = three.shortest(3);
  std::set<VertexId> met;
  for (const auto& loop : found.loops) {
    EXPECT_EQ(loop.size(), 3U);
    met.insert(loop.begin(), loop.end());
  }
  EXPECT_EQ(met.size(), 9U);
  EXPECT_TRUE(std::equal(met.begin(), met.end(), found.vertices.begin(),
                         found.vertices.end()));

  std::vector<Triangle> both = grid_torus(5, 9, 0);
  const std::vector<Triangle> other = grid_torus(3, 3, 45);
  both.insert(both.end(), other.begin(), other.end());
  EssentialLoops loops(45 + 9, both);
  const auto round_no_tube = loops.shortest(5).loops;
  EXPECT_FALSE(round_no_tube.empty());
  for (const auto& loop : round_no_tube) EXPECT_GE(loop.front(), VertexId{45});
}

TEST(EssentialLoops, NeedMoreThanOneWordOfBits) {
  std::vector<Triangle> all;
  constexpr std::uint32_t kTori = 40;
  for (std::uint32_t i = 0; i < kTori; ++i) {
    const auto torus = grid_torus(3, 4, 12 * i);
    all.insert(all.end(), torus.begin(), torus.end());
  }
  EssentialLoops loops(12 * kTori, all);
  EXPECT_EQ(loops.n_generators(), 2 * kTori);
  std::vector<bool> has_loop(kTori);
  for (const VertexId v : loops.shortest(3).vertices)
    has_loop[index(v) / 12] = true;
  EXPECT_EQ(std::count(has_loop.begin(), has_loop.end(), true), kTori);
}

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
  for (const double gap : {0.5, 2.5, 4.0}) {
    SCOPED_TRACE(testing::Message() << "gap " << gap);
    const delaunay::Triangulation3 triangulation(two_spheres(gap, 3));
    const auto ranked = ranked_triangles(triangulation);
    const auto filtered =
        umbrella_filter(triangulation.points().size(), ranked);
    const WorkingSurface surface(triangulation.points().size(),
                                 filtered.triangles);
    PointGroups groups(triangulation, filtered.triangles, surface);
    const auto rows = triangulation.vertex_of_row();
    const std::size_t n_all = kLarge + kSmall;
    EXPECT_EQ(groups.n_points_with(rows.first(1)), gap > 3 ? kLarge : n_all);
    EXPECT_EQ(groups.n_points_with(rows.last(2)), gap > 3 ? kSmall : n_all);
    EXPECT_EQ(groups.n_points_with(std::array{rows.front(), rows.back()}),
              n_all);
  }
}

TEST(PointGroups, TakeInWhateverIsNearToPointsWithoutATriangle) {
  const delaunay::Triangulation3 triangulation(two_spheres(4, 3));
  const WorkingSurface surface(triangulation.points().size());
  PointGroups groups(triangulation, {}, surface);
  EXPECT_EQ(groups.n_points_with(triangulation.vertex_of_row().first(1)),
            kLarge + kSmall);
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

/// A tube about an arc, with round ends half a spacing apart.
std::vector<Point3> horseshoe(std::uint64_t seed) {
  constexpr double kTube = 0.25, kSpacing = 0.09, kGap = 2 * kTube + 0.05;
  constexpr double kHalf = std::numbers::pi - kGap / 2;
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point3> points;
  for (int i = 0; i < 40'000; ++i) {
    const double start = unit(rng) * kHalf;
    Point3 p = Point3(std::cos(start), std::sin(start), 0) +
               kTube * Point3(unit(rng), unit(rng), unit(rng));
    const double angle = std::clamp(std::atan2(p.y(), p.x()), -kHalf, kHalf);
    const Point3 center(std::cos(angle), std::sin(angle), 0);
    p = center + kTube * (p - center).normalized();
    if (std::all_of(points.begin(), points.end(), [&](const Point3& q) {
          return (p - q).norm() >= kSpacing;
        }))
      points.push_back(p);
  }
  return points;
}

TEST(Topology, LosesHandlesThatTheSamplingDoesNotMean) {
  std::size_t n_removed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const std::vector<Point3> points = horseshoe(seed);
    ReconstructOptions options;
    options.closing.handle_edges = 0;
    const Reconstruction before = reconstruct(points, options);
    const Reconstruction after = reconstruct(points);
    EXPECT_EQ(before.surface.genus.value() -
                  static_cast<std::int64_t>(after.closing.handles_removed),
              after.surface.genus);
    EXPECT_EQ(after.surface.components, 1U);
    EXPECT_TRUE(after.surface.manifold && after.surface.outward);
    EXPECT_TRUE(after.surface.unused_vertices.empty());
    EXPECT_EQ(after.surface.triangles + 4 * after.closing.handles_removed,
              before.surface.triangles);
    n_removed += after.closing.handles_removed;
  }
  EXPECT_GT(n_removed, 0U);
}

/// A plate with noise as large as it is thick is all handles. Some take a
/// second ring about their loop.
TEST(Topology, LosesHandlesWithoutFallingApart) {
  for (const std::uint64_t seed : {1, 2}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Reconstruction result = reconstruct(
        shapes::sample("plate", 1000, {.seed = seed, .noise = 1.5}));
    EXPECT_EQ(result.closing.handles_removed, 11U);
    EXPECT_EQ(result.surface.genus, seed == 1 ? 1 : 0);
    EXPECT_EQ(result.surface.components, 1U);
    EXPECT_TRUE(result.surface.manifold && result.surface.outward);
    EXPECT_TRUE(result.surface.unused_vertices.empty());
  }
}

/// However few handles there are for so many parts.
TEST(Topology, LosesAHandleAlsoBesideOtherParts) {
  std::size_t n_removed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::vector<Point3> points = horseshoe(seed);
    const Reconstruction alone = reconstruct(points);
    for (const int i : {1, 2})
      for (const Point3& p : shapes::sample("sphere", 300, {.seed = seed}))
        points.push_back(p + Point3(0, 0, 9 * i));
    const Reconstruction beside = reconstruct(points);
    EXPECT_EQ(beside.closing.handles_removed, alone.closing.handles_removed);
    EXPECT_EQ(beside.surface.genus, alone.surface.genus);
    EXPECT_EQ(beside.surface.components, 3U);
    n_removed += alone.closing.handles_removed;
  }
  EXPECT_GT(n_removed, 0U);
}

TEST(Topology, KeepsHandlesThatAreSampled) {
  for (const std::string_view shape : {"torus", "3holes"}) {
    SCOPED_TRACE(shape);
    const Reconstruction result = reconstruct(shapes::sample(shape, 2500));
    EXPECT_EQ(result.surface.genus, shape == "torus" ? 1 : 3);
    EXPECT_EQ(result.closing.handles_removed, 0U);
  }
}

/// So few points that five go round the tube.
TEST(Topology, KeepsThinTubes) {
  for (const auto& [shape, n] :
       {std::pair{"torus", 70}, {"torus", 90}, {"knot", 600}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(testing::Message() << shape << ' ' << n << ", " << seed);
      const std::vector<Point3> points = shapes::sample(
          shape, static_cast<std::size_t>(n), {.seed = seed, .noise = 0});
      const Reconstruction result = reconstruct(points);
      EXPECT_EQ(result.surface.genus, 1);
      EXPECT_EQ(result.closing.handles_removed, 0U);
    }
}

void expect_whole(std::span<const Point3> points, std::int64_t genus) {
  const SurfaceReport surface = reconstruct(points).surface;
  EXPECT_TRUE(surface.closed && surface.manifold);
  EXPECT_EQ(surface.genus, genus);
  EXPECT_EQ(surface.components, 1U);
  EXPECT_TRUE(surface.unused_vertices.empty());
}

/// 0.05 thick with 2.2 of area: so many points are one thickness apart.
TEST(Topology, SeesAPlateThatIsOneSpacingThick) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_whole(shapes::sample("plate", 880, {.seed = seed}), 0);
  }
}

/// 0.1 apart with 2 of area: so 200 points are as far from each other. They
/// have open rims, over which the surface has to find its own way: of 200
/// samples of 200 points, six get a hole through both.
TEST(Topology, SeesTwoSheetsThatAreOneSpacingApart) {
  for (const std::size_t n : {150, 200}) {
    SCOPED_TRACE(testing::Message() << n << " points");
    int n_right = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const SurfaceReport surface =
          reconstruct(shapes::sample("two-sheets", n, {.seed = seed})).surface;
      EXPECT_TRUE(surface.closed && surface.manifold);
      EXPECT_EQ(surface.components, 1U);
      EXPECT_TRUE(surface.unused_vertices.empty());
      n_right += surface.genus == 0 ? 1 : 0;
    }
    EXPECT_GE(n_right, 9);
  }
}

/// Of the extent, in each coordinate.
TEST(Topology, SeesAKnotThroughNoiseOfOnePercent) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::vector<Point3> points =
        shapes::sample("knot", 5000, {.seed = seed, .noise = 0});
    double extent = 0;
    for (const Point3& p : points)
      extent = std::max(extent, 2 * p.cwiseAbs().maxCoeff());
    std::mt19937_64 rng(seed);
    std::uniform_real_distribution<double> shift(-0.01 * extent, 0.01 * extent);
    for (Point3& p : points) p += Point3(shift(rng), shift(rng), shift(rng));
    expect_whole(points, 1);
  }
}

SurfaceReport judged(const delaunay::Triangulation3& triangulation,
                     std::span<const LocatedTriangle> triangles) {
  std::vector<IndexedTriangle> indexed;
  for (const LocatedTriangle& t : triangles) {
    const auto& [a, b, c] = t.corners;
    indexed.push_back({static_cast<std::uint32_t>(a),
                       static_cast<std::uint32_t>(b),
                       static_cast<std::uint32_t>(c)});
  }
  return check_surface(triangulation.points(), indexed);
}

/// Cuts off corners with three triangles; @return their vertices
std::vector<VertexId> cut_corners(const delaunay::Triangulation3& triangulation,
                                  std::vector<LocatedTriangle>& triangles) {
  std::set<Triangle> surface;
  std::vector<int> degree(triangulation.points().size());
  for (const LocatedTriangle& t : triangles) {
    surface.insert(t.corners);
    for (const VertexId v : t.corners) ++degree[index(v)];
  }
  std::vector<VertexId> cut;
  for (std::uint32_t i = 0; i < 4 * triangulation.n_finite_cells(); ++i) {
    const delaunay::Facet facet(delaunay::CellId{i / 4}, i % 4);
    const VertexId v = triangulation.cell(facet.cell()).vertex[i % 4];
    int n_at_v = 0;
    for (unsigned k = 0; k < 4; ++k)
      n_at_v += surface.count(umbrella::corners(
                    triangulation, delaunay::Facet(facet.cell(), k))) > 0 &&
                k != i % 4;
    if (n_at_v < 3 || degree[index(v)] != 3) continue;
    const Triangle base = umbrella::corners(triangulation, facet);
    if (!surface.insert(base).second) continue;
    cut.push_back(v);
    std::erase_if(triangles, [&](const LocatedTriangle& t) {
      return std::find(t.corners.begin(), t.corners.end(), v) !=
             t.corners.end();
    });
    triangles.push_back({base, facet});
    for (const VertexId w : base) degree[index(w)] = 0;  // not these, too
    degree[index(v)] = 0;
  }
  std::sort(triangles.begin(), triangles.end(),
            [](const auto& a, const auto& b) { return a.corners < b.corners; });
  return cut;
}

/// @return how many points were left out
std::size_t expect_brought_in(const delaunay::Triangulation3& triangulation) {
  std::vector<VertexId> open(triangulation.vertex_of_row().begin(),
                             triangulation.vertex_of_row().end());
  std::sort(open.begin(), open.end());
  const auto ranked = ranked_triangles(triangulation);
  std::vector<LocatedTriangle> certain;
  for (const RankedTriangle& t : clean_up(open.size(), ranked).triangles)
    certain.push_back({t.corners, t.facet});
  auto triangles = close_by_cell_labels(triangulation, certain, open).triangles;
  const SurfaceReport before = judged(triangulation, triangles);
  const std::vector<VertexId> cut = cut_corners(triangulation, triangles);
  const std::size_t n_out = before.unused_vertices.size() + cut.size();
  EXPECT_EQ(judged(triangulation, triangles).unused_vertices.size(), n_out);

  const LocalRepair repaired = repair_locally(triangulation, {}, triangles);
  const SurfaceReport after = judged(triangulation, triangles);
  EXPECT_TRUE(after.closed && after.manifold);
  EXPECT_EQ(after.components, 1U);
  EXPECT_EQ(after.genus, before.genus);
  EXPECT_TRUE(after.unused_vertices.empty());
  EXPECT_TRUE(repaired.left_out.empty());
  EXPECT_EQ(repaired.brought_in, n_out);
  return n_out;
}

TEST(LocalRepair, BringsInPointsThatAreLeftOut) {
  std::size_t n_out = 0;
  for (const std::string_view shape : {"sphere", "torus", "3holes"})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(testing::Message() << shape << ", seed " << seed);
      n_out += expect_brought_in(delaunay::Triangulation3(
          shapes::sample(shape, 1000, {.seed = seed, .noise = 0.3})));
    }
  EXPECT_GE(n_out, 4U);
}

/// Far below the hull: what hangs together with them by one edge is not enough.
TEST(LocalRepair, BringsInPointsOfAVolume) {
  for (const std::uint64_t seed : {1, 2, 3, 5, 12}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const delaunay::Triangulation3 triangulation(
        shapes::sample("uniform", 400, {.seed = seed, .noise = 0.3}));
    std::vector<VertexId> open(triangulation.vertex_of_row().begin(),
                               triangulation.vertex_of_row().end());
    std::sort(open.begin(), open.end());
    auto triangles = close_by_cell_labels(triangulation, {}, open).triangles;
    const SurfaceReport before = judged(triangulation, triangles);
    ASSERT_FALSE(before.unused_vertices.empty());
    ASSERT_EQ(before.components, 1U);

    const LocalRepair repaired = repair_locally(triangulation, {}, triangles);
    const SurfaceReport after = judged(triangulation, triangles);
    EXPECT_EQ(repaired.brought_in, before.unused_vertices.size());
    EXPECT_TRUE(repaired.left_out.empty());
    EXPECT_TRUE(after.closed && after.manifold);
    EXPECT_TRUE(after.unused_vertices.empty());
    EXPECT_EQ(after.components, 1U);
  }
}

TEST(SlowLocalRepair, BringsInAllPointsOfAScan) {
  std::ifstream file("data/real/point_set_3.xyz");
  if (!file) GTEST_SKIP() << "no scan: run scripts/fetch_data.sh";
  std::vector<Point3> points;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    if (Point3 p; row >> p.x() >> p.y() >> p.z()) points.push_back(p);
  }
  ASSERT_EQ(points.size(), 8075U);
  const Reconstruction result = reconstruct(points);
  EXPECT_GT(result.closing.brought_in, 0U);
  EXPECT_TRUE(result.surface.closed && result.surface.manifold);
  EXPECT_TRUE(result.surface.unused_vertices.empty());
}

/// The surface of each sphere alone, as triangles of both.
std::vector<LocatedTriangle> surfaces_apart(
    const std::vector<Point3>& points,
    const delaunay::Triangulation3& triangulation) {
  std::vector<IndexedTriangle> faces;
  for (const auto& [first, n] : {std::pair{0UL, kLarge}, {kLarge, kSmall}})
    for (IndexedTriangle t :
         reconstruct(std::span(points).subspan(first, n)).triangles) {
      for (std::uint32_t& row : t) row += static_cast<std::uint32_t>(first);
      faces.push_back(t);
    }
  const GivenFaces given =
      locate_faces(triangulation, Circumspheres(triangulation), faces);
  EXPECT_EQ(given.counts.kept, faces.size());
  std::vector<LocatedTriangle> triangles;
  for (const RankedTriangle& t : given.triangles)
    triangles.push_back({t.corners, t.facet});
  return triangles;
}

TEST(LocalRepair, JoinsPiecesThatHangTogether) {
  for (const double gap : {0.5, 4.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << ", seed " << seed);
      const std::vector<Point3> points = two_spheres(gap, seed);
      const delaunay::Triangulation3 triangulation(points);
      std::vector<LocatedTriangle> triangles =
          surfaces_apart(points, triangulation);
      ASSERT_EQ(judged(triangulation, triangles).components, 2U);

      const LocalRepair repaired = repair_locally(triangulation, {}, triangles);
      const SurfaceReport after = judged(triangulation, triangles);
      EXPECT_EQ(after.components, gap < 1 ? 1U : 2U);
      EXPECT_EQ(repaired.pieces_joined, gap < 1 ? 1U : 0U);
      EXPECT_EQ(repaired.handles_removed + repaired.brought_in, 0U);
      EXPECT_TRUE(after.closed && after.manifold);
      EXPECT_EQ(after.genus, 0);
      EXPECT_TRUE(after.unused_vertices.empty());
    }
}

}  // namespace
}  // namespace umbrella
