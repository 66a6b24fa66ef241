#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/pieces_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kRound = 9;

VertexId at(std::uint32_t i, std::uint32_t column) {
  return VertexId{column * kRound + i % kRound};
}

Triangle triangle(VertexId a, VertexId b, VertexId c) {
  Triangle t = {a, b, c};
  std::sort(t.begin(), t.end());
  return t;
}

/// The squares between a column of a torus and the next, each cut in two.
std::vector<LocatedTriangle> band(std::uint32_t column, std::uint32_t next) {
  std::vector<LocatedTriangle> result;
  for (std::uint32_t i = 0; i < kRound; ++i) {
    result.push_back(
        {triangle(at(i, column), at(i + 1, column), at(i + 1, next)), {}});
    result.push_back(
        {triangle(at(i, column), at(i, next), at(i + 1, next)), {}});
  }
  return result;
}

/// A disc on the vertices of each of two columns.
std::vector<LocatedTriangle> caps(std::uint32_t column, std::uint32_t next) {
  std::vector<LocatedTriangle> result;
  for (const std::uint32_t j : {column, next})
    for (std::uint32_t i = 1; i + 1 < kRound; ++i)
      result.push_back({triangle(at(0, j), at(i, j), at(i + 1, j)), {}});
  return result;
}

/// A torus that changes between some of its columns: bands go, and caps come,
/// and the other way round. So it falls into pieces, which join again.
class ChangingTorus {
 public:
  explicit ChangingTorus(std::uint32_t n_columns)
      : n_columns_(n_columns),
        is_cut_(n_columns),
        surface_(kRound * n_columns, given(n_columns)) {}

  const WorkingSurface& surface() const { return surface_; }

  struct Swap {
    std::vector<TriangleIndex> freed;
    std::vector<LocatedTriangle> chosen;
    std::vector<VertexId> vertices;
    Change change() const { return {freed, chosen, vertices}; }
  };
  Swap swap(std::uint32_t column) const {
    const std::uint32_t next = (column + 1) % n_columns_;
    Swap result;
    auto old = band(column, next);
    result.chosen = caps(column, next);
    if (is_cut_[column]) std::swap(old, result.chosen);
    for (const LocatedTriangle& t : old)
      result.freed.push_back(find(t.corners));
    for (std::uint32_t i = 0; i < kRound; ++i)
      for (const std::uint32_t j : {column, next})
        result.vertices.push_back(at(i, j));
    std::sort(result.vertices.begin(), result.vertices.end());
    return result;
  }
  void make(std::uint32_t column, const Swap& swap) {
    is_cut_[column] = !is_cut_[column];
    make(swap);
  }
  void make(const Swap& swap) {
    for (const TriangleIndex t : swap.freed) surface_.remove(t);
    for (const LocatedTriangle& t : swap.chosen) surface_.add(t);
  }

 private:
  static std::vector<RankedTriangle> given(std::uint32_t n_columns) {
    std::vector<RankedTriangle> result;
    for (std::uint32_t j = 0; j < n_columns; ++j)
      for (const LocatedTriangle& t : band(j, (j + 1) % n_columns))
        result.push_back({t.corners, {}, {}});
    return result;
  }
  TriangleIndex find(const Triangle& corners) const {
    TriangleIndex found = 0;
    surface_.for_each_at(corners[0], [&](TriangleIndex t) {
      if (surface_.corners(t) == corners) found = t;
    });
    return found;
  }

  std::uint32_t n_columns_;
  std::vector<bool> is_cut_;
  WorkingSurface surface_;
};

