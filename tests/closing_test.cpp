#include "umbrella/closing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/holes.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;

/// Everything before the closing.
struct Input {
  Triangulation3 triangulation;
  CleanUpResult clean;
  std::vector<Hole> holes;

  explicit Input(std::span<const Point3> points) : triangulation(points) {
    const std::size_t n = triangulation.points().size();
    const auto filtered = umbrella_filter(n, ranked_triangles(triangulation));
    clean = clean_up(n, filtered.triangles);
    find();
  }

  void find() {
    holes = find_holes(triangulation.points().size(), clean.triangles,
                       clean.deleted, clean.without_umbrella);
  }

  /// Takes triangles out as if the clean-up had deleted them.
  void damage(std::size_t n_triangles, std::uint64_t seed) {
    std::mt19937_64 rng(seed);
    std::set<VertexId> bare(clean.without_umbrella.begin(),
                            clean.without_umbrella.end());
    for (std::size_t i = 0; i < n_triangles; ++i) {
      const auto gone =
          clean.triangles.begin() +
          static_cast<std::ptrdiff_t>(rng() % clean.triangles.size());
      bare.insert(gone->corners.begin(), gone->corners.end());
      clean.deleted.push_back(*gone);
      clean.triangles.erase(gone);
    }
    clean.without_umbrella.assign(bare.begin(), bare.end());
    find();
  }

  ClosingResult close(const ClosingOptions& options = {}) const {
    return close_holes(triangulation, clean.triangles, holes, options);
  }
};

std::vector<Triangle> corners_of(const ClosingResult& result) {
  std::vector<Triangle> corners;
  for (const auto& t : result.triangles) corners.push_back(t.corners);
  return corners;
}

SurfaceReport judged(const Input& input, const ClosingResult& result) {
  std::vector<IndexedTriangle> triangles;
  for (const auto& [a, b, c] : corners_of(result))
    triangles.push_back({static_cast<std::uint32_t>(a),
                         static_cast<std::uint32_t>(b),
                         static_cast<std::uint32_t>(c)});
  return check_surface(input.triangulation.points(), triangles);
}

TEST(CloseHoles, GivesBackADamagedSurface) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Input input(shapes::sample("torus", 800, {.seed = trial}));
    const auto whole = corners_of(input.close());
    input.damage(40, trial);
    const ClosingResult closed = input.close();
    const SurfaceReport report = judged(input, closed);
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(report.genus, 1);
    EXPECT_TRUE(report.unused_vertices.empty());
    std::vector<Triangle> same;
    const auto corners = corners_of(closed);
    std::set_intersection(whole.begin(), whole.end(), corners.begin(),
                          corners.end(), std::back_inserter(same));
    EXPECT_GT(same.size(), whole.size() * 95 / 100);
  }
}

TEST(CloseHoles, KeepsWhatIsOutsideTheRegions) {
  Input input(shapes::sample("sphere", 500, {}));
  input.damage(10, 7);
  std::set<VertexId> touched;
  for (const Hole& hole : input.holes)
    touched.insert(hole.vertices.begin(), hole.vertices.end());
  const ClosingResult closed = input.close();
  ASSERT_EQ(closed.report.feasible, closed.report.regions);
  const auto corners = corners_of(closed);
  for (const auto& t : input.clean.triangles)
    if (!std::all_of(t.corners.begin(), t.corners.end(),
                     [&](VertexId v) { return touched.count(v) > 0; })) {
      EXPECT_TRUE(
          std::binary_search(corners.begin(), corners.end(), t.corners));
    }
}

TEST(CloseHoles, DoesNotDependOnTheOrderOfHolesOrTriangles) {
  std::mt19937_64 rng(2);
  Input input(shapes::sample("bumpy", 1500, {}));
  input.damage(60, 1);
  const auto expected = corners_of(input.close());
  for (int trial = 0; trial < 3; ++trial) {
    std::shuffle(input.holes.begin(), input.holes.end(), rng);
    std::shuffle(input.clean.triangles.begin(), input.clean.triangles.end(),
                 rng);
    EXPECT_EQ(corners_of(input.close()), expected);
  }
}

TEST(CloseHoles, ClosesByEachWeight) {
  Input input(shapes::sample("torus", 600, {}));
  input.damage(30, 3);
  for (const CloseWeight weight :
       {CloseWeight::Circumradius, CloseWeight::LambdaLower,
        CloseWeight::Area}) {
    const SurfaceReport report = judged(input, input.close({.weight = weight}));
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(report.genus, 1);
  }
}

