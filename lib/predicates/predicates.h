/// @file
/// Exact signs of the determinants that decide a Delaunay triangulation.
///
/// Points are pointers to 2 or 3 finite doubles. Every sign is the sign of the
/// exact real determinant of the given doubles, for all of them: subnormals,
/// any spread of exponents. No state, no initialisation, no allocation.
#pragma once

#include "predicates/filter_internal.h"

namespace predicates {

/// Later stages, out of line: the same sign without the filter.
int orient2d_exact(const double* a, const double* b, const double* c);
int orient3d_exact(const double* a, const double* b, const double* c,
                   const double* d);
int incircle_exact(const double* a, const double* b, const double* c,
                   const double* d);
int insphere_exact(const double* a, const double* b, const double* c,
                   const double* d, const double* e);
int incircle_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d);
int insphere_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d, const double* e);

/// Sign of det(b - a, c - a): +1 if a, b, c turn left, -1 right, 0 collinear.
inline int orient2d(const double* a, const double* b, const double* c) {
  const int certain = internal::orient2d_filter(a, b, c);
  return certain != 0 ? certain : orient2d_exact(a, b, c);
}

/// Sign of det(b - a, c - a, d - a): +1 if the tetrahedron is right-handed
/// (0, e_x, e_y, e_z is), 0 if coplanar.
inline int orient3d(const double* a, const double* b, const double* c,
                    const double* d) {
  const int certain = internal::orient3d_filter(a, b, c, d);
  return certain != 0 ? certain : orient3d_exact(a, b, c, d);
}

/// +1 if d lies inside the circle through a, b, c, 0 on it, -1 outside.
/// @pre orient2d(a, b, c) > 0; with < 0 the sign is reversed
inline int incircle(const double* a, const double* b, const double* c,
                    const double* d) {
  const int certain = internal::incircle_filter(a, b, c, d);
  return certain != 0 ? certain : incircle_exact(a, b, c, d);
}

/// +1 if e lies inside the sphere through a, b, c, d, 0 on it, -1 outside.
/// @pre orient3d(a, b, c, d) > 0; with < 0 the sign is reversed
inline int insphere(const double* a, const double* b, const double* c,
                    const double* d, const double* e) {
  const int certain = internal::insphere_filter(a, b, c, d, e);
  return certain != 0 ? certain : insphere_exact(a, b, c, d, e);
}

/// As incircle, with cocircular points told apart by an infinitesimal raise
/// of the lifted points: the lexicographically larger the point, the larger
/// its raise (by orders of magnitude). Depends on coordinates alone, never on
/// the order of insertion [Edelsbrunner90; Devillers11]. Never 0.
/// @pre orient2d(a, b, c) > 0; d differs from a, b and c
inline int incircle_perturbed(const double* a, const double* b, const double* c,
                              const double* d) {
  const int certain = internal::incircle_filter(a, b, c, d);
  return certain != 0 ? certain : incircle_perturbed_exact(a, b, c, d);
}

/// As insphere, perturbed like incircle_perturbed. Never 0.
/// @pre orient3d(a, b, c, d) > 0; e differs from a, b, c and d
inline int insphere_perturbed(const double* a, const double* b, const double* c,
                              const double* d, const double* e) {
  const int certain = internal::insphere_filter(a, b, c, d, e);
  return certain != 0 ? certain : insphere_perturbed_exact(a, b, c, d, e);
}

}  // namespace predicates
