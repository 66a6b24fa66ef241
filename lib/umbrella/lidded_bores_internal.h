/// @file
/// Where a closed surface has lids on the ends of bores.
#pragma once

#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Where a bore goes through a face. Lengths are in the unit of length_unit().
struct BoreEnd {
  std::vector<VertexId> rim;  ///< ascending
  Point3 center;
  Point3 normal;  ///< unit, to either side
  double radius = 0;
};

/// A bore and what is in its way.
struct LiddedBore {
  std::vector<VertexId> rims;         ///< of both ends, ascending
  std::vector<LocatedTriangle> lids;  ///< to be taken off
  std::vector<BoreEnd> ends;          ///< but for one that keeps its lid
  /// Whether a part of its wall is on the surface, with the air on the wrong
  /// side. To take off the lids alone would leave a notch.
  bool is_half_open = false;
};

/// By what the points say: two flat lids on one axis face each other through
/// the body, and for most corners of a rim there is no other reason than a
/// bore. For a quarter is enough where the bore is half open: that it is opened
/// has to bring the face about it back.
///
/// A lid may be the only one. Then the other end is a mouth: a circle of points
/// of the same size on the same axis, with the face about it on the surface,
/// which looks away from the lid. If it is in front of the lid, the body
/// between them has been lost, and it is half open.
///
/// @param surface  closed and manifold
/// @param effort  of it, a propagation is taken for each point looked at where
///   a lid is alone
std::vector<LiddedBore> find_lidded_bores(
    const delaunay::Triangulation3& triangulation,
    const WorkingSurface& surface, Effort& effort);

}  // namespace umbrella