TEST(CloseHoles, PaperModeGivesAConstrainedComplex) {
  Input input(shapes::sample("sphere", 700, {}));
  input.damage(30, 5);
  const SurfaceReport report =
      judged(input, input.close({.mode = CloseMode::Paper}));
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_TRUE(report.unused_vertices.empty());
}

TEST(CloseHoles, CountsItsRegions) {
  Input input(shapes::sample("torus", 800, {}));
  input.damage(25, 9);
  const ClosingReport& report = input.close().report;
  EXPECT_GT(report.regions, 1U);
  EXPECT_EQ(
      report.feasible + report.grown + report.infeasible + report.undecided,
      report.regions);
  EXPECT_GE(report.variables, report.candidate_triangles);
  EXPECT_GE(report.largest_region_vertices, 3U);
}

TEST(CloseHoles, CountsItsConflicts) {
  const Input cloud(shapes::sample("uniform", 150, {.seed = 3}));
  ClosingOptions options = {
      .conflicts = 500, .handle_edges = 0, .open_bores = false};
  std::uint64_t n_programs = 0;
  options.on_program = [&](const ilp::LinearForm&, ilp::Status) {
    ++n_programs;
  };
  const std::uint64_t conflicts = cloud.close(options).report.conflicts;
  EXPECT_GT(conflicts, 0U);
  EXPECT_LE(conflicts, n_programs * (options.short_search + options.conflicts));
}

TEST(CloseHoles, TellsHowManyRegionsAreDoneWith) {
  Input torus(shapes::sample("torus", 1500, {}));
  torus.damage(80, 1);
  const Input cloud(shapes::sample("uniform", 150, {.seed = 3}));
  for (const Input* input : {&std::as_const(torus), &cloud})
    for (const CloseMode mode : {CloseMode::Best, CloseMode::Paper})
      for (const unsigned threads : {1U, 3U}) {
        ClosingOptions options = {
            .mode = mode, .conflicts = 500, .threads = threads};
        std::vector<std::size_t> told;
        std::size_t n_regions = 0;
        const auto caller = std::this_thread::get_id();
        options.on_progress = [&](std::size_t n_done, std::size_t n) {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          told.push_back(n_done);
          n_regions = n;
        };
        const ClosingReport report = input->close(options).report;
        EXPECT_EQ(n_regions, report.regions);
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told.back(), n_regions);
        EXPECT_TRUE(std::ranges::is_sorted(told, std::ranges::less_equal()));
      }
}

TEST(CloseHoles, IsTheSameOnAnyNumberOfThreads) {
  Input torus(shapes::sample("torus", 1500, {}));
  torus.damage(80, 1);
  const Input cloud(shapes::sample("uniform", 150, {.seed = 3}));
  const Input knot(shapes::sample("knot", 2000, {.seed = 5}));
  for (const Input* input :
       std::array<const Input*, 3>{&torus, &cloud, &knot}) {
    const ClosingResult expected = input->close({.conflicts = 500});
    for (const unsigned threads : {2U, 3U, 8U}) {
      SCOPED_TRACE(testing::Message() << threads << " threads");
      const ClosingResult result =
          input->close({.conflicts = 500, .threads = threads});
      EXPECT_EQ(corners_of(result), corners_of(expected));
      EXPECT_EQ(result.dropped, expected.dropped);
      EXPECT_EQ(result.report.conflicts, expected.report.conflicts);
    }
  }
}

TEST(CloseHoles, ClosesBeyondTheLimitsOfItsPrograms) {
  Input input(shapes::sample("torus", 800, {}));
  input.damage(25, 9);
  const ClosingResult result = input.close({.seconds = 0});
  EXPECT_EQ(result.report.undecided, result.report.regions);
  EXPECT_EQ(result.report.infeasible, 0U);
  EXPECT_EQ(result.report.labelled, result.report.regions);
  const SurfaceReport report = judged(input, result);
  EXPECT_TRUE(report.closed && report.manifold);
}

