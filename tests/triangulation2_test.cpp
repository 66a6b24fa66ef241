#include "delaunay/triangulation2.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "delaunay/validate.h"
#include "tests/support/brute_delaunay.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using testing::ElementsAreArray;
using tests::Family;
using tests::kFamilies;
using tests::make_points;

using Input = std::vector<Point2>;

testing::Message trace(Family family, std::size_t n) {
  return testing::Message() << tests::name(family) << ", n = " << n;
}

std::vector<std::array<VertexId, 3>> corners(const Triangulation2& t) {
  std::vector<std::array<VertexId, 3>> all;
  for (const Cell2& cell : t.cells()) all.push_back(cell.vertex);
  return all;
}

TEST(Triangulation2, IsSoundOnEveryFamily) {
  for (const Family family : kFamilies) {
    for (const std::size_t n : {1, 2, 3, 4, 5, 10, 100, 1000}) {
      SCOPED_TRACE(trace(family, n));
      const Triangulation2 t(make_points<2>(family, n, n));
      EXPECT_EQ(first_violation(t), "");
      if (t.dimension() == 2)
        EXPECT_EQ(t.cells().size(), 2 * t.points().size() - 2);
      else
        EXPECT_TRUE(t.cells().empty());
    }
  }
}

TEST(Triangulation2, HoldsExactlyTheTrianglesWithEmptyCircles) {
  for (const Family family : kFamilies) {
    for (const std::size_t n : {3, 5, 9, 17, 25}) {
      SCOPED_TRACE(trace(family, n));
      const Triangulation2 t(make_points<2>(family, n, 100 + n));
      EXPECT_EQ(tests::first_full_ball(t), "");
      EXPECT_THAT(tests::sorted_cells(t),
                  ElementsAreArray(tests::brute_force_cells(t.points())));
    }
  }
}

TEST(Triangulation2, DependsOnTheSetOfPointsAlone) {
  std::mt19937_64 rng(3);
  for (const Family family : kFamilies) {
    SCOPED_TRACE(trace(family, 80));
    Input rows = make_points<2>(family, 80, 4);
    const Triangulation2 t(rows);
    std::ranges::shuffle(rows, rng);
    rows.push_back(rows[5]);
    const Triangulation2 shuffled(rows);

    EXPECT_THAT(shuffled.points(), ElementsAreArray(t.points()));
    EXPECT_THAT(corners(shuffled), ElementsAreArray(corners(t)));
    EXPECT_EQ(shuffled.n_finite_cells(), t.n_finite_cells());
    ASSERT_EQ(shuffled.vertex_of_row().size(), rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
      EXPECT_EQ(shuffled.point(shuffled.vertex_of_row()[row]), rows[row]);
  }
}

TEST(Triangulation2, DoesNotChangeUnderScalingByPowersOfTwo) {
  for (const Family family :
       {Family::Uniform, Family::Grid, Family::Cospherical, Family::UlpGrid}) {
    const Input points = make_points<2>(family, 200, 5);
    const auto expected = corners(Triangulation2(points));
    for (const int exponent : {-900, -270, -60, 60, 270, 1000}) {
      SCOPED_TRACE(trace(family, 200) << ", times 2^" << exponent);
      Input scaled = points;
      for (Point2& p : scaled) p *= std::ldexp(1, exponent);
      EXPECT_THAT(corners(Triangulation2(scaled)), ElementsAreArray(expected));
    }
  }
}

TEST(Triangulation2, HasTheDimensionOfThePoints) {
  EXPECT_EQ(Triangulation2(Input{}).dimension(), -1);
  EXPECT_EQ(Triangulation2(Input{{1, 2}}).dimension(), 0);
  EXPECT_EQ(Triangulation2(Input{{1, 2}, {1, 2}}).dimension(), 0);
  EXPECT_EQ(Triangulation2(Input{{1, 2}, {2, 1}, {1, 2}}).dimension(), 1);
  EXPECT_EQ(Triangulation2(Input{{0, 0}, {1, 3}, {2, 6}}).dimension(), 1);
  EXPECT_EQ(Triangulation2(Input{{0, 0}, {1, 3}, {2, 7}}).dimension(), 2);
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(Triangulation2(Input{{0, 0}, {1e300, 0}, {7, tiny}}).dimension(),
            2);
}

TEST(Triangulation2, MergesDuplicates) {
  const Triangulation2 t(Input{{0, 0}, {1, 0}, {-0.0, 0}, {0, 1}, {1, -0.0}});
  EXPECT_EQ(t.points().size(), 3);
  EXPECT_EQ(t.vertex_of_row()[0], t.vertex_of_row()[2]);
  EXPECT_EQ(t.vertex_of_row()[1], t.vertex_of_row()[4]);
  EXPECT_EQ(t.n_finite_cells(), 1);
}

TEST(Triangulation2, NamesTheRowThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    try {
      const Triangulation2 t(Input{{0, 0}, {1, bad}, {0, 1}});
      FAIL() << "accepted " << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("row 1"));
    }
  }
}

// A point off the line comes last along it: the fan around it must not make
// the insertions quadratic (a minute, were it so).
TEST(Triangulation2, IsQuickOnALineWithOnePointOff) {
  Input points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(i, 2 * i);
  points.emplace_back(19999, 1e7);
  const Triangulation2 t(points);
  EXPECT_EQ(t.n_finite_cells(), 19999);
  EXPECT_EQ(first_violation(t), "");
}

TEST(SlowTriangulation2, IsSoundOnLargeFamilies) {
  for (const Family family : kFamilies) {
    SCOPED_TRACE(trace(family, 100000));
    const Triangulation2 t(make_points<2>(family, 100000, 6));
    EXPECT_EQ(first_violation(t), "");
  }
}

TEST(SlowTriangulation2, HoldsExactlyTheTrianglesWithEmptyCircles) {
  for (std::uint64_t seed = 3; seed < 40; seed += 4) {
    for (const Family family : kFamilies) {
      const std::size_t n = 11 + seed;
      SCOPED_TRACE(trace(family, n) << ", seed " << seed);
      const Triangulation2 t(make_points<2>(family, n, 1000 + seed));
      EXPECT_EQ(first_violation(t), "");
      EXPECT_THAT(tests::sorted_cells(t),
                  ElementsAreArray(tests::brute_force_cells(t.points())));
    }
  }
}

}  // namespace
}  // namespace delaunay
