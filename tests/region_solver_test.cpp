// One region and its program by itself: which points it leaves out, and how it
// cuts off small pieces.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "ilp/linear_form.h"
#include "umbrella/region_solver_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

VertexId vertex(std::size_t v) {
  return VertexId{static_cast<std::uint32_t>(v)};
}

/// No piece is too small.
ClosingOptions with_any_piece() {
  return {.piece_triangles = 0, .piece_part = 0, .joined_part = 0};
}

/// The hull, on which stand no other triangles yet.
struct Hull {
  const Triangulation3& triangulation;
  std::vector<RankedTriangle> triangles;
  std::vector<VertexId> inner;  // vertices that are not on it
  WorkingSurface surface;
  std::vector<bool> is_open;
  PointGroups groups;

  explicit Hull(const Triangulation3& t)
      : triangulation(t),
        triangles(triangles_of(t)),
        surface(t.points().size(), triangles),
        is_open(t.points().size()),
        groups(t, triangles, surface) {
    for (std::size_t v = 0; v < t.points().size(); ++v) {
      bool is_used = false;
      surface.for_each_at(vertex(v), [&](TriangleIndex) { is_used = true; });
      if (!is_used) inner.push_back(vertex(v));
    }
    for (const VertexId v : inner) is_open[index(v)] = true;
  }

  static std::vector<RankedTriangle> triangles_of(const Triangulation3& t) {
    std::vector<RankedTriangle> result;
    for (std::uint32_t c = 0; c < t.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i) {
        const delaunay::Cell& cell = t.cell(CellId{c});
        if (!t.cell(cell.neighbor[i].cell()).is_infinite()) continue;
        Triangle corners;
        for (unsigned k = 0; k < 3; ++k)
          corners[k] = cell.vertex[delaunay::kFacetCorners[i][k]];
        std::sort(corners.begin(), corners.end());
        result.push_back({corners, Facet(CellId{c}, i), {}});
      }
    std::sort(result.begin(), result.end(),
              [](const RankedTriangle& a, const RankedTriangle& b) {
                return a.corners < b.corners;
              });
    return result;
  }

  Attempt attempt(const ClosingOptions& options, const AttemptOptions& how) {
    RegionSolver solver(triangulation, options, surface, is_open, groups);
    Effort effort = {1'000'000, 1'000'000'000};
    return solver.attempt({.vertices = inner, .stuck = {}}, effort, how);
  }

  std::vector<LocatedTriangle> candidates() const {
    return Neighborhoods(triangulation, surface)
        .candidates({.vertices = inner, .stuck = {}});
  }

  /// Whether a surface passes through all inner vertices but these.
  bool has_surface_without(std::span<const VertexId> dropped) const {
    VertexNumbers numbers(surface.n_vertices());
    const std::vector<LocatedTriangle> all = candidates();
    const ClosingProgram program(surface, {all, inner, inner}, numbers);
    ilp::Solver solver(program.problem());
    std::vector<ilp::Literal> wanted;
    for (const auto& [v, is_dropped] : program.droppable())
      wanted.emplace_back(is_dropped, std::ranges::binary_search(dropped, v));
    return solver.solve(wanted) == ilp::Status::Feasible;
  }
};

// Within a closed hull a surface has to make do with the inner points, and not
// all of these have cells enough among themselves.
TEST(RegionSolver, LeavesOutNoPointThatItCouldKeep) {
  std::size_t n_dropped = 0, n_kept = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Triangulation3 t(
        shapes::sample("uniform", 20 + trial % 15, {.seed = trial}));
    Hull hull(t);
    const Attempt attempt =
        hull.attempt(with_any_piece(), {.may_drop = hull.inner});
    ASSERT_EQ(attempt.outcome, Outcome::Solved);
    const std::vector<VertexId>& dropped = attempt.dropped;
    EXPECT_TRUE(std::ranges::includes(hull.inner, dropped));
    for (const LocatedTriangle& chosen : attempt.chosen)
      for (const VertexId v : chosen.corners)
        EXPECT_FALSE(std::ranges::binary_search(dropped, v));
    EXPECT_TRUE(hull.has_surface_without(dropped));
    for (const VertexId back : dropped) {
      std::vector<VertexId> fewer = dropped;
      std::erase(fewer, back);
      EXPECT_FALSE(hull.has_surface_without(fewer)) << index(back);
    }
    n_dropped += dropped.size();
    n_kept += hull.inner.size() - dropped.size();
  }
  EXPECT_GT(n_dropped, 50U);
  EXPECT_GT(n_kept, 50U);
}

