#include "delaunay/canonical_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "delaunay/validate.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using tests::Family;
using tests::make_points;

TEST(CanonicalCells, AreASoundTriangulation) {
  for (const Family family :
       {Family::Uniform, Family::Grid, Family::Cospherical}) {
    const Triangulation3 original(make_points<3>(family, 400, 1));
    const CanonicalCells cells(original);
    EXPECT_EQ(first_violation(cells.triangulation()), "");
    EXPECT_EQ(cells.triangulation().n_finite_cells(),
              original.n_finite_cells());
  }
}

TEST(CanonicalCells, HaveTheSameNumbersForAnyNumberOfThreads) {
  const auto points = make_points<3>(Family::Uniform, 17000, 2);
  const Triangulation3 alone(points);
  const CanonicalCells expected(alone);
  bool some_number_differs = false;
  for (const unsigned threads : {2U, 4U}) {
    const Triangulation3 original(points, threads);
    const CanonicalCells cells(original);
    ASSERT_EQ(original.cells().size(), alone.cells().size());
    for (std::uint32_t c = 0; c < alone.cells().size(); ++c) {
      const Cell& a = cells.triangulation().cell(CellId{c});
      const Cell& b = expected.triangulation().cell(CellId{c});
      ASSERT_EQ(a.vertex, b.vertex);
      ASSERT_EQ(a.neighbor, b.neighbor);
      some_number_differs =
          some_number_differs ||
          original.cell(CellId{c}).vertex != alone.cell(CellId{c}).vertex;
    }
  }
  EXPECT_TRUE(some_number_differs);  // or the test shows nothing
}

TEST(CanonicalCells, TranslateFacetsBothWays) {
  const Triangulation3 original(make_points<3>(Family::Uniform, 300, 3));
  const CanonicalCells cells(original);
  const auto corners = [](const Triangulation3& t, Facet f) {
    auto result = t.cell(f.cell()).vertex;
    std::swap(result[f.index()], result[3]);  // the apex last
    std::sort(result.begin(), result.begin() + 3);
    return result;
  };
  for (std::uint32_t c = 0; c < original.cells().size(); ++c)
    for (unsigned i = 0; i < 4; ++i) {
      const Facet facet(CellId{c}, i);
      const Facet copy = cells.from_original(facet);
      ASSERT_EQ(cells.to_original(copy), facet);
      ASSERT_EQ(corners(cells.triangulation(), copy), corners(original, facet));
    }
}

}  // namespace
}  // namespace delaunay
