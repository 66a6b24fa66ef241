#include "umbrella/curve_baselines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/curve_instances.h"
#include "tests/support/point_sets.h"
#include "umbrella/plane_complexes.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;
using testing::ElementsAreArray;

std::vector<tests::CurveEdge> rows(const Triangulation2& t,
                                   const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> row(t.points().size());
  for (std::uint32_t i = 0; i < t.vertex_of_row().size(); ++i)
    row[index(t.vertex_of_row()[i])] = i;
  std::vector<tests::CurveEdge> named;
  for (const auto& [v, w] : edges)
    named.push_back({row[index(v)], row[index(w)]});
  return tests::in_order(named);
}

TEST(CurveBaselines, AreExactOnDenseSamplesOfSmoothCurves) {
  for (unsigned trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto smooth = tests::make_curve_instance("smooth", 700 + trial);
    if (smooth.points.size() < 120) continue;
    const Triangulation2 t(smooth.points);
    EXPECT_EQ(rows(t, crust(t)), smooth.truth);
    EXPECT_EQ(rows(t, nn_crust(t)), smooth.truth);
    EXPECT_EQ(rows(t, hnn_crust(t)), smooth.truth);
    EXPECT_EQ(rows(t, beta_skeleton(t, 1.2)), smooth.truth);
  }
}

/// By the definition, over all points.
std::vector<Edge> skeleton_by_trying(const Triangulation2& t, double beta) {
  const auto points = t.points();
  std::vector<Edge> edges;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    for (std::uint32_t w = v + 1; w < points.size(); ++w) {
      const Point2 e = points[w] - points[v];
      const Point2 middle = (points[v] + points[w]) / 2;
      const double r = beta * e.norm() / 2;
      const double h = std::sqrt(std::max(0.0, r * r - e.squaredNorm() / 4));
      const Point2 up = h * Point2(-e.y(), e.x()).normalized();
      const bool is_clear = std::ranges::all_of(points, [&](const Point2& p) {
        return p == points[v] || p == points[w] ||
               ((p - middle - up).norm() >= r && (p - middle + up).norm() >= r);
      });
      if (is_clear) edges.push_back({VertexId{v}, VertexId{w}});
    }
  }
  return edges;
}

TEST(CurveBaselines, SkeletonIsThatOfTheDefinition) {
  for (const unsigned seed : {1, 2, 3, 4}) {
    for (const double beta : {1.0, 1.3, 2.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", beta " << beta);
      const Triangulation2 t(
          tests::make_points<2>(tests::Family::Uniform, 60, seed));
      EXPECT_THAT(beta_skeleton(t, beta),
                  ElementsAreArray(skeleton_by_trying(t, beta)));
      EXPECT_TRUE(beta > 1 || gabriel_complex(t) == beta_skeleton(t, 1));
    }
  }
}

TEST(CurveBaselines, DifferAtAnAngleOfSeventyDegrees) {
  // At the corner the nearest is 1; 2 lies at 70 degrees from it, 3 at 180.
  const double a = 70 * std::numbers::pi / 180;
  const std::vector<Point2> points = {
      {0, 0}, {1, 0}, {1.05 * std::cos(a), 1.05 * std::sin(a)}, {-3, -0.1}};
  const Triangulation2 t(points);
  EXPECT_THAT(rows(t, hnn_crust(t)), testing::Contains(tests::CurveEdge{0, 2}));
  EXPECT_THAT(rows(t, nn_crust(t)), testing::Contains(tests::CurveEdge{0, 3}));
  EXPECT_THAT(rows(t, hnn_crust(t)), testing::Contains(tests::CurveEdge{0, 1}));
}

}  // namespace
}  // namespace umbrella
