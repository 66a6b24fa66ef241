#include "delaunay/triangulation3.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "apps/shapes.h"
#include "delaunay/parallel_insertion_internal.h"
#include "delaunay/validate.h"
#include "tests/support/brute_delaunay.h"
#include "tests/support/paper_sets.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using testing::ElementsAreArray;
using tests::Family;
using tests::kFamilies;
using tests::make_points;

using Input = std::vector<Point3>;

testing::Message trace(Family family, std::size_t n) {
  return testing::Message() << tests::name(family) << ", n = " << n;
}

std::vector<std::array<VertexId, 4>> corners(const Triangulation3& t) {
  std::vector<std::array<VertexId, 4>> all;
  for (const Cell& cell : t.cells()) all.push_back(cell.vertex);
  return all;
}

// Every sign of mixed exponents takes the widest integers.
std::size_t bounded(Family family, std::size_t n) {
  return family == Family::MixedExponents ? std::min<std::size_t>(n, 200) : n;
}

TEST(Triangulation3, IsSoundOnEveryFamily) {
  for (const Family family : kFamilies) {
    for (const std::size_t n : {1, 2, 3, 4, 5, 6, 10, 100, 1000}) {
      SCOPED_TRACE(trace(family, n));
      const Triangulation3 t(make_points<3>(family, bounded(family, n), n));
      EXPECT_EQ(first_violation(t), "");
      EXPECT_EQ(t.cells().empty(), t.dimension() < 3);
    }
  }
}

TEST(Triangulation3, HoldsExactlyTheTetrahedraWithEmptySpheres) {
  for (const Family family : kFamilies) {
    for (const std::size_t n : {4, 5, 6, 9, 13, 20}) {
      SCOPED_TRACE(trace(family, n));
      const Triangulation3 t(make_points<3>(family, n, 100 + n));
      EXPECT_THAT(tests::sorted_cells(t),
                  ElementsAreArray(tests::brute_force_cells(t.points())));
    }
  }
}

TEST(Triangulation3, DependsOnThePointsAloneNotOnTheirRows) {
  std::mt19937_64 rng(3);
  for (const Family family : kFamilies) {
    SCOPED_TRACE(trace(family, 80));
    Input rows = make_points<3>(family, 80, 4);
    const Triangulation3 t(rows);
    std::ranges::shuffle(rows, rng);
    rows.push_back(rows[5]);
    const Triangulation3 shuffled(rows);

    EXPECT_THAT(shuffled.points(), ElementsAreArray(t.points()));
    EXPECT_THAT(corners(shuffled), ElementsAreArray(corners(t)));
    EXPECT_EQ(shuffled.n_finite_cells(), t.n_finite_cells());
    ASSERT_EQ(shuffled.vertex_of_row().size(), rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
      EXPECT_EQ(shuffled.point(shuffled.vertex_of_row()[row]), rows[row]);
  }
}

TEST(Triangulation3, DoesNotChangeUnderScalingByPowersOfTwo) {
  for (const Family family :
       {Family::Uniform, Family::Grid, Family::Cospherical, Family::UlpGrid}) {
    const Input points = make_points<3>(family, 200, 5);
    const auto expected = corners(Triangulation3(points));
    for (const int exponent : {-900, -270, -60, 60, 270, 1000}) {
      SCOPED_TRACE(trace(family, 200) << ", times 2^" << exponent);
      Input scaled = points;
      for (Point3& p : scaled) p *= std::ldexp(1, exponent);
      EXPECT_THAT(corners(Triangulation3(scaled)), ElementsAreArray(expected));
    }
  }
}

TEST(Triangulation3, HasTheDimensionOfThePoints) {
  EXPECT_EQ(Triangulation3(Input{}).dimension(), -1);
  EXPECT_EQ(Triangulation3(Input{{1, 2, 3}, {1, 2, 3}}).dimension(), 0);
  Input rows = {{0, 0, 0}, {1, 3, 2}, {2, 6, 4}};
  EXPECT_EQ(Triangulation3(rows).dimension(), 1);
  rows.emplace_back(2, 6, 5);
  EXPECT_EQ(Triangulation3(rows).dimension(), 2);
  rows.emplace_back(1, 3, 7);  // in the plane y = 3x
  EXPECT_EQ(Triangulation3(rows).dimension(), 2);
  rows.emplace_back(std::numeric_limits<double>::denorm_min(), 0, 0);
  EXPECT_EQ(Triangulation3(rows).dimension(), 3);
}

TEST(Triangulation3, MergesDuplicates) {
  const Triangulation3 t(Input{
      {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -0.0, 0}});
  EXPECT_EQ(t.points().size(), 4);
  EXPECT_EQ(t.vertex_of_row()[0], t.vertex_of_row()[2]);
  EXPECT_EQ(t.vertex_of_row()[1], t.vertex_of_row()[5]);
  EXPECT_EQ(t.n_finite_cells(), 1);
}

TEST(Triangulation3, NamesTheRowThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    try {
      const Triangulation3 t(Input{{0, 0, 0}, {1, 2, bad}, {0, 1, 0}});
      FAIL() << "accepted " << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("row 1"));
    }
  }
}