// So that a limit is kept to, however many points there are.
TEST(CloseHoles, MakesNoProgramOnceItIsToEnd) {
  const Input input(shapes::sample("uniform", 1000, {}));
  const std::atomic<bool> stop = true;
  for (const ClosingOptions& options :
       {ClosingOptions{.stop = &stop}, ClosingOptions{.seconds = 0}}) {
    const ClosingResult result = input.close(options);
    const ClosingReport& report = result.report;
    EXPECT_EQ(report.variables, 0U);
    EXPECT_EQ(report.undecided, report.regions);
    EXPECT_EQ(report.pieces_joined + report.brought_in + report.handles_removed,
              0U);
    EXPECT_EQ(report.timed_out, options.stop == nullptr);
    const SurfaceReport surface = judged(input, result);
    EXPECT_TRUE(surface.closed && surface.manifold);
    EXPECT_LT(10 * result.dropped.size(), 1000U);
    EXPECT_EQ(result.reasons, std::vector<DropReason>(result.dropped.size(),
                                                      DropReason::Limit));
  }
}

// Wherever in the only attempt at the only region it is up.
TEST(CloseHoles, SaysThatTheTimeWasUp) {
  const Input input(shapes::sample("uniform", 3000, {}));
  for (int part = 1; part <= 30; ++part) {
    SCOPED_TRACE(testing::Message() << "part " << part);
    const ClosingReport report =
        input.close({.mode = CloseMode::Paper, .seconds = 1e-3 * part}).report;
    ASSERT_EQ(report.regions, 1U);
    EXPECT_TRUE(report.timed_out || report.undecided == 0);
  }
}

TEST(CloseHoles, StaysOpenAtItsLimitsWhereNoPointMayBeLeftOut) {
  Input input(shapes::sample("torus", 800, {}));
  input.damage(25, 9);
  const ClosingResult result =
      input.close({.seconds = 0, .drop_points = false});
  EXPECT_EQ(result.report.undecided, result.report.regions);
  EXPECT_EQ(result.triangles.size(), input.clean.triangles.size());
}

/// With the vertices of each hole that have no umbrella, and none besides, most
/// programs have no solution as they are.
TEST(CloseHoles, GrowsRegionsThatAreTooSmall) {
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Input input(shapes::sample("knot", 3000, {.seed = trial}));
    for (Hole& hole : input.holes) hole.vertices = hole.core;
    const ClosingResult result = input.close();
    EXPECT_GT(result.report.grown, 0U);
    EXPECT_EQ(result.report.labelled, 0U);
    const SurfaceReport report = judged(input, result);
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(report.genus, 1);
    EXPECT_TRUE(report.unused_vertices.empty());
  }
}

/// A surface of few triangles is a small piece that nothing leads out of: the
/// ban has to be lifted.
TEST(CloseHoles, AllowsASmallPieceWhereThereIsNoOther) {
  const std::vector<Point3> octahedron = {{1, 0, 0},  {-1, 0.1, 0}, {0, 1, 0},
                                          {0, -1, 0}, {0, 0, 1},    {0, 0, -1}};
  const Input input(octahedron);
  ASSERT_FALSE(input.holes.empty());
  const ClosingResult result = input.close();
  EXPECT_EQ(result.triangles.size(), 8U);
  EXPECT_EQ(result.report.grown, result.report.regions);
  EXPECT_EQ(result.report.labelled, 0U);
  EXPECT_TRUE(result.dropped.empty());
  // Small is what has at most so many triangles.
  for (const std::size_t most : {7, 8}) {
    const ClosingReport report =
        input.close({.piece_triangles = most, .piece_part = 0}).report;
    EXPECT_EQ(report.grown, most < 8 ? 0 : report.regions);
  }
}

TEST(CloseHoles, LeavesAClosedSurfaceAlone) {
  const Input input(shapes::sample("sphere", 400, {}));
  const auto closed = input.close();
  const Input again = input;
  EXPECT_EQ(corners_of(again.close()), corners_of(closed));
  if (input.holes.empty()) {
    EXPECT_EQ(closed.triangles.size(), input.clean.triangles.size());
  }
}

/// A sphere and some points beside it.
std::vector<Point3> sphere_with(std::span<const Point3> extra) {
  std::vector<Point3> points = shapes::sample("sphere", 300, {.seed = 4});
  points.insert(points.end(), extra.begin(), extra.end());
  return points;
}

