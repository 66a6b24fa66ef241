#include "predicates/gabriel.h"

#include "predicates/exact_internal.h"
#include "predicates/filter_internal.h"

namespace predicates {

int gabriel_edge(const double* a, const double* b, const double* p) {
  const int certain = internal::gabriel_edge_filter(a, b, p);
  if (certain != 0) return certain;
  return internal::exact_sign<internal::GabrielEdge>({a, b, p});
}

int gabriel_triangle(const double* a, const double* b, const double* c,
                     const double* p) {
  const int certain = internal::gabriel_triangle_filter(a, b, c, p);
  if (certain != 0) return certain;
  return internal::exact_sign<internal::GabrielTriangle>({a, b, c, p});
}

}  // namespace predicates
