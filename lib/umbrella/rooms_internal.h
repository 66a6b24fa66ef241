/// @file
/// Inside and outside of the surface, about one region.
#pragma once

#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "ilp/problem.h"
#include "umbrella/region_internal.h"

namespace umbrella {

/// What is known about the triangles of some cells.
struct RegionTriangles {
  /// Variable i is the i-th of these.
  std::span<const LocatedTriangle> candidates;
  /// Certainly on the surface.
  std::span<const LocatedTriangle> fixed;
  /// Ascending. Other triangles with a corner here are certainly not on it,
  std::span<const VertexId> vertices;
  /// unless all their corners are open, by vertex.
  const std::vector<bool>& is_open;
};

/// The candidates as walls between rooms, for Problem::add_sides. A room is
/// made of cells parted by triangles that are certainly on the surface (then
/// they lie on different sides of it) or certainly not (on the same side).
///
/// Holds for every closed surface: any loop of cells crosses it an even number
/// of times. There are no walls if the fixed triangles contradict that.
///
/// @param cells  the last collected; both cells of each candidate among them
std::vector<ilp::Wall> walls_between_rooms(const CellSet& cells,
                                           const RegionTriangles& triangles);

}  // namespace umbrella
