#include "umbrella/cell_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

#include "apps/shapes.h"
#include "tests/support/point_sets.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/label_window_internal.h"
#include "umbrella/labelling_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

std::vector<VertexId> all_vertices(const Triangulation3& triangulation) {
  std::vector<VertexId> all(triangulation.points().size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = VertexId{v};
  return all;
}

std::vector<LocatedTriangle> all_triangles(const Triangulation3& t) {
  std::vector<LocatedTriangle> all;
  for (std::uint32_t c = 0; c < t.n_finite_cells(); ++c)
    for (unsigned i = 0; i < 4; ++i) {
      const auto& cell = t.cell(CellId{c});
      if (index(cell.neighbor[i].cell()) < c) continue;
      Triangle corners;
      for (unsigned k = 0; k < 3; ++k)
        corners[k] = cell.vertex[delaunay::kFacetCorners[i][k]];
      std::sort(corners.begin(), corners.end());
      all.push_back({corners, Facet(CellId{c}, i)});
    }
  return all;
}

/// What the clean-up leaves.
std::vector<LocatedTriangle> certain_triangles(const Triangulation3& t) {
  const std::size_t n = t.points().size();
  const auto clean =
      clean_up(n, umbrella_filter(n, ranked_triangles(t)).triangles);
  std::vector<LocatedTriangle> result;
  for (const RankedTriangle& r : clean.triangles)
    result.push_back({r.corners, r.facet});
  return result;
}

SurfaceReport judged(const Triangulation3& t, const CellLabelResult& result) {
  std::vector<IndexedTriangle> triangles;
  for (const auto& [corners, facet] : result.triangles)
    triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                         static_cast<std::uint32_t>(corners[1]),
                         static_cast<std::uint32_t>(corners[2])});
  return check_surface(t.points(), triangles);
}

/// The promises that hold for any input.
SurfaceReport expect_sound(const Triangulation3& t,
                           const CellLabelResult& result) {
  SurfaceReport report = judged(t, result);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.orientable);
  std::vector<std::uint32_t> left_out;
  for (const VertexId v : result.left_out)
    left_out.push_back(static_cast<std::uint32_t>(v));
  EXPECT_EQ(report.unused_vertices, left_out);
  EXPECT_TRUE(std::is_sorted(
      result.triangles.begin(), result.triangles.end(),
      [](const auto& a, const auto& b) { return a.corners < b.corners; }));
  return report;
}

template <class T>
std::vector<T> some_of(const std::vector<T>& all, double part,
                       std::mt19937_64& rng) {
  std::vector<T> some;
  for (const T& item : all)
    if (static_cast<double>(rng() % 1000) < 1000 * part) some.push_back(item);
  return some;
}

