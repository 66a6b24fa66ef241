/// @file
/// What is known of the analytic surfaces: topology, and the distance to them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string_view>

namespace shapes {

struct Truth {
  int genus = 0;  ///< of all components together
  int components = 1;
  /// From a point near the surface to the surface.
  std::function<double(const Eigen::Vector3d&)> distance;
  /// Otherwise to first order: off by the square of itself times the
  /// curvature.
  bool is_exact = true;
};

/// None for what is no closed surface.
/// @throws std::invalid_argument  no such shape
std::optional<Truth> truth(std::string_view name);

}  // namespace shapes
