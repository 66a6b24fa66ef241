#include "delaunay/spatial_sort.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using testing::ElementsAreArray;
using tests::Family;
using tests::make_points;

// Cells of a 2^k grid follow each other face to face along the curve.
template <int kDim>
void expect_unit_steps(int side) {
  std::vector<Eigen::Matrix<double, kDim, 1>> points;
  const int n = kDim == 2 ? side * side : side * side * side;
  for (int i = 0; i < n; ++i) {
    Eigen::Matrix<double, kDim, 1> p;
    for (int k = 0, rest = i; k < kDim; ++k, rest /= side)
      p[k] = rest % side + 0.5;
    points.push_back(p);
  }
  // The corners of the bounding cube put the grid's cells on the curve's.
  points.push_back(Eigen::Matrix<double, kDim, 1>::Constant(0));
  points.push_back(Eigen::Matrix<double, kDim, 1>::Constant(side));
  const auto order =
      spatial_order(std::span<const Eigen::Matrix<double, kDim, 1>>(points));
  int n_steps = 0;
  for (std::size_t i = 1; i < order.points.size(); ++i)
    n_steps += (order.points[i] - order.points[i - 1]).norm() == 1 ? 1 : 0;
  // Each corner may break one step, in two.
  EXPECT_GE(n_steps, n - 3);
}

TEST(SpatialOrder, StepsToTheNextCellOfAGrid) {
  expect_unit_steps<2>(32);
  expect_unit_steps<3>(16);
}

TEST(SpatialOrder, IsAPermutationOfTheDistinctPoints) {
  for (const tests::Family family : tests::kFamilies) {
    SCOPED_TRACE(tests::name(family));
    auto rows = tests::make_points<3>(family, 500, 1);
    const SpatialOrder<3> order = spatial_order(rows);
    ASSERT_EQ(order.vertex_of_row.size(), rows.size());
    std::set<std::array<double, 3>> distinct;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      EXPECT_EQ(order.points[index(order.vertex_of_row[row])], rows[row]);
      distinct.insert({rows[row][0], rows[row][1], rows[row][2]});
    }
    EXPECT_EQ(order.points.size(), distinct.size());

    std::ranges::shuffle(rows, std::mt19937_64(2));
    EXPECT_THAT(spatial_order(rows).points, ElementsAreArray(order.points));
  }
}

TEST(SpatialOrder, KeepsClustersTogether) {
  // Two clusters, each far finer than the curve through both.
  std::mt19937_64 rng(3);
  std::vector<Eigen::Vector3d> rows;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d center = Eigen::Vector3d::Constant(i % 2);
    const auto unit = [&] {
      return std::ldexp(static_cast<double>(rng()), -64);
    };
    rows.push_back(center + 1e-9 * Eigen::Vector3d{unit(), unit(), unit()});
  }
  const SpatialOrder<3> order = spatial_order(rows);
  double length = 0;  // of the path within clusters, in cluster sizes
  for (std::size_t i = 1; i < order.points.size(); ++i) {
    const double step = (order.points[i] - order.points[i - 1]).norm();
    if (step < 0.5) length += step / 1e-9;
  }
  // A curve through m uniform points is about m^(2/3) long; a random order or
  // one by x alone would be about m/2.
  EXPECT_LT(length, 4 * std::pow(4000, 2.0 / 3));
}

TEST(SpatialOrder, IsTheSameOnAnyNumberOfThreads) {
  for (const Family family : {Family::Uniform, Family::Clustered}) {
    SCOPED_TRACE(tests::name(family));
    const auto rows = make_points<3>(family, 300000, 5);
    const SpatialOrder<3> expected = spatial_order(rows);
    for (const unsigned threads : {2U, 5U}) {
      const SpatialOrder<3> order = spatial_order(rows, threads);
      EXPECT_TRUE(order.points == expected.points);
      EXPECT_TRUE(order.vertex_of_row == expected.vertex_of_row);
    }
  }
}

TEST(InsertionOrder, VisitsEachVertexOnceInAscendingRounds) {
  for (const std::size_t n : {0, 1, 2, 511, 512, 513, 5000, 100000}) {
    SCOPED_TRACE(n);
    std::vector<VertexId> order = insertion_order(n);
    std::size_t n_rounds = 1;
    for (std::size_t i = 1; i < order.size(); ++i)
      n_rounds += order[i] < order[i - 1] ? 1 : 0;
    EXPECT_LE(n_rounds, 2 + std::log2(n + 1) / 3);
    std::ranges::sort(order);
    ASSERT_EQ(order.size(), n);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(index(order[i]), i);
  }
}

}  // namespace
}  // namespace delaunay
