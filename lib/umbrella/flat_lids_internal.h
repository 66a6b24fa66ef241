/// @file
/// Flat discs of a surface whose corners lie on one circle.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Triangles of one plane, all of whose corners lie on one circle, with no gap
/// of more than an eighth of it. So there are eight or more.
///
/// Points of a smooth face do not lie like that, nor do those of a grid: a
/// circle with so many of them and none within is an edge of the shape.
struct FlatLid {
  std::vector<TriangleIndex> triangles;
  std::vector<VertexId> rim;  ///< ascending
  // Lengths are in the unit of Cell::center, in which no product here leaves
  // the range of doubles.
  Point3 center;
  Point3 normal;  ///< unit, to either side
  double radius = 0;
  /// Corners about which the surface does not leave the plane: no edge of the
  /// shape with the lid, though the points say that there is one.
  std::size_t n_flat = 0;
  /// Mean distance to the rim of other such vertices that are joined to it, but
  /// for those on rims: how far apart points are within the face; 0 if there
  /// are none.
  double spacing = 0;

  /// What a place may be off by, as part of the radius or of its distance from
  /// the centre. Files hold CAD models with five digits or so; thinner
  /// triangles on the rim lose two of them.
  static constexpr double kTolerance = 1e-2;
};

/// Whether there are eight or more, with no gap of more than an eighth.
///
/// @param arms  from one point of the axis, along which they may differ
bool is_closed_round(std::span<const Point3> arms, const Point3& axis);

/// @param surface  closed: each edge has two triangles
/// @return by their first triangle; they share no triangle
std::vector<FlatLid> find_flat_lids(
    const delaunay::Triangulation3& triangulation,
    const WorkingSurface& surface);

}  // namespace umbrella
