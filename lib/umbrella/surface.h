/// @file
/// From a set of triangles to an oriented surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/triangle.h"

namespace umbrella {

/// Ids of corners, counter-clockwise seen from outside; the smallest first.
using OrientedTriangle = std::array<std::uint32_t, 3>;

struct OrientedSurface {
  std::vector<OrientedTriangle> triangles;  ///< in the order of the input
  std::size_t n_components = 0;             ///< joined by edges
  /// Each edge has two triangles, and these run along it opposite ways; then
  /// each component has a volume that is not negative.
  bool is_closed = false;
};

/// Turns the triangles of each component alike, from the first one on, across
/// edges with two triangles; then, if its volume is negative, all of them. So
/// a component that is not closed is turned alike as far as that goes, and has
/// no outside.
///
/// @param points  corners are positions in it
/// @param triangles  distinct
OrientedSurface orient(std::span<const Point3> points,
                       std::span<const LocatedTriangle> triangles);

}  // namespace umbrella