/// Sets of every family, with kept triangles and open vertices at random.
void expect_never_fails(std::uint64_t first_trial, std::uint64_t n_trials) {
  constexpr double kParts[] = {0, 0.02, 0.1, 0.5, 1};
  std::size_t n_sets = 0;
  for (std::uint64_t trial = first_trial; trial < first_trial + n_trials;
       ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::mt19937_64 rng(trial);
    const auto family = tests::kFamilies[rng() % std::size(tests::kFamilies)];
    const Triangulation3 t(
        tests::make_points<3>(family, 4 + rng() % 30, trial));
    if (t.dimension() < 3) continue;
    ++n_sets;
    const auto kept = some_of(all_triangles(t), kParts[rng() % 5], rng);
    const auto open = some_of(all_vertices(t), kParts[rng() % 5], rng);
    expect_sound(t, close_by_cell_labels(t, kept, open));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(n_sets, n_trials / 2);
}

TEST(CellLabels, NeverFailOnSmallSets) { expect_never_fails(0, 100); }

TEST(SlowCellLabels, NeverFailOnThousandsOfSmallSets) {
  expect_never_fails(100, 2500);
}

TEST(CellLabels, PassesThroughAVolumeOfPoints) {
  for (const std::size_t n : {50, 300, 1500}) {
    SCOPED_TRACE(testing::Message() << n << " points");
    const Triangulation3 t(shapes::sample("uniform", n, {}));
    const auto result = close_by_cell_labels(t, {}, all_vertices(t));
    expect_sound(t, result);
    EXPECT_LE(result.left_out.size(), n / 100);
  }
}

TEST(CellLabels, FillsInWhatIsMissing) {
  std::mt19937_64 rng(1);
  const std::pair<const char*, int> cases[] = {
      {"sphere", 0}, {"torus", 1}, {"3holes", 3}, {"cube", 0}};
  for (const auto& [shape, genus] : cases) {
    const Triangulation3 t(shapes::sample(shape, 1000, {}));
    for (const double part : {1.0, 0.9, 0.5}) {
      SCOPED_TRACE(testing::Message() << part << " of a " << shape);
      const auto kept = some_of(certain_triangles(t), part, rng);
      const auto result = close_by_cell_labels(t, kept, all_vertices(t));
      const SurfaceReport report = expect_sound(t, result);
      EXPECT_EQ(report.genus, genus);
      EXPECT_EQ(report.components, 1U);
      EXPECT_TRUE(result.left_out.empty());
      EXPECT_EQ(result.report.given_up, 0U);
    }
  }
}

std::vector<Triangle> corners_of(std::span<const LocatedTriangle> triangles) {
  std::vector<Triangle> corners;
  for (const LocatedTriangle& t : triangles) corners.push_back(t.corners);
  return corners;
}

/// A closed surface through all points, from the certain triangles.
std::vector<LocatedTriangle> closed_surface(const Triangulation3& t) {
  return close_by_cell_labels(t, certain_triangles(t), all_vertices(t))
      .triangles;
}

TEST(CellLabels, GiveBackAClosedSurface) {
  for (const char* shape : {"torus", "uniform", "cube"}) {
    SCOPED_TRACE(shape);
    const Triangulation3 t(shapes::sample(shape, 400, {}));
    const auto surface = closed_surface(t);
    const auto again = close_by_cell_labels(t, surface, {});
    EXPECT_EQ(corners_of(again.triangles), corners_of(surface));
    EXPECT_EQ(again.report.mended, 0U);
    EXPECT_EQ(again.report.given_up, 0U);
  }
}

TEST(CellLabels, LeaveAloneWhatIsNotOpen) {
  const Triangulation3 t(shapes::sample("torus", 1000, {}));
  std::mt19937_64 rng(4);
  auto kept = closed_surface(t);
  const auto whole = corners_of(kept);
  std::vector<VertexId> open;  // corners of what is taken out
  for (int i = 0; i < 40; ++i) {
    const auto gone =
        kept.begin() + static_cast<std::ptrdiff_t>(rng() % kept.size());
    open.insert(open.end(), gone->corners.begin(), gone->corners.end());
    kept.erase(gone);
  }
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  const auto result = close_by_cell_labels(t, kept, open);
  EXPECT_EQ(expect_sound(t, result).genus, 1);
  EXPECT_EQ(result.report.given_up, 0U);
  EXPECT_TRUE(result.left_out.empty());
  for (const LocatedTriangle& triangle : result.triangles) {
    const bool is_open = std::ranges::all_of(triangle.corners, [&](VertexId v) {
      return std::ranges::binary_search(open, v);
    });
    EXPECT_TRUE(is_open || std::ranges::binary_search(whole, triangle.corners));
  }
}

/// A closed surface without the triangles about some of its vertices.
struct Torn {
  std::vector<LocatedTriangle> kept;
  std::vector<VertexId> open;  // corners of what has gone, or some of them
};

Torn torn(std::vector<LocatedTriangle> surface, int n_places,
          std::mt19937_64& rng) {
  Torn result;
  for (int place = 0; place < n_places; ++place) {
    const VertexId v = surface[rng() % surface.size()].corners[rng() % 3];
    const auto mode = rng() % 4;  // 0: only v is open; 1: all but v
    std::erase_if(surface, [&](const LocatedTriangle& t) {
      if (std::ranges::count(t.corners, v) == 0) return false;
      if (mode != 1 && rng() % 4 == 0) return false;
      for (const VertexId corner : t.corners)
        if (mode > 1 || (mode == 0) == (corner == v))
          result.open.push_back(corner);
      return true;
    });
  }
  std::ranges::sort(result.open);
  result.open.erase(std::unique(result.open.begin(), result.open.end()),
                    result.open.end());
  result.kept = std::move(surface);
  return result;
}

/// Also where what is kept contradicts itself near open vertices, and where
/// points are bare.
TEST(CellLabels, SayTheSameInAWindow) {
  for (const char* shape : {"cube", "plate", "two-sheets"}) {
    const Triangulation3 t(shapes::sample(shape, 6000, {}));
    const auto surface = closed_surface(t);
    std::mt19937_64 rng(9);
    int n_windows = 0;
    for (int trial = 0; trial < 6; ++trial) {
      SCOPED_TRACE(testing::Message() << shape << ", trial " << trial);
      const auto [kept, open] = torn(surface, 1 + trial % 3, rng);
      n_windows += LabelWindow(t, kept, open).is_small() ? 1 : 0;
      const auto whole = close_by_cell_labels(t, kept, open);
      const auto same =
          close_by_cell_labels(t, kept, open, {.is_closed_elsewhere = true});
      EXPECT_EQ(corners_of(same.triangles), corners_of(whole.triangles));
      EXPECT_EQ(same.left_out, whole.left_out);
      EXPECT_EQ(same.report.mended, whole.report.mended);
      EXPECT_EQ(same.report.given_up, whole.report.given_up);
      for (const auto& [corners, facet] : same.triangles) {
        ASSERT_EQ(umbrella::corners(t, facet), corners);
        ASSERT_LT(facet.cell(),
                  t.cell(facet.cell()).neighbor[facet.index()].cell());
      }
    }
    EXPECT_GE(n_windows, 2) << shape;  // or the test shows nothing
  }
}

TEST(CellLabels, BringInPointsThatASurfaceLeavesOut) {
  for (const std::size_t n : {20, 200, 1000}) {
    SCOPED_TRACE(testing::Message() << n << " points");
    const Triangulation3 t(shapes::sample("uniform", n, {}));
    std::vector<LocatedTriangle> hull;
    for (const LocatedTriangle& triangle : all_triangles(t)) {
      const auto& cell = t.cell(triangle.facet.cell());
      if (t.cell(cell.neighbor[triangle.facet.index()].cell()).is_infinite())
        hull.push_back(triangle);
    }
    const auto result = close_by_cell_labels(t, hull, {});
    EXPECT_EQ(expect_sound(t, result).genus, 0);
    EXPECT_EQ(result.report.mended, 0U);
    EXPECT_LE(result.left_out.size(), n / 100);
    EXPECT_GT(result.report.brought_in, n / 3);
  }
}

TEST(CellLabels, DoNotDependOnTheOrderOfTriangles) {
  const Triangulation3 t(shapes::sample("uniform", 300, {}));
  std::mt19937_64 rng(8);
  auto kept = some_of(all_triangles(t), 0.1, rng);
  const auto expected = close_by_cell_labels(t, kept, all_vertices(t));
  for (int trial = 0; trial < 3; ++trial) {
    std::shuffle(kept.begin(), kept.end(), rng);
    const auto result = close_by_cell_labels(t, kept, all_vertices(t));
    EXPECT_EQ(corners_of(result.triangles), corners_of(expected.triangles));
  }
}

TEST(CellLabels, CloseTheSurfaceEvenIfStopped) {
  const Triangulation3 t(shapes::sample("uniform", 300, {}));
  const std::atomic<bool> stop = true;
  const auto kept = certain_triangles(t);
  const auto stopped =
      close_by_cell_labels(t, kept, all_vertices(t), {.stop = &stop});
  expect_sound(t, stopped);
  const auto whole = close_by_cell_labels(t, kept, all_vertices(t));
  EXPECT_GT(stopped.left_out.size(), whole.left_out.size());
  EXPECT_LT(10 * stopped.left_out.size(), t.points().size());
  EXPECT_EQ(stopped.report.improvements, 0U);
  const auto late =
      close_by_cell_labels(t, kept, all_vertices(t), {.seconds = 0});
  EXPECT_EQ(corners_of(late.triangles), corners_of(stopped.triangles));
}

/// A sphere, and a tetrahedron that stands beside it.
TEST(CellLabels, DissolveSmallPieces) {
  std::vector<Point3> points = shapes::sample("sphere", 300, {});
  for (const Point3& p : {Point3(1.1, 0, 0), Point3(1.13, 0.02, 0),
                          Point3(1.13, -0.02, 0.02), Point3(1.12, 0, -0.03)})
    points.push_back(p);
  const Triangulation3 t(points);
  const auto n_beside = [&](const LocatedTriangle& triangle) {
    return std::ranges::count_if(
        triangle.corners, [&](VertexId v) { return t.point(v).x() > 1.05; });
  };
  std::vector<LocatedTriangle> kept;
  for (const LocatedTriangle& triangle : certain_triangles(t))
    if (n_beside(triangle) == 0) kept.push_back(triangle);
  for (const LocatedTriangle& triangle : all_triangles(t))
    if (n_beside(triangle) == 3) kept.push_back(triangle);

  CellLabelOptions options;
  options.piece_triangles = 3;
  const auto apart = close_by_cell_labels(t, kept, all_vertices(t), options);
  EXPECT_EQ(expect_sound(t, apart).components, 2U);
  const auto joined = close_by_cell_labels(t, kept, all_vertices(t));
  EXPECT_EQ(expect_sound(t, joined).components, 1U);
  EXPECT_TRUE(joined.left_out.empty());
  EXPECT_EQ(joined.report.dissolved, 4U);
}

/// Where labels decide nearly all, the numbers of cells must not.
TEST(CellLabels, GiveTheSameSurfaceForAnyNumberOfThreads) {
  const auto points = tests::make_points<3>(tests::Family::Uniform, 9000, 5);
  std::vector<CellLabelResult> results;
  for (const unsigned threads : {1U, 2U, 3U}) {
    const Triangulation3 t(points, threads);
    results.push_back(
        close_by_cell_labels(t, certain_triangles(t), all_vertices(t)));
    expect_sound(t, results.back());
    for (const auto& [corners, facet] : results.back().triangles) {
      ASSERT_EQ(umbrella::corners(t, facet), corners);
      ASSERT_LT(facet.cell(),
                t.cell(facet.cell()).neighbor[facet.index()].cell());
    }
  }
  const auto corners = [](const CellLabelResult& result) {
    std::vector<Triangle> all;
    for (const LocatedTriangle& t : result.triangles) all.push_back(t.corners);
    return all;
  };
  for (std::size_t i = 1; i < results.size(); ++i)
    EXPECT_EQ(corners(results[i]), corners(results[0]));
}

}  // namespace
}  // namespace umbrella