/// Cuts off 2 x 2 squares: frees those around them, and closes both sides.
ChangingTorus::Swap cut_off(const WorkingSurface& surface, std::uint32_t i,
                            std::uint32_t column) {
  ChangingTorus::Swap result;
  const auto loop = [&](std::uint32_t low, std::uint32_t high) {
    std::vector<VertexId> vertices;
    for (std::uint32_t k = low; k < high; ++k)
      vertices.push_back(at(i + k, column + low));
    for (std::uint32_t k = low; k < high; ++k)
      vertices.push_back(at(i + high, column + k));
    for (std::uint32_t k = high; k > low; --k)
      vertices.push_back(at(i + k, column + high));
    for (std::uint32_t k = high; k > low; --k)
      vertices.push_back(at(i + low, column + k));
    return vertices;
  };
  const auto outer = loop(0, 4), inner = loop(1, 3);
  const auto is_on = [](const std::vector<VertexId>& l, VertexId v) {
    return std::find(l.begin(), l.end(), v) != l.end();
  };
  for (const VertexId v : inner)
    surface.for_each_at(v, [&](TriangleIndex t) {
      const Triangle& c = surface.corners(t);
      const bool is_around =
          is_on(outer, c[0]) || is_on(outer, c[1]) || is_on(outer, c[2]);
      if (is_around &&
          std::count(result.freed.begin(), result.freed.end(), t) == 0)
        result.freed.push_back(t);
    });
  for (const auto& l : {outer, inner}) {
    for (std::size_t k = 1; k + 1 < l.size(); ++k)
      result.chosen.push_back({triangle(l[0], l[k], l[k + 1]), {}});
    result.vertices.insert(result.vertices.end(), l.begin(), l.end());
  }
  std::sort(result.vertices.begin(), result.vertices.end());
  return result;
}

/// Number of triangles and vertices of a piece.
using Known = std::pair<std::size_t, std::vector<VertexId>>;

/// All that PieceFinder::find() should find, by union-find over everything.
std::set<Known> small_pieces(const WorkingSurface& surface,
                             const Change& change,
                             const std::vector<bool>& is_open,
                             std::size_t limit) {
  const std::size_t n = surface.n_vertices();
  std::vector<Triangle> all;
  for (TriangleIndex t = 0; t < surface.n_indices(); ++t)
    if (surface.contains(t) &&
        std::find(change.freed.begin(), change.freed.end(), t) ==
            change.freed.end())
      all.push_back(surface.corners(t));
  std::set<std::uint32_t> with_chosen;
  for (const LocatedTriangle& t : change.chosen) all.push_back(t.corners);
  DisjointSets sets(n);
  for (const Triangle& t : all)
    for (const VertexId v : t) sets.unite(index(t[0]), index(v));
  for (const LocatedTriangle& t : change.chosen)
    with_chosen.insert(sets.root(index(t.corners[0])));

  std::set<Known> result;
  for (const std::uint32_t root : with_chosen) {
    Known piece;
    bool waits = false;
    for (const Triangle& t : all)
      piece.first += sets.root(index(t[0])) == root ? 1 : 0;
    for (std::uint32_t v = 0; v < n; ++v) {
      if (sets.root(v) != root) continue;
      piece.second.push_back(VertexId{v});
      waits = waits || (is_open[v] && !std::binary_search(
                                          change.vertices.begin(),
                                          change.vertices.end(), VertexId{v}));
    }
    if (piece.first <= limit && !waits) result.insert(piece);
  }
  return result;
}

std::set<Known> known(const std::vector<Piece>& pieces) {
  std::set<Known> result;
  for (const Piece& piece : pieces) {
    Known k{piece.n_triangles, piece.all_vertices};
    std::sort(k.second.begin(), k.second.end());
    result.insert(k);
  }
  return result;
}

/// Looks for pieces of at most one part in so many of the whole at random
/// changes, and makes most of those that leave nothing small.
void expect_found(std::uint64_t seed, std::uint32_t n_columns,
                  std::size_t n_open, std::size_t part) {
  std::mt19937_64 rng(seed);
  std::uniform_int_distribution<std::uint32_t> any_column(0, n_columns - 1);
  std::uniform_int_distribution<int> percent(0, 99);
  ChangingTorus torus(n_columns);
  std::vector<bool> is_open(torus.surface().n_vertices());
  for (std::size_t i = 0; i < n_open; ++i)
    is_open[index(at(2, any_column(rng)))] = true;
  const std::vector<bool> nothing_open(is_open.size());
  const std::size_t limit = 2 * kRound * n_columns / part;
  PieceFinder finder(torus.surface(), limit);
  std::size_t n_found = 0;
  for (int step = 0; step < 60; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    const std::uint32_t column = any_column(rng);
    const auto swap = torus.swap(column);
    const auto expected =
        small_pieces(torus.surface(), swap.change(), is_open, limit);
    ASSERT_EQ(known(finder.find(swap.change(), is_open)), expected);
    if (!finder.has_waited()) {
      EXPECT_EQ(
          small_pieces(torus.surface(), swap.change(), nothing_open, limit),
          expected);
    }
    n_found += expected.size();
    if (percent(rng) < (expected.empty() ? 80 : 10)) torus.make(column, swap);
  }
  EXPECT_GT(n_found, 0U);
}