// The cavity of the centre is the whole ball: far more corners than the table
// that links an ordinary star holds.
TEST(Triangulation3, StarsACavityWithThousandsOfCorners) {
  Input points = make_points<3>(Family::Rounded, 3000, 8);
  points.emplace_back(0.25, 0, 0);
  const Triangulation3 t(points);
  EXPECT_EQ(first_violation(t), "");
}

// What a circumsphere claims to decide, the exact predicate confirms.
TEST(Triangulation3, CachesSpheresThatTellTheTruth) {
  std::mt19937_64 rng(11);
  for (const Family family : kFamilies) {
    SCOPED_TRACE(trace(family, 300));
    const Triangulation3 t(make_points<3>(family, bounded(family, 300), 12));
    const auto scaled = [&](VertexId v) -> Point3 {
      return t.point(v).unaryExpr(
          [&](double x) { return std::ldexp(x, -t.scale_exponent()); });
    };
    for (std::size_t c = 0; c < t.n_finite_cells(); ++c) {
      const Cell& cell = t.cells()[c];
      if (!(cell.outside2 < std::numeric_limits<float>::infinity())) continue;
      const Eigen::Map<const Point3> center(cell.center.data());
      for (const VertexId v : cell.vertex) {
        const double d2 = (scaled(v) - center).squaredNorm();
        EXPECT_GE(d2, cell.inside2);
        EXPECT_LE(d2, cell.outside2);
      }
      const VertexId other{
          static_cast<std::uint32_t>(rng() % t.points().size())};
      EXPECT_GE((scaled(other) - center).squaredNorm(), cell.inside2);
    }
  }
}

TEST(Triangulation3, RefusesMorePointsThanItsNumbersHold) {
  const Point3 p(0, 0, 0);
  // Refused before any point is read.
  const std::span<const Point3> many(&p, Triangulation3::max_points() + 1);
  EXPECT_THROW(const Triangulation3 t(many), std::invalid_argument);
}

// Points on two skew lines: each pair of neighbours on one line makes a cell
// with each pair on the other.
TEST(Mesh3, RefusesMoreCellsThanItsNumbersHold) {
  constexpr std::uint32_t kLine = 60;
  Input points;
  for (std::uint32_t i = 0; i < kLine; ++i) points.emplace_back(i, 0, 0);
  for (std::uint32_t i = 0; i < kLine; ++i)
    points.emplace_back(30, i - 30., 40);
  const std::array first = {VertexId{0}, VertexId{1}, VertexId{kLine},
                            VertexId{kLine + 1}};
  const auto n_finite_cells = [&](std::size_t limit) {
    Mesh3 mesh(points);
    mesh.max_cells = limit;
    return insert_all(mesh, first, {});
  };
  EXPECT_EQ(n_finite_cells(std::size_t{1} << 30U), (kLine - 1) * (kLine - 1));
  EXPECT_EQ(n_finite_cells(5000), (kLine - 1) * (kLine - 1));
  EXPECT_THROW(n_finite_cells(3000), std::length_error);
}

std::vector<std::array<VertexId, 4>> sorted_corners(const Mesh3& mesh) {
  std::vector<std::array<VertexId, 4>> all;
  for (const Cell& cell : mesh.cells) {
    all.push_back(cell.vertex);
    std::ranges::sort(all.back());
  }
  std::ranges::sort(all);
  return all;
}

