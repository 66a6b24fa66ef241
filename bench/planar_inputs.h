/// @file
/// Inputs of the benchmarks in the plane.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace bench {

/// Uniform in the unit square; integer grid; integer points of one circle, up
/// to 147456; closed wavy curve with noise; grid of neighbouring doubles around
/// 0.5; exactly on a skew line; uniform ones times 1e80 and 1e-80.
inline constexpr std::array<std::string_view, 8> kPlanarInputs = {
    "uniform",  "grid",      "cocircular",   "curve",
    "ulp_grid", "collinear", "uniform_1e80", "uniform_1e-80"};

/// @param kind  of kPlanarInputs
/// @param n     about so many points, in random order
std::vector<Eigen::Vector2d> planar_input(std::string_view kind, std::size_t n);

}  // namespace bench
