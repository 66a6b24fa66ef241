/// @file
/// Triangles of another reconstruction, in the filter's place.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/certificate.h"
#include "umbrella/circumspheres.h"
#include "umbrella/rank_order.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// faces = degenerate + duplicates + not_delaunay + kept.
struct FaceCounts {
  std::size_t faces = 0;
  std::size_t degenerate = 0;    ///< two corners at one point
  std::size_t duplicates = 0;    ///< on the same points as an earlier one
  std::size_t not_delaunay = 0;  ///< no triangle of the triangulation
  std::size_t kept = 0;          ///< the others
};

struct GivenFaces {
  RankedTriangles triangles;  ///< kept; by ascending corners
  FaceCounts counts;
};

/// Finds faces among the Delaunay triangles, and ranks them as the paper does.
///
/// @param triangulation  of dimension 3; must outlive the triangles' order
/// @param faces  rows of the points that the triangulation was made from;
///   in any order and orientation, perhaps no surface at all
/// @throws std::invalid_argument  a face names a row that is not there
GivenFaces locate_faces(const delaunay::Triangulation3& triangulation,
                        const Circumspheres& spheres,
                        std::span<const IndexedTriangle> faces);

}  // namespace umbrella
