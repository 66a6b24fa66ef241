/// @file
/// Methods that say which cells are inside and return the boundary.
#pragma once

#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// What the next cell to be carved off is chosen by.
enum class CarveOrder {
  /// Boissonnat's: how far the cell's circumsphere bulges out beyond a facet on
  /// the boundary [Boissonnat84].
  Bulge,
  /// Veltkamp's: 1 - lambda towards the cell, negative if the sphere's centre
  /// is
  /// on the inner side [Veltkamp94]. It does not depend on size.
  Gamma
};

/// Sculpture: from the convex hull, boundary cells are carved off, the first in
/// the order first, as long as some vertex is inside. A cell may go if it has
/// one facet on the boundary and its fourth corner inside, or two facets and
/// the opposite edge inside: then the boundary stays a sphere. Vertices that no
/// such cell reaches stay inside.
///
/// @return the boundary, ascending by corners; numbers order, and what may go
/// is
///   decided exactly
std::vector<LocatedTriangle> sculpture(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    CarveOrder order = CarveOrder::Bulge);

/// BallMerge, global [Parakkat24]: neighbouring cells whose circumballs overlap
/// by more than `ratio`, see intersection_ratio(), merge; beyond the hull there
/// is one cell more, whose ball is a half-space. Returns the boundary of the
/// merged body with most cells among those that do not reach the outside.
///
/// @param ratio  delta, in [0, 2]; the authors use 1.7 to 1.92
std::vector<LocatedTriangle> ball_merge(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double ratio = 1.8);

}  // namespace umbrella
