// The statements of [Adamy02, Sec. 3.1] and its appendix, on samples. What is
// true in the limit is asked for at a fixed density, docs/theory.md.

#include "tests/support/curve_theory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/curve_instances.h"
#include "umbrella/curve.h"

namespace tests {
namespace {

using Eigen::Vector2d;

bool is_exact(const std::vector<Vector2d>& sample) {
  const auto n = static_cast<std::uint32_t>(sample.size());
  std::vector<CurveEdge> truth;
  for (std::uint32_t i = 0; i < n; ++i) truth.push_back({i, (i + 1) % n});
  return in_order(umbrella::reconstruct_curve(
                      sample, {.mode = umbrella::CurveMode::Paper})
                      .edges) == in_order(truth);
}

/// The extremes of the lambda-intervals of a sample.
struct Extremes {
  double right_lower = 0;  // the largest
  bool right_are_gabriel = true;
  double wrong = 1;  // the least of max(lower, 1 - upper)
};

Extremes extremes(const std::vector<Vector2d>& sample) {
  std::size_t n_missing = 0;
  Extremes all;
  for (const EdgeInterval& edge : edge_intervals(sample, n_missing)) {
    if (edge.is_right) {
      all.right_lower = std::max(all.right_lower, edge.lower);
      all.right_are_gabriel = all.right_are_gabriel && edge.upper == 1;
    } else {
      all.wrong = std::min(all.wrong, std::max(edge.lower, 1 - edge.upper));
    }
  }
  all.right_are_gabriel = all.right_are_gabriel && n_missing == 0;
  return all;
}

TEST(CurveTheory, Theorem31DenseSamplesOfRegularCurvesAreExact) {
  std::mt19937_64 rng(31);
  for (const std::string_view curve : regular_curves()) {
    SCOPED_TRACE(curve);
    for (int trial = 0; trial < 60; ++trial) {
      const auto sample = sample_curve(curve, 0.004, rng);
      EXPECT_GT(sample.size(), 125);
      EXPECT_TRUE(is_exact(sample)) << "trial " << trial;
    }
  }
}

TEST(CurveTheory, Theorem31NeedsTheDensity) {
  std::mt19937_64 rng(32);
  int n_exact = 0;
  for (int trial = 0; trial < 30; ++trial)
    n_exact += is_exact(sample_curve("wave", 0.045, rng)) ? 1 : 0;
  EXPECT_LT(n_exact, 15);
}

TEST(CurveTheory, Table1RightEdgesOfRegularCurves) {
  std::mt19937_64 rng(33);
  for (const std::string_view curve : regular_curves()) {
    SCOPED_TRACE(curve);
    double before = 1;
    for (const double epsilon : {0.004, 0.001, 0.00025}) {
      const Extremes found = extremes(sample_curve(curve, epsilon, rng));
      EXPECT_TRUE(found.right_are_gabriel);
      EXPECT_LE(found.right_lower, 0.5 * before);  // 0 on convex curves
      before = found.right_lower;
    }
  }
}

TEST(CurveTheory, Table1WrongEdgesOfRegularCurves) {
  std::mt19937_64 rng(34);
  for (const std::string_view curve : regular_curves()) {
    SCOPED_TRACE(curve);
    for (const double epsilon : {0.004, 0.001, 0.00025})
      EXPECT_GT(extremes(sample_curve(curve, epsilon, rng)).wrong, 0.05);
  }
}

TEST(CurveTheory, Table1RightEdgesOfBenignCurves) {
  std::mt19937_64 rng(35);
  constexpr double kRounding = 1e-9;  // straight sides on the hull
  for (const std::string_view curve : benign_curves()) {
    SCOPED_TRACE(curve);
    double before = 1;
    for (const double epsilon : {0.004, 0.001, 0.00025}) {
      double worst = 0;
      for (int trial = 0; trial < 5; ++trial)
        worst = std::max(
            worst, extremes(sample_curve(curve, epsilon, rng)).right_lower);
      EXPECT_LT(worst, std::max(before, kRounding));
      before = worst;
    }
  }
}

TEST(CurveTheory, TheoremA1RightEdgesOfBenignCurvesAreDelaunay) {
  std::mt19937_64 rng(36);
  for (const std::string_view curve : benign_curves()) {
    SCOPED_TRACE(curve);
    for (int trial = 0; trial < 40; ++trial) {
      std::size_t n_missing = 0;
      edge_intervals(sample_curve(curve, 0.004, rng), n_missing);
      EXPECT_EQ(n_missing, 0) << "trial " << trial;
    }
  }
}

/// Radius of the circle through three points.
double circumradius(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a;
  const Vector2d v = c - a;
  return u.norm() * v.norm() * (v - u).norm() /
         (2 * std::abs(u.x() * v.y() - u.y() * v.x()));
}

TEST(CurveTheory, TheoremA1FailsAtACusp) {
  double before = 0;
  for (const unsigned n : {10, 20, 40, 80}) {
    SCOPED_TRACE(testing::Message() << "n = " << n);
    const auto points = cusp_sample(n);
    const double radius = circumradius(points[0], points[1], points[2]);
    EXPECT_GT(radius, 1.5 * before);
    before = radius;
    CurveInstance cusp;
    cusp.points = points;
    cusp.truth = {{0, 1}};
    EXPECT_FALSE(truth_is_delaunay(cusp));
  }
}

TEST(CurveTheory, LemmaA1CirclesShrinkUnlessPointsAlign) {
  // Towards (0, 0): at a corner of 60 degrees, and along a parabola.
  for (const double h : {1e-1, 1e-2, 1e-3, 1e-4}) {
    EXPECT_LT(circumradius({h, 0}, {0, 0}, {h / 2, h}), 2 * h);
    EXPECT_GT(circumradius({-h, h * h}, {0, 0}, {h, h * h}), 0.5);
  }
}

}  // namespace
}  // namespace tests
