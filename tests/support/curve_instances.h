/// @file
/// Samples of plane curves whose true edges are known: the inputs of the
/// benchmark of curve reconstruction and of its tests.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tests {

using CurveEdge = std::array<std::uint32_t, 2>;

struct CurveInstance {
  std::string name;  ///< what was drawn, for people
  std::vector<Eigen::Vector2d> points;
  std::vector<CurveEdge> truth;  ///< rows, ends and edges ascending
  bool one_closed_curve = true;  ///< through all points
};

/// smooth, corner, star, jitter, components, open: points on their curves.
std::span<const std::string_view> clean_curve_groups();
/// noise, outliers
std::span<const std::string_view> spoilt_curve_groups();

/// The instance depends on the arguments alone, up to the rounding of libm.
///
/// @throws std::invalid_argument  no such group
CurveInstance make_curve_instance(std::string_view group, std::uint64_t seed);

/// Are all true edges in the Delaunay triangulation? If not, no choice of
/// Delaunay edges is right.
bool truth_is_delaunay(const CurveInstance& instance);

/// Ends ascending, then edges ascending.
std::vector<CurveEdge> in_order(std::vector<CurveEdge> edges);

}  // namespace tests