void expect_closed_but_for_dropped(const Input& input,
                                   const ClosingResult& result) {
  const SurfaceReport report = judged(input, result);
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_EQ(result.report.infeasible + result.report.undecided, 0U);
  std::vector<std::uint32_t> dropped;
  for (const VertexId v : result.dropped)
    dropped.push_back(static_cast<std::uint32_t>(v));
  EXPECT_EQ(report.unused_vertices, dropped);
}

TEST(CloseHoles, ClosesASphereWithAnOutlier) {
  for (const double x : {0.1, 0.9, 1.2, 3.0, 50.0}) {
    SCOPED_TRACE(testing::Message() << "at " << x);
    const Input input(sphere_with(std::array{Point3(x, 0.01, 0.02)}));
    const ClosingResult result = input.close();
    expect_closed_but_for_dropped(input, result);
    EXPECT_LE(result.dropped.size(), 1U);
  }
}

TEST(CloseHoles, ClosesASphereWithAClusterOfOutliers) {
  std::mt19937_64 rng(11);
  std::normal_distribution<double> spread(0, 0.05);
  for (const double x : {0.0, 1.5, 4.0}) {
    SCOPED_TRACE(testing::Message() << "at " << x);
    std::vector<Point3> cluster;
    for (int i = 0; i < 6; ++i)
      cluster.emplace_back(x + spread(rng), spread(rng), spread(rng));
    const Input input(sphere_with(cluster));
    const ClosingResult result = input.close({.conflicts = 8'000});
    expect_closed_but_for_dropped(input, result);
    EXPECT_LE(result.dropped.size(), cluster.size());
  }
}

/// Two spheres that share a point: its triangles cannot be two umbrellas.
TEST(CloseHoles, ClosesTwoSpheresThatTouch) {
  std::vector<Point3> points = shapes::sample("sphere", 300, {.seed = 4});
  const Point3 touch = points.front();
  for (std::size_t i = 0, n = points.size(); i < n; ++i)
    points.push_back(2 * touch - points[i]);
  const Input input(points);
  expect_closed_but_for_dropped(input, input.close());
}

TEST(CloseHoles, SaysWhatItsEffortDidNotSuffice) {
  Input input(shapes::sample("torus", 800, {}));
  input.damage(25, 9);
  for (const ClosingOptions& options :
       {ClosingOptions{.propagations = 0, .propagations_per_vertex = 0},
        ClosingOptions{.propagations = 40, .propagations_per_vertex = 0},
        ClosingOptions{.conflicts = 0, .propagations = 4000}}) {
    const ClosingResult result = input.close(options);
    const ClosingReport& report = result.report;
    EXPECT_EQ(
        report.feasible + report.grown + report.infeasible + report.undecided,
        report.regions);
    EXPECT_EQ(report.labelled, report.infeasible + report.undecided);
    EXPECT_TRUE(judged(input, result).closed);
    EXPECT_EQ(corners_of(input.close(options)), corners_of(result));
  }
  const ClosingReport none =
      input.close({.propagations = 0, .propagations_per_vertex = 0}).report;
  EXPECT_EQ(none.undecided, none.regions);
}

TEST(CloseHoles, SaysWhyItLeavesAPointOut) {
  std::size_t n_without_effort = 0;
  for (const std::uint64_t trial : {4, 5, 6}) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Input input(shapes::sample("uniform", 1000, {.seed = trial}));
    const ClosingResult hasty =
        input.close({.propagations = 0, .propagations_per_vertex = 0});
    n_without_effort += hasty.dropped.size();
    EXPECT_EQ(hasty.reasons,
              std::vector<DropReason>(hasty.dropped.size(), DropReason::Limit));
    const ClosingResult result = input.close({.conflicts = 2000});
    EXPECT_EQ(result.reasons.size(), result.dropped.size());
    if (result.report.undecided == 0) {
      EXPECT_EQ(std::count(result.reasons.begin(), result.reasons.end(),
                           DropReason::Limit),
                0);
    }
  }
  EXPECT_GT(n_without_effort, 0U);
}

/// A cloud fits no surface: holes are large, and points may have to go.
TEST(CloseHoles, AnswersOnACloud) {
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Input input(shapes::sample("uniform", 60, {.seed = trial}));
    const ClosingResult result = input.close({.conflicts = 2000});
    const SurfaceReport report = judged(input, result);
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(report.unused_vertices.size(), result.dropped.size());
  }
}

}  // namespace
}  // namespace umbrella