// A grid with gaps, so that some spheres are larger than those of its cubes.
TEST(Mesh3, HasTheSameCellsWithoutTheTieBreakOnLattices) {
  std::mt19937_64 rng(15);
  for (const int percent : {1, 10, 50, 100}) {
    SCOPED_TRACE(testing::Message() << percent << " percent");
    Input points = {{0, 0, 0}, {15, 0, 0}, {0, 15, 0}, {0, 0, 15}};
    for (int i = 0; i < 4096; ++i)
      if (static_cast<int>(rng() % 100) < percent)
        points.emplace_back(i / 256, i / 16 % 16, i % 16);
    const Triangulation3 t(points);
    Mesh3 with(t.points());
    Mesh3 without(t.points());
    EXPECT_GT(with.tie_reach2, 0);
    without.tie_reach2 = 0;
    for (Mesh3* mesh : {&with, &without})
      insert_all(*mesh, t.cells()[0].vertex, {});
    EXPECT_TRUE(sorted_corners(with) == sorted_corners(without));
  }
}

TEST(Triangulation3, CountsOnlyInBuildsThatAskForIt) {
  const Triangulation3 t(make_points<3>(Family::Grid, 500, 13));
  const Counters& counters = t.counters();
  if (kCounting) {
    EXPECT_GE(counters.cells_made, t.cells().size() - 5);
    EXPECT_GT(counters.sphere_tests, counters.exact_tests);
    EXPECT_GT(counters.exact_tests, 0);
    EXPECT_GT(counters.walk_steps, 0);
  } else {
    EXPECT_EQ(counters.cells_made + counters.sphere_tests +
                  counters.exact_tests + counters.walk_steps,
              0);
  }
}

struct PaperSet {
  const char* file;
  std::size_t n_points, n_cells, n_triangles;
};

// Counts of an independent implementation (DESIGN section 3).
constexpr PaperSet kPaperSets[] = {
    {"hoppe_knot108s_10000", 10000, 91189, 183536},
    {"hoppe_mannequin_12772", 12772, 83071, 167938},
    {"hoppe_oilpmp_30937", 30933, 195808, 393970},
    {"stanford_bun_zipper", 35947, 246227, 494016},
    {"hoppe_club71_16864", 16864, 109641, 221507},
    {"srt_Foot", 10010, 69331, 139740},
    {"libigl_3holes", 3596, 23339, 47878},
    {"stanford_dragon_res3", 22998, 159820, 320011}};

TEST(Triangulation3, HasTheCountsOfThePaperSets) {
  for (const PaperSet& set : kPaperSets) {
    SCOPED_TRACE(set.file);
    const auto points = test_support::paper_set(set.file);
    if (!points) GTEST_SKIP() << "UMBRELLA_DATA does not hold " << set.file;
    const Triangulation3 t(*points);
    EXPECT_EQ(t.points().size(), set.n_points);
    EXPECT_EQ(t.n_finite_cells(), set.n_cells);
    // Two cells share a facet; two infinite cells share each hull edge, of
    // which there are 3/2 a hull facet, and have no triangle there.
    const std::size_t n_hull = t.cells().size() - t.n_finite_cells();
    EXPECT_EQ(2 * t.n_finite_cells() + n_hull / 2, set.n_triangles);
  }
}

TEST(SlowTriangulation3, IsSoundOnLargeFamilies) {
  for (const Family family : kFamilies) {
    SCOPED_TRACE(trace(family, 20000));
    const Triangulation3 t(make_points<3>(family, bounded(family, 20000), 6));
    EXPECT_EQ(first_violation(t), "");
  }
}

TEST(SlowTriangulation3, IsSoundOnEveryShape) {
  for (const shapes::Shape& shape : shapes::all()) {
    if (shape.dimension != 3) continue;
    SCOPED_TRACE(shape.name);
    const Triangulation3 t(shapes::sample(shape.name, 30000));
    EXPECT_EQ(first_violation(t), "");
  }
}

TEST(SlowTriangulation3, HoldsExactlyTheTetrahedraWithEmptySpheres) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const Family family : kFamilies) {
      const std::size_t n = 4 + 3 * seed;
      SCOPED_TRACE(trace(family, n) << ", seed " << seed);
      const Triangulation3 t(make_points<3>(family, n, 1000 + seed));
      EXPECT_EQ(first_violation(t), "");
      EXPECT_EQ(tests::first_full_ball(t), "");
      EXPECT_THAT(tests::sorted_cells(t),
                  ElementsAreArray(tests::brute_force_cells(t.points())));
    }
  }
}

}  // namespace
}  // namespace delaunay
