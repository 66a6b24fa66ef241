#include "predicates/predicates.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "predicates/exact_internal.h"

namespace predicates {
namespace {

/// Positions of the points, the lexicographically largest point first.
template <std::size_t kDim, std::size_t kPoints>
std::array<std::size_t, kPoints> descending(
    const std::array<const double*, kPoints>& point) {
  std::array<std::size_t, kPoints> order;
  for (std::size_t i = 0; i < kPoints; ++i) {
    std::size_t j = i;
    for (; j > 0 && std::lexicographical_compare(point[order[j - 1]],
                                                 point[order[j - 1]] + kDim,
                                                 point[i], point[i] + kDim);
         --j)
      order[j] = order[j - 1];
    order[j] = i;
  }
  return order;
}

}  // namespace

int orient2d_exact(const double* a, const double* b, const double* c) {
  return internal::exact_sign<internal::Orient2d>({a, b, c});
}

int orient3d_exact(const double* a, const double* b, const double* c,
                   const double* d) {
  return internal::exact_sign<internal::Orient3d>({a, b, c, d});
}

int incircle_exact(const double* a, const double* b, const double* c,
                   const double* d) {
  return internal::exact_sign<internal::Incircle>({a, b, c, d});
}

int insphere_exact(const double* a, const double* b, const double* c,
                   const double* d, const double* e) {
  return internal::exact_sign<internal::Insphere>({a, b, c, d, e});
}

// With the lifted height of point i raised by h_i, the determinant gains
// h_i times the orientation with the query in place of i, over the
// orientation of the simplex; the query's own raise counts against it. The
// raises differ by orders of magnitude: the largest point with a non-zero
// factor decides.
int incircle_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d) {
  const int exact = incircle_exact(a, b, c, d);
  if (exact != 0) return exact;
  const std::array<const double*, 4> point = {a, b, c, d};
  for (const std::size_t largest : descending<2>(point)) {
    if (largest == 3) return -1;
    std::array<const double*, 4> p = point;
    p[largest] = d;
    const int decided = orient2d(p[0], p[1], p[2]);
    if (decided != 0) return decided;
  }
  assert(false && "a, b, c are collinear or d is one of them");
  return -1;
}

int insphere_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d, const double* e) {
  const int exact = insphere_exact(a, b, c, d, e);
  if (exact != 0) return exact;
  const std::array<const double*, 5> point = {a, b, c, d, e};
  for (const std::size_t largest : descending<3>(point)) {
    if (largest == 4) return -1;
    std::array<const double*, 5> p = point;
    p[largest] = e;
    const int decided = orient3d(p[0], p[1], p[2], p[3]);
    if (decided != 0) return decided;
  }
  assert(false && "a, b, c, d are coplanar or e is one of them");
  return -1;
}

}  // namespace predicates
