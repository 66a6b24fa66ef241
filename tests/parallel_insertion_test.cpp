#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/parallel_insertion_internal.h"
#include "delaunay/threads.h"
#include "delaunay/triangulation3.h"
#include "delaunay/validate.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using tests::Family;
using tests::kFamilies;
using tests::make_points;

// ---- What the inserters share ----

// Vertices 0, 1 are in part 0, 2 to 5 in part 1, 6, 7 in part 2.
class PartTest : public testing::Test {
 protected:
  static Cell cell(unsigned a, unsigned b, unsigned c, unsigned d) {
    return {.vertex = {VertexId{a}, VertexId{b}, VertexId{c}, VertexId{d}},
            .neighbor = {},
            .center = {},
            .inside2 = 0,
            .outside2 = 0};
  }
  static constexpr auto kInf = static_cast<unsigned>(kInfinite);
  const std::vector<std::uint8_t> part_of_vertex_ = {0, 0, 1, 1, 1, 1, 2, 2};
  const Part part_{part_of_vertex_, 1};
};

TEST_F(PartTest, OwnsACellWithAllItsFiniteCorners) {
  EXPECT_TRUE(part_.owns(cell(2, 3, 5, 4)));
  EXPECT_TRUE(part_.owns(cell(2, 3, 5, kInf)));
  EXPECT_FALSE(part_.owns(cell(2, 6, 5, 4)));
  EXPECT_FALSE(part_.owns(cell(2, 3, 5, 1)));
  EXPECT_FALSE(part_.owns(cell(2, 6, 5, kInf)));
}

TEST_F(PartTest, MayVisitWhatNoOtherOwns) {
  EXPECT_TRUE(part_.may_visit(cell(2, 3, 5, 4)));
  EXPECT_TRUE(part_.may_visit(cell(0, 1, 7, 6)));
  EXPECT_TRUE(part_.may_visit(cell(0, 7, 6, kInf)));
  EXPECT_FALSE(part_.may_visit(cell(0, 1, 0, 1)));
  EXPECT_FALSE(part_.may_visit(cell(7, 6, 7, kInf)));
}

TEST_F(PartTest, MayCrossAFacetThatNoOtherOwns) {
  const Cell mixed = cell(0, 1, 0, 3);
  EXPECT_TRUE(part_.may_cross(mixed, 0));
  EXPECT_TRUE(part_.may_cross(mixed, 1));
  EXPECT_TRUE(part_.may_cross(mixed, 2));
  EXPECT_FALSE(part_.may_cross(mixed, 3));
  EXPECT_TRUE(part_.may_cross(cell(0, 1, 7, 3), 3));
}

TEST(FreshCells, GiveEveryNumberToOneInserter) {
  constexpr unsigned kInserters = 3;
  std::set<CellId> taken;
  for (unsigned number = 0; number < kInserters; ++number) {
    FreshCells fresh(number, kInserters);
    for (std::size_t i = 0; i < 4 * FreshCells::kBlock; ++i)
      EXPECT_TRUE(taken.insert(fresh.take()).second);
  }
  EXPECT_EQ(index(*taken.rbegin()) + 1, taken.size());
}

TEST(FreshCells, KnowWhereTheyWillEnd) {
  for (const std::size_t n : {0, 1, 5, 1023, 1024, 1025, 2048, 5000}) {
    for (const std::size_t before : {0, 1, 1000, 1024, 3000}) {
      SCOPED_TRACE(testing::Message() << n << " after " << before);
      FreshCells fresh(1, 3);
      for (std::size_t i = 0; i < before; ++i) fresh.take();
      const std::size_t end = fresh.end_after(n);
      for (std::size_t i = 0; i < n; ++i) fresh.take();
      EXPECT_EQ(fresh.end(), end);
    }
  }
}

TEST(RunTasks, RunsEachOnce) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    std::vector<int> calls(20, 0);
    run_tasks(20, threads, [&](unsigned i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(20, 1));
  }
  run_tasks(0, 2, [](unsigned) { FAIL(); });
}

TEST(RunTasks, RethrowsFromTheLowestTaskAfterAllHaveEnded) {
  std::atomic<int> calls = 0;
  const auto fail_twice = [&](unsigned i) {
    ++calls;
    if (i == 3 || i == 6) throw std::runtime_error(std::to_string(i));
  };
  for (const unsigned threads : {1U, 2U, 8U}) {
    calls = 0;
    try {
      run_tasks(9, threads, fail_twice);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
    EXPECT_EQ(calls, 9);
  }
}

// ---- The triangulation ----

/// A cell as the triangulation determines it: ascending corners, and with each
/// the corner of the neighbour across from it.
struct CanonicalCell {
  std::array<VertexId, 4> vertex;
  std::array<VertexId, 4> across;
  friend auto operator<=>(const CanonicalCell&, const CanonicalCell&) = default;
};

/// An even permutation of the corners is no other cell; an odd one is.
bool is_even(const std::array<VertexId, 4>& vertex) {
  int inversions = 0;
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned k = i + 1; k < 4; ++k)
      inversions += vertex[i] > vertex[k] ? 1 : 0;
  return inversions % 2 == 0;
}

std::vector<CanonicalCell> canonical(std::span<const Cell> cells) {
  std::vector<CanonicalCell> result;
  for (const Cell& cell : cells) {
    std::array<unsigned, 4> order = {0, 1, 2, 3};
    std::ranges::sort(order, {}, [&](unsigned i) { return cell.vertex[i]; });
    if (!is_even(cell.vertex)) std::swap(order[0], order[1]);
    CanonicalCell& c = result.emplace_back();
    for (unsigned i = 0; i < 4; ++i) {
      const Facet facet = cell.neighbor[order[i]];
      c.vertex[i] = cell.vertex[order[i]];
      c.across[i] = cells[index(facet.cell())].vertex[facet.index()];
    }
  }
  std::ranges::sort(result);
  return result;
}

