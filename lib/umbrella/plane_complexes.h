/// @file
/// The subcomplexes of complexes.h in the plane, by their edges [Adamy02,
/// Sec. 2]; discs take the place of balls.
///
/// Lambdas and radii are doubles, with an absolute error of lambda below 2^-48;
/// Gabriel edges and the hull are exact. Edges are ascending and depend on the
/// set of points alone. All are empty if the points are collinear.
#pragma once

#include <optional>
#include <vector>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_filter.h"

namespace umbrella {

/// @pre 0 <= lower <= upper <= 1
std::vector<Edge> lambda_complex(const delaunay::Triangulation2& triangulation,
                                 double lower, double upper);

/// The Gabriel graph.
std::vector<Edge> gabriel_complex(
    const delaunay::Triangulation2& triangulation);

/// The circle-based beta-skeleton [Kirkpatrick85].
/// @pre beta >= 1
std::vector<Edge> beta_skeleton(const delaunay::Triangulation2& triangulation,
                                double beta);

/// @pre -1 <= c0 <= c1 <= 1
std::vector<Edge> gamma_graph(const delaunay::Triangulation2& triangulation,
                              double c0, double c1);

/// @param alpha  >= 0, in the unit of the points
std::vector<Edge> alpha_shape(const delaunay::Triangulation2& triangulation,
                              double alpha);

/// None below dimension 2.
std::optional<double> smallest_alpha(
    const delaunay::Triangulation2& triangulation);

}  // namespace umbrella
