#include "umbrella/cell_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace umbrella
