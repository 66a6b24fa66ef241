/// @file
/// Samples of analytic shapes: input for tests, benchmarks and first trials.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shapes {

struct Shape {
  std::string_view name;
  int dimension;  ///< 2: every sample has z = 0
  std::string_view description;
};

/// Every shape `sample` knows: surfaces, volumes and lattices, then curves.
std::span<const Shape> all();

struct Options {
  std::uint64_t seed = 1;
  /// Largest displacement of a coordinate, in units of the distance between
  /// neighbours; none: what suits the shape (0, but for the knot).
  std::optional<double> noise = std::nullopt;
};

/// n points of the shape called `name`, of a size near 1. The bytes depend on
/// the arguments alone: only operations that IEEE 754 fixes are used. Points on
/// surfaces keep a distance (blue noise), and lie near each other in the order
/// returned; the time is about linear in n.
///
/// @throws std::invalid_argument  no such shape, or the noise is negative or
///   not finite
std::vector<Eigen::Vector3d> sample(std::string_view name, std::size_t n,
                                    const Options& options = {});

}  // namespace shapes