TEST(PieceFinder, FindsAllSmallPiecesOfChangingSurfaces) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_found(seed, seed % 2 == 0 ? 40 : 300, seed % 3 == 0 ? 2 : 0, 5);
  }
}

TEST(PieceFinder, FindsSmallPiecesOfLargeSurfaces) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_found(seed, 200, seed % 3 == 0 ? 2 : 0, 30);
  }
}

/// With the change, or as the surface is.
std::ptrdiff_t n_pieces(const WorkingSurface& surface, const Change& change) {
  DisjointSets sets(surface.n_vertices());
  std::set<VertexId> used;
  const auto add = [&](const Triangle& t) {
    for (const VertexId v : t) sets.unite(index(t[0]), index(v));
    used.insert(t.begin(), t.end());
  };
  for (TriangleIndex t = 0; t < surface.n_indices(); ++t)
    if (surface.contains(t) &&
        std::find(change.freed.begin(), change.freed.end(), t) ==
            change.freed.end())
      add(surface.corners(t));
  for (const LocatedTriangle& t : change.chosen) add(t.corners);
  std::set<std::uint32_t> roots;
  for (const VertexId v : used) roots.insert(sets.root(index(v)));
  return static_cast<std::ptrdiff_t>(roots.size());
}

TEST(PieceFinder, CountsThePiecesThatAChangeAdds) {
  std::set<std::ptrdiff_t> met;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 rng(seed);
    std::uniform_int_distribution<std::uint32_t> any_column(0, 29);
    ChangingTorus torus(30);
    PieceFinder finder(torus.surface(), 100);
    for (int step = 0; step < 30; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      const std::uint32_t column = any_column(rng);
      const auto swap = torus.swap(column);
      const std::ptrdiff_t expected = n_pieces(torus.surface(), swap.change()) -
                                      n_pieces(torus.surface(), {});
      ASSERT_EQ(finder.n_pieces_added(swap.change()), expected);
      met.insert(expected);
      torus.make(column, swap);
    }
  }
  EXPECT_EQ(met, (std::set<std::ptrdiff_t>{-1, 0, 1}));
}

TEST(PieceFinder, CountsAPieceThatGoesForGood) {
  ChangingTorus torus(30);
  PieceFinder finder(torus.surface(), 100);
  for (const std::uint32_t column : {3U, 9U})
    torus.make(column, torus.swap(column));  // two pieces
  std::vector<TriangleIndex> freed;
  std::vector<VertexId> vertices;
  for (std::uint32_t j = 4; j <= 9; ++j)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      vertices.push_back(at(i, j));
      torus.surface().for_each_at(at(i, j), [&](TriangleIndex t) {
        if (torus.surface().corners(t)[0] == at(i, j)) freed.push_back(t);
      });
    }
  EXPECT_EQ(finder.n_pieces_added({freed, {}, vertices}), -1);
}

TEST(PieceFinder, FindsWhatOneChangeCutsOff) {
  ChangingTorus torus(60);
  const std::size_t limit = 200;
  PieceFinder finder(torus.surface(), limit);
  const std::vector<bool> is_open(torus.surface().n_vertices());
  for (const std::uint32_t column : {3U, 10U, 17U, 24U, 31U}) {
    SCOPED_TRACE(testing::Message() << "column " << column);
    const auto swap = cut_off(torus.surface(), column % kRound, column);
    const auto expected =
        small_pieces(torus.surface(), swap.change(), is_open, limit);
    ASSERT_EQ(expected.size(), 1U);
    EXPECT_EQ(known(finder.find(swap.change(), is_open)), expected);
    EXPECT_EQ(finder.is_one_piece(), column <= 24);  // so far
    // Two are cut off in spite of that.
    if (column < 24) continue;
    torus.make(swap);
    EXPECT_FALSE(finder.is_one_piece());
  }
}

