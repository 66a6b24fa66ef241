/// @file
/// Exact side of a diametral ball: the smallest ball with the corners of an
/// edge (2D) or triangle (3D) on its boundary. A simplex is Gabriel when no
/// sample point lies in that ball, open.
#pragma once

namespace predicates {

/// +1 if p lies outside the circle with diameter ab, 0 on it, -1 inside.
/// Points are pointers to 2 finite doubles.
int gabriel_edge(const double* a, const double* b, const double* p);

/// +1 if p lies outside the sphere with the circumcircle of abc as equator, 0
/// on it, -1 inside. Points are pointers to 3 finite doubles.
/// @pre a, b, c are not collinear (collinear corners give 0)
int gabriel_triangle(const double* a, const double* b, const double* c,
                     const double* p);

}  // namespace predicates
