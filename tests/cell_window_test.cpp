#include "delaunay/cell_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "delaunay/canonical_cells.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using tests::Family;
using tests::make_points;

CellId cell_id(std::size_t c) { return CellId{static_cast<std::uint32_t>(c)}; }

/// Each finite cell with this chance, in a random order.
std::vector<CellId> some_cells(const Triangulation3& t, unsigned percent,
                               std::mt19937_64& rng) {
  std::vector<CellId> cells;
  for (std::size_t c = 0; c < t.n_finite_cells(); ++c)
    if (rng() % 100 < percent) cells.push_back(cell_id(c));
  std::shuffle(cells.begin(), cells.end(), rng);
  return cells;
}

TEST(CellWindow, OfAllCellsIsTheCanonicalTriangulation) {
  for (const Family family :
       {Family::Uniform, Family::Grid, Family::Cospherical}) {
    const Triangulation3 original(make_points<3>(family, 300, 1));
    std::mt19937_64 rng(1);
    const CellWindow window(original, some_cells(original, 100, rng));
    const Triangulation3& t = window.triangulation();
    const CanonicalCells cells(original);
    ASSERT_EQ(t.cells().size(), cells.triangulation().cells().size());
    for (std::size_t c = 0; c < t.cells().size(); ++c) {
      EXPECT_EQ(t.cells()[c].vertex, cells.triangulation().cells()[c].vertex);
      EXPECT_EQ(t.cells()[c].neighbor,
                cells.triangulation().cells()[c].neighbor);
    }
  }
}

/// With all that it says about the original.
void expect_copy(const Triangulation3& original, const CellWindow& window,
                 Facet f) {
  const Triangulation3& t = window.triangulation();
  const auto& vertex = t.cell(f.cell()).vertex;
  for (const VertexId v : vertex) {
    EXPECT_EQ(t.point(v), original.point(window.to_original(v)));
    EXPECT_EQ(window.from_original(window.to_original(v)), v);
  }
  const Facet there = window.to_original(f);
  EXPECT_EQ(window.from_original(there), f);
  EXPECT_EQ(window.original_of(f.cell()), there.cell());
  EXPECT_EQ(original.cell(there.cell()).vertex[there.index()],
            window.to_original(vertex[f.index()]));
  const Facet across = t.cell(f.cell()).neighbor[f.index()];
  EXPECT_EQ(t.cell(across.cell()).neighbor[across.index()], f);
  const Facet beyond = original.cell(there.cell()).neighbor[there.index()];
  EXPECT_EQ(window.original_of(across.cell()), beyond.cell());
  EXPECT_EQ(t.cell(across.cell()).is_infinite(),
            !window.has_cell(beyond.cell()));
}

TEST(CellWindow, HasTheSameNeighborsAsTheOriginal) {
  std::mt19937_64 rng(2);
  for (const unsigned percent : {0U, 1U, 20U, 90U}) {
    SCOPED_TRACE(testing::Message() << percent << " %");
    const Triangulation3 original(make_points<3>(Family::Uniform, 200, 2));
    const auto cells = some_cells(original, percent, rng);
    const CellWindow window(original, cells);
    EXPECT_EQ(window.triangulation().n_finite_cells(), cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (unsigned i = 0; i < 4; ++i)
        expect_copy(original, window, Facet(cell_id(c), i));
  }
}

TEST(CellWindow, NumbersCellsByTheirCorners) {
  std::mt19937_64 rng(3);
  const Triangulation3 original(make_points<3>(Family::Uniform, 500, 3));
  const CellWindow window(original, some_cells(original, 30, rng));
  const auto corners = [&](std::size_t c) {
    auto result = window.triangulation().cells()[c].vertex;
    std::sort(result.begin(), result.end());
    return result;
  };
  for (std::size_t c = 1; c < window.triangulation().n_finite_cells(); ++c)
    EXPECT_LT(corners(c - 1), corners(c));
}

}  // namespace
}  // namespace delaunay
