#include "predicates/gabriel.h"

#include "predicates/exact_internal.h"
#include "predicates/filter_internal.h"

namespace predicates {
namespace {

using internal::certain_sign;
using internal::kRoundoff;
using internal::rounded_difference2;
using internal::rounded_difference3;

int gabriel_edge_filter(const double* a, const double* b, const double* p) {
  const auto g = internal::gabriel_edge_polynomial(rounded_difference2(a, p),
                                                   rounded_difference2(b, p));
  return certain_sign(g.value, 5 * kRoundoff * g.magnitude + 0x1p-1000);
}

int gabriel_triangle_filter(const double* a, const double* b, const double* c,
                            const double* p) {
  const auto u = rounded_difference3(a, c);
  const auto v = rounded_difference3(b, c);
  const auto w = rounded_difference3(p, c);
  const auto g = internal::gabriel_triangle_polynomial(u, v, w);
  const double size = 1 + (dot(u, u).value + dot(v, v).value + dot(w, w).value);
  return certain_sign(g.value,
                      20 * kRoundoff * g.magnitude + 0x1p-1000 * (size * size));
}

}  // namespace

int gabriel_edge(const double* a, const double* b, const double* p) {
  const int certain = gabriel_edge_filter(a, b, p);
  return certain != 0 ? certain : internal::gabriel_edge_integer(a, b, p);
}

int gabriel_triangle(const double* a, const double* b, const double* c,
                     const double* p) {
  const int certain = gabriel_triangle_filter(a, b, c, p);
  return certain != 0 ? certain
                      : internal::gabriel_triangle_integer(a, b, c, p);
}

}  // namespace predicates
