/// @file
/// The subcomplexes of the Delaunay triangulation that the paper names, by
/// their triangles [Adamy02, Sec. 2].
///
/// The open balls through a triangle's corners that hold no sample point have
/// their centres on a segment of the triangle's axis, between the centres of
/// its two cells; a sample on the boundary does not matter. So each complex
/// asks whether one or two balls lie between those of the cells. Radii and
/// lambdas are compared by the double nearest to the exact square, with the
/// square of the parameter rounded likewise: equal ones compare as equal. On
/// which side of a triangle a centre lies is decided exactly.
///
/// All results are ascending by corners and depend on the set of points alone.
#pragma once

#include <optional>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Triangles whose lambda-interval holds [lower, upper].
/// @pre 0 <= lower <= upper <= 1
std::vector<LocatedTriangle> lambda_complex(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double lower, double upper);

/// Triangles whose smallest ball is empty: the lambda-complex for [1, 1].
std::vector<LocatedTriangle> gabriel_complex(
    const delaunay::Triangulation3& triangulation,
    const Circumspheres& spheres);

/// Triangles with both balls of diameter beta diam(t) empty: the circle-based
/// skeleton [Kirkpatrick85] in space, as the paper defines it. There is no
/// lune in it. beta = 1 is the Gabriel complex.
/// @pre beta >= 1
std::vector<LocatedTriangle> beta_skeleton(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double beta);

/// The part of Veltkamp's two-parameter family [Veltkamp92] inside the Delaunay
/// triangulation. c in [-1, 1] names a ball of diameter diam(t) / (1 - |c|)
/// whose centre lies on the one side of t, or for c < 0 on the other; the
/// triangles are those for which the balls c0 and c1 are empty, with one choice
/// of the sides. Hence gamma(0, 0) is the Gabriel complex, gamma(1, 1) the
/// hull, gamma(-c, c) the beta-skeleton for 1 / (1 - c), and gamma(a, b) for 0
/// <= a <= b the lambda-complex for [1 - b, 1 - a].
/// @pre -1 <= c0 <= c1 <= 1
std::vector<LocatedTriangle> gamma_graph(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double c0, double c1);

/// Triangles with an empty ball of radius alpha through their corners
/// [Edelsbrunner94]; for infinity, a half-space.
/// @param alpha  >= 0, in the unit of the points
std::vector<LocatedTriangle> alpha_shape(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    double alpha);

/// The least alpha for which every vertex is on a triangle of the alpha-shape,
/// or would be for a smaller one; none below dimension 3. On a sample that is
/// even enough no vertex has been left behind by then.
std::optional<double> smallest_alpha(
    const delaunay::Triangulation3& triangulation,
    const Circumspheres& spheres);

}  // namespace umbrella
