/// @file
/// Crust and Cocone: the triangles that Voronoi vertices far from the surface
/// leave standing. Both go on to the clean-up, which takes the place of their
/// own extraction of a manifold.
#pragma once

#include <numbers>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// The triangles among samples alone in the Delaunay triangulation of samples
/// and poles [Amenta98; Amenta99, Sec. 4]. They are triangles of the given
/// triangulation as well, ties included: the perturbation that decides ties
/// depends on coordinates alone. No filtering by normals.
///
/// @return ascending by corners; poles are rounded, all else is exact. A pole
///   too far away for a double is left out
std::vector<LocatedTriangle> crust(
    const delaunay::Triangulation3& triangulation,
    const Circumspheres& spheres);

/// The triangles whose dual Voronoi edge meets the cocone of each corner: the
/// points seen from there within `angle` of the plane across the pole's
/// direction [Amenta02].
///
/// @param angle  in (0, pi / 2)
/// @return ascending by corners; decided in doubles
std::vector<LocatedTriangle> cocone(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double angle = std::numbers::pi / 8);

}  // namespace umbrella