TEST(RegionSolver, BeginsNoProgramThatTheClockWouldCutShort) {
  const Triangulation3 t(shapes::sample("uniform", 2000, {}));
  Hull hull(t);
  const ClosingOptions options = {.seconds = 0.04};
  RegionSolver solver(t, options, hull.surface, hull.is_open, hull.groups);
  const Region region = {.vertices = hull.inner, .stuck = {}};
  auto candidates = solver.candidates(region);
  const std::size_t n = candidates.size();
  ASSERT_GT(n, 20'000U);
  Effort effort = {1'000'000, 1'000'000'000};
  const Attempt attempt =
      solver.attempt({region, std::move(candidates)}, effort, {});
  EXPECT_EQ(attempt.outcome, Outcome::Undecided);
  EXPECT_EQ(attempt.n_candidates, n);
  EXPECT_EQ(attempt.n_variables, 0U);
  EXPECT_TRUE(solver.is_timed_out());
}

TEST(RegionSolver, NamesWhatIsStuckWhereNothingMayBeLeftOut) {
  const Triangulation3 t(shapes::sample("uniform", 12, {.seed = 4}));
  Hull hull(t);
  ASSERT_FALSE(hull.has_surface_without({}));
  const Attempt attempt = hull.attempt(
      with_any_piece(), {.may_drop = hull.inner, .accept_drops = false});
  EXPECT_EQ(attempt.outcome, Outcome::Infeasible);
  EXPECT_FALSE(attempt.stuck.empty());
  EXPECT_TRUE(std::ranges::includes(hull.inner, attempt.stuck));
}

// Two clusters of four in a hull: the least surface is one about each.
std::vector<Point3> two_clusters() {
  std::vector<Point3> points;
  for (const double x : {-9.0, 9.0})
    for (const double y : {-8.0, 8.0})
      for (const double z : {-7.0, 7.0}) points.emplace_back(x, y, z);
  for (const double x : {-1.0, 1.3}) {
    points.emplace_back(x, 0.1, 0);
    points.emplace_back(x + 0.5, 0.2, 0.1);
    points.emplace_back(x + 0.1, 0.6, 0.2);
    points.emplace_back(x + 0.2, 0.3, 0.5);
  }
  return points;
}

// All ways out: a triangle with one corner in the piece, or with two.
TEST(RegionSolver, CutsOffAPieceByAllTrianglesThatLeadOut) {
  const Triangulation3 t(two_clusters());
  Hull hull(t);
  ASSERT_EQ(hull.inner.size(), 8U);
  ASSERT_EQ(hull.attempt(with_any_piece(), {}).chosen.size(), 8U);

  ClosingOptions options = with_any_piece();
  options.piece_triangles = 4;
  std::vector<ilp::LinearRow> rows;
  options.on_program = [&rows](const ilp::LinearForm& form, ilp::Status) {
    rows = form.rows;
  };
  const Attempt attempt = hull.attempt(options, {});
  EXPECT_EQ(attempt.outcome, Outcome::Solved);
  EXPECT_EQ(attempt.chosen.size(), 12U);  // T = 2 V - 4
  ASSERT_FALSE(attempt.pieces.empty());
  const std::vector<LocatedTriangle> candidates = hull.candidates();
  for (const Piece& piece : attempt.pieces) {
    std::vector<ilp::Term> expected;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
      const auto n_in =
          std::ranges::count_if(candidates[i].corners, [&piece](VertexId v) {
            return std::ranges::binary_search(piece.vertices, v);
          });
      if (n_in == 1 || n_in == 2) expected.push_back({ilp::VarId{i}, 1});
    }
    EXPECT_TRUE(std::ranges::any_of(rows, [&](const ilp::LinearRow& row) {
      return row.bound == 1 && !row.is_equation &&
             std::ranges::equal(row.terms, expected, {}, &ilp::Term::var,
                                &ilp::Term::var);
    }));
  }
}

}  // namespace
}  // namespace umbrella
