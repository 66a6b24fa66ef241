/// @file
/// Closed curves and samples of them, for the statements of [Adamy02, Sec. 3.1]
/// and its appendix.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string_view>
#include <vector>

namespace tests {

/// Curves with a tangent everywhere: circle, ellipse, wave.
std::span<const std::string_view> regular_curves();
/// Curves that never turn back, with corners: square, drop, star.
std::span<const std::string_view> benign_curves();

/// Points in order along the curve, which has length 1, at random distances:
/// each point of the curve is within epsilon of one of them.
///
/// @throws std::invalid_argument  no such curve
std::vector<Eigen::Vector2d> sample_curve(std::string_view curve,
                                          double epsilon, std::mt19937_64& rng);

/// A Delaunay edge of a sample with its lambda-interval.
struct EdgeInterval {
  double lower = 0;
  double upper = 0;
  bool is_right = false;  ///< its ends follow each other on the curve
};

/// All Delaunay edges of a sample in order; counts the right edges that are
/// none in `n_missing`.
std::vector<EdgeInterval> edge_intervals(
    const std::vector<Eigen::Vector2d>& sample, std::size_t& n_missing);

/// The sample of the appendix: the arc of the unit interval and of y = x^2,
/// joined below to a closed curve. Points 0 and 1 follow each other on it.
std::vector<Eigen::Vector2d> cusp_sample(unsigned n);

}  // namespace tests