/// Threads on rounds far below what is worth it: seams everywhere.
constexpr std::size_t kCrowded = 8;

InsertionOptions crowd(unsigned threads) {
  return {.threads = threads, .min_vertices = kCrowded};
}

LazyVector<Cell> insert_again(const Triangulation3& t, Mesh3& mesh,
                              const InsertionOptions& options) {
  const std::size_t n_finite = insert_all(mesh, t.cells()[0].vertex, options);
  EXPECT_EQ(n_finite, t.n_finite_cells());
  return std::move(mesh.cells);
}

LazyVector<Cell> insert_again(const Triangulation3& t,
                              const InsertionOptions& options) {
  Mesh3 mesh(t.points(), options.threads);
  return insert_again(t, mesh, options);
}

/// @param min_vertices  of a round for each thread
void expect_same_for_any_number_of_threads(const Triangulation3& t,
                                           std::size_t min_vertices) {
  if (t.dimension() < 3) return;
  const auto expected = canonical(t.cells());
  for (const unsigned threads : {1U, 2U, 3U, 4U, 8U}) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    const InsertionOptions options = {.threads = threads,
                                      .min_vertices = min_vertices};
    EXPECT_TRUE(canonical(insert_again(t, options)) == expected);
  }
}

void expect_same_for_all_families(std::size_t n, std::size_t min_vertices) {
  // Exact tests on the widest exponents take milliseconds a point.
  constexpr std::size_t kMaxMixed = 60;
  for (const Family family : kFamilies) {
    SCOPED_TRACE(testing::Message() << tests::name(family) << ", n = " << n);
    const std::size_t size =
        family == Family::MixedExponents ? std::min(n, kMaxMixed) : n;
    expect_same_for_any_number_of_threads(
        Triangulation3(make_points<3>(family, size, n)), min_vertices);
  }
}

TEST(ParallelInsertion, MakesTheSameCellsOnAnyNumberOfThreads) {
  expect_same_for_all_families(300, kCrowded);
}

// A part may hold one vertex, and most cells lie on seams.
TEST(ParallelInsertion, MakesTheSameCellsOfFewPoints) {
  for (const std::size_t n : {5, 12, 30, 90})
    expect_same_for_all_families(n, 1);
}

// Large enough for rounds that do not ascend.
TEST(ParallelInsertion, MakesTheSameCellsOfAFullLattice) {
  std::vector<Point3> points;
  for (int i = 0; i < 20 * 12 * 9; ++i)
    points.emplace_back(i / 108, i / 9 % 12, i % 9);
  expect_same_for_any_number_of_threads(Triangulation3(points), kCrowded);
}

// An insertion meets most of the cells there are: no part owns its cavity.
TEST(ParallelInsertion, MakesTheSameCellsWhereCavitiesAreLarge) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point3> skew_lines, moment_curve, nearly_collinear;
  for (int i = 0; i < 150; ++i) {
    const double t = unit(rng);
    skew_lines.emplace_back(t, 0, 0);
    skew_lines.emplace_back(0, t, 1);
    moment_curve.emplace_back(t, t * t, t * t * t);
    const double off = 0x1p-50 * unit(rng);
    nearly_collinear.emplace_back(t + off, 2 * t, 3 * t - off);
  }
  for (const auto& points : {skew_lines, moment_curve, nearly_collinear}) {
    const Triangulation3 t(points);
    ASSERT_EQ(t.dimension(), 3);
    expect_same_for_any_number_of_threads(t, 1);
    expect_same_for_any_number_of_threads(t, kCrowded);
  }
}

TEST(SlowParallelInsertion, MakesTheSameCellsOnAnyNumberOfThreads) {
  expect_same_for_all_families(20000, kCrowded);
}

// Where neither the numbers of cells nor the roundings may differ.
TEST(ParallelInsertion, DoesNotDependOnTiming) {
  const Triangulation3 t(make_points<3>(Family::Uniform, 3000, 1));
  const auto expected = insert_again(t, crowd(4));
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const auto cells = insert_again(t, crowd(4));
    ASSERT_EQ(cells.size(), expected.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      ASSERT_EQ(cells[c].vertex, expected[c].vertex);
      ASSERT_EQ(cells[c].neighbor, expected[c].neighbor);
      ASSERT_EQ(cells[c].center, expected[c].center);
    }
  }
}

TEST(ParallelInsertion, GrowsAMeshThatHasTooLittleRoom) {
  const Triangulation3 t(make_points<3>(Family::Uniform, 3000, 2));
  for (const unsigned threads : {1U, 2U, 4U}) {
    SCOPED_TRACE(threads);
    Mesh3 mesh(t.points(), threads);
    mesh.cells.resize(threads * FreshCells::kBlock);
    const auto cells = insert_again(t, mesh, crowd(threads));
    EXPECT_TRUE(canonical(cells) == canonical(t.cells()));
  }
}

TEST(ParallelInsertion, LeavesSoundTriangulations) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    SCOPED_TRACE(threads);
    const auto points = make_points<3>(Family::Uniform, 20000, 3);
    EXPECT_EQ(first_violation(Triangulation3(points, threads)), "");
  }
}

}  // namespace
}  // namespace delaunay
