/// @file
/// Voronoi vertices far from their sample: they see the surface's normal.
#pragma once

#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"

namespace umbrella {

using delaunay::CellId;
using delaunay::Point3;

/// The centres of the spheres through the corners of all finite cells. On the
/// right side of the cell and as far away as its radius says, but the direction
/// is rounded, badly so for slivers. Not finite where that overflows.
std::vector<Point3> circumcenters(const delaunay::Triangulation3& triangulation,
                                  const Circumspheres& spheres);

/// What the Voronoi cell of one sample tells [Amenta99, Sec. 2].
struct Poles {
  /// Towards the farthest Voronoi vertex; on the hull, where the cell is not
  /// bounded, the mean of the outward normals of the hull facets. Unit.
  Point3 normal = Point3::Zero();
  /// The cells whose centres are the poles: the farthest vertex, and the
  /// farthest on the other side of the tangent plane.
  bool has_outer = false, has_inner = false;
  CellId outer{}, inner{};
};

/// The poles of each vertex.
/// @param centers  the triangulation's circumcenters()
std::vector<Poles> poles(const delaunay::Triangulation3& triangulation,
                         const Circumspheres& spheres,
                         const std::vector<Point3>& centers);

}  // namespace umbrella
