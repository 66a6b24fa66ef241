/// @file
/// Signs by integers wide enough for the exponents at hand: the exact stage.
#pragma once

namespace predicates::internal {

int orient2d_integer(const double* a, const double* b, const double* c);
int orient3d_integer(const double* a, const double* b, const double* c,
                     const double* d);
int incircle_integer(const double* a, const double* b, const double* c,
                     const double* d);
int insphere_integer(const double* a, const double* b, const double* c,
                     const double* d, const double* e);
int gabriel_edge_integer(const double* a, const double* b, const double* p);
int gabriel_triangle_integer(const double* a, const double* b, const double* c,
                             const double* p);

}  // namespace predicates::internal
