#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "delaunay/insertion_rounds_internal.h"
#include "delaunay/spatial_sort.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using Points = std::vector<Point3>;
using Rounds = std::vector<std::vector<VertexId>>;

/// @param percent  of the places that hold a point
Points lattice_box(std::array<int, 3> size, int percent = 100) {
  std::mt19937_64 rng(17);
  Points points;
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        if (static_cast<int>(rng() % 100) < percent)
          points.emplace_back(x, y, z);
  return points;
}

Rounds rounds_of(const Points& points) {
  return insertion_rounds(Mesh3(spatial_order(points).points));
}

bool all_ascend(const Rounds& rounds) {
  return std::ranges::all_of(
      rounds, [](const auto& round) { return std::ranges::is_sorted(round); });
}

TEST(InsertionRounds, HoldEachVertexOnce) {
  for (const Points& points :
       {lattice_box({1, 1, 1}), lattice_box({20, 18, 17}),
        lattice_box({33, 16, 17}, 60), lattice_box({20, 20, 20}, 2),
        tests::make_points<3>(tests::Family::Uniform, 5000, 3)}) {
    SCOPED_TRACE(points.size());
    std::vector<VertexId> all;
    for (const auto& round : rounds_of(points)) {
      EXPECT_FALSE(round.empty());
      all.insert(all.end(), round.begin(), round.end());
    }
    std::ranges::sort(all);
    ASSERT_EQ(all.size(), points.size());
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(index(all[i]), i);
  }
}

TEST(InsertionRounds, AscendWhereNoLatticeIsFull) {
  EXPECT_TRUE(all_ascend(
      rounds_of(tests::make_points<3>(tests::Family::Uniform, 5000, 3))));
  EXPECT_TRUE(all_ascend(rounds_of(lattice_box({32, 32, 32}, 5))));
  Points far_apart = lattice_box({16, 16, 16});
  EXPECT_FALSE(all_ascend(rounds_of(far_apart)));
  // As far as 62 bits of a coordinate reach: 64 do not hold the places.
  for (Point3& p : far_apart) p *= 0x1p-40;
  far_apart.emplace_back(0x1p21, -0x1p21, 0);
  EXPECT_TRUE(all_ascend(rounds_of(far_apart)));
}

TEST(InsertionRounds, DoNotDependOnPlaceOrUnitOfALattice) {
  const Points points = lattice_box({20, 18, 17}, 90);
  const Rounds expected = rounds_of(points);
  EXPECT_FALSE(all_ascend(expected));
  for (const double unit : {1.0, 0x1p-20, 0x1p15}) {
    SCOPED_TRACE(unit);
    Points moved = points;
    for (Point3& p : moved) p = unit * (p + Point3(-7, 5, 101));
    EXPECT_TRUE(rounds_of(moved) == expected);
  }
}

/// None is above a later one along all three axes.
template <class Place>
void expect_rising(std::span<const VertexId> order, const Place& place) {
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t earlier = 0; earlier < i; ++earlier)
      ASSERT_TRUE(
          (place(order[earlier]).array() < place(order[i]).array()).any());
}

// What precedes in each round of a block is the middle of a cube of side 2, or
// else is not above what follows, seen along all three axes.
TEST(InsertionRounds, RiseAfterTheMiddlesOfCubesOnAFullLattice) {
  for (const Point3& step :
       {Point3(1, 1, 1), Point3(0.01, 0.01, 0.01), Point3(0.7, 0.7, 1.1)}) {
    SCOPED_TRACE(step.transpose());
    Points lattice = lattice_box({12, 11, 10});
    for (Point3& p : lattice) p = p.cwiseProduct(step);
    const auto points = spatial_order(lattice).points;
    const auto place = [&](VertexId v) -> Point3 {
      return points[index(v)].cwiseQuotient(step).array().round();
    };
    const auto is_middle = [&](VertexId v) {
      return std::ranges::all_of(place(v),
                                 [](double x) { return std::fmod(x, 2) == 1; });
    };
    for (const auto& round : insertion_rounds(Mesh3(points))) {
      EXPECT_TRUE(std::ranges::is_partitioned(round, is_middle));
      const auto others = std::ranges::partition_point(round, is_middle);
      expect_rising({round.begin(), others}, place);
      expect_rising({others, round.end()}, place);
    }
  }
}

// Two in one place, which the steps from each to the next do not show.
TEST(InsertionRounds, HoldEachVertexOnceWherePlacesAreShared) {
  Points points = lattice_box({9, 9, 9});
  EXPECT_FALSE(all_ascend(insertion_rounds(Mesh3(points))));
  points.emplace_back(0.2, 0, 0);
  const Rounds rounds = insertion_rounds(Mesh3(points));
  EXPECT_TRUE(all_ascend(rounds));
  std::size_t n = 0;
  for (const auto& round : rounds) n += round.size();
  EXPECT_EQ(n, points.size());
}

}  // namespace
}  // namespace delaunay