/// The change that takes one back that was made.
ChangingTorus::Swap reverse(const WorkingSurface& surface,
                            const ChangingTorus::Swap& swap) {
  ChangingTorus::Swap result;
  for (const TriangleIndex t : swap.freed)
    result.chosen.push_back(surface.triangle(t));
  const std::size_t n = surface.n_indices();
  for (std::size_t i = n - swap.chosen.size(); i < n; ++i)
    result.freed.push_back(static_cast<TriangleIndex>(i));
  result.vertices = swap.vertices;
  return result;
}

TEST(PieceFinder, KnowsTheRestOfASurfaceOnceAPieceIsCutOff) {
  ChangingTorus torus(60);
  PieceFinder finder(torus.surface(), 200);
  const std::vector<bool> is_open(torus.surface().n_vertices());
  for (const std::uint32_t column : {3U, 24U, 40U}) {
    SCOPED_TRACE(testing::Message() << "column " << column);
    const auto cut = cut_off(torus.surface(), column % kRound, column);
    EXPECT_EQ(finder.find(cut.change(), is_open).size(), 1U);
    torus.make(cut);
    EXPECT_FALSE(finder.is_one_piece());
    const auto join = reverse(torus.surface(), cut);
    EXPECT_TRUE(finder.find(join.change(), is_open).empty());
    torus.make(join);
    EXPECT_TRUE(finder.is_one_piece());
  }
}

TEST(PieceFinder, SaysOneOnlyWhereThereIsOnePiece) {
  std::mt19937_64 rng(7);
  std::uniform_int_distribution<std::uint32_t> any_column(0, 99);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    ChangingTorus torus(100);
    PieceFinder finder(torus.surface(), 100);
    const std::vector<bool> is_open(torus.surface().n_vertices());
    std::set<std::uint32_t> cuts;
    for (int step = 0; step < 6; ++step) {
      const std::uint32_t column = any_column(rng);
      const auto swap = torus.swap(column);
      (void)finder.find(swap.change(), is_open);
      torus.make(column, swap);
      if (!cuts.insert(column).second) cuts.erase(column);
      EXPECT_LE(finder.is_one_piece() ? cuts.size() : 0, 1U);
    }
  }
}

/// The triangles at a vertex of the torus, and others in their place that leave
/// it bare, or not.
ChangingTorus::Swap patch(const WorkingSurface& surface, std::uint32_t column,
                          bool leaves_bare) {
  ChangingTorus::Swap result;
  surface.for_each_at(at(1, column), [&](TriangleIndex t) {
    result.freed.push_back(t);
    if (!leaves_bare) result.chosen.push_back(surface.triangle(t));
  });
  const std::array<VertexId, 6> around = {at(2, column),     at(2, column + 1),
                                          at(1, column + 1), at(0, column),
                                          at(0, column - 1), at(1, column - 1)};
  for (std::size_t i = 1; leaves_bare && i + 1 < around.size(); ++i)
    result.chosen.push_back(
        {triangle(around[0], around[i], around[i + 1]), {}});
  result.vertices.assign(around.begin(), around.end());
  result.vertices.push_back(at(1, column));
  std::sort(result.vertices.begin(), result.vertices.end());
  return result;
}

TEST(PieceFinder, SaysThatThereIsOnePieceAfterChangesOfDiscs) {
  for (const bool leaves_bare : {false, true}) {
    ChangingTorus torus(100);
    PieceFinder finder(torus.surface(), 100);
    const std::vector<bool> is_open(torus.surface().n_vertices());
    for (const std::uint32_t column : {50U, 3U, 70U, 52U}) {
      const auto change = patch(torus.surface(), column, leaves_bare);
      EXPECT_TRUE(finder.find(change.change(), is_open).empty());
      torus.make(change);
      EXPECT_EQ(finder.is_one_piece(), !leaves_bare);
    }
  }
}

}  // namespace
}  // namespace umbrella
