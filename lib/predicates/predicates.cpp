#include "predicates/predicates.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "predicates/exact_internal.h"
#include "predicates/small_integer_internal.h"

namespace predicates {
namespace {

using internal::Incircle;
using internal::Insphere;
using internal::LatticePoints;
using internal::Orient2d;
using internal::Orient3d;
using internal::Points;

/// Sign of a vanishing in-circle or in-sphere determinant once every lifted
/// point is raised, the lexicographically larger the more, by orders of
/// magnitude. Raising corner i by h adds h times the orientation of the simplex
/// with the query in place of i; raising the query takes away h times the
/// orientation of the simplex, which is positive. So the largest point with a
/// non-zero factor decides.
template <class Predicate, class P, class Orient>
int raised_sign(const P& p, const Orient& orient) {
  constexpr std::size_t kQuery = Predicate::kPoints - 1;
  std::array<bool, Predicate::kPoints> done{};
  while (true) {
    std::size_t largest = kQuery;
    for (std::size_t i = 0; i < kQuery; ++i) {
      if (!done[i] && std::lexicographical_compare(
                          p[largest], p[largest] + Predicate::kDimension, p[i],
                          p[i] + Predicate::kDimension))
        largest = i;
    }
    if (largest == kQuery) return -1;
    P replaced = p;
    replaced[largest] = p[kQuery];
    const int decided = orient(replaced);
    if (decided != 0) return decided;
    done[largest] = true;
  }
}

/// The tie-break needs no coordinates but the lattice's, if there is one.
template <class Predicate, class Orient>
int perturbed_sign(const Points<Predicate::kPoints>& p) {
  static_assert(Predicate::kInt128Bits < Orient::kInt128Bits);
  LatticePoints<Predicate> lattice;
  if (lattice.assign(p) && lattice.bits <= Predicate::kInt128Bits) {
    const auto n = lattice.points();
    const int exact = internal::small_integer_sign<Predicate>(n, lattice.bits);
    if (exact != 0) return exact;
    return raised_sign<Predicate>(n, [&lattice](const auto& q) {
      return internal::small_integer_sign<Orient>(q, lattice.bits + 1);
    });
  }
  const int exact = internal::wide_integer_sign<Predicate>(p);
  if (exact != 0) return exact;
  return raised_sign<Predicate>(p, [](const auto& q) {
    if constexpr (Predicate::kDimension == 2)
      return orient2d(q[0], q[1], q[2]);
    else
      return orient3d(q[0], q[1], q[2], q[3]);
  });
}

}  // namespace

int orient2d_exact(const double* a, const double* b, const double* c) {
  return internal::exact_sign<Orient2d>({a, b, c});
}

int orient3d_exact(const double* a, const double* b, const double* c,
                   const double* d) {
  return internal::exact_sign<Orient3d>({a, b, c, d});
}

int incircle_exact(const double* a, const double* b, const double* c,
                   const double* d) {
  return internal::exact_sign<Incircle>({a, b, c, d});
}

int insphere_exact(const double* a, const double* b, const double* c,
                   const double* d, const double* e) {
  return internal::exact_sign<Insphere>({a, b, c, d, e});
}

int incircle_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d) {
  return perturbed_sign<Incircle, Orient2d>({a, b, c, d});
}

int insphere_perturbed_exact(const double* a, const double* b, const double* c,
                             const double* d, const double* e) {
  return perturbed_sign<Insphere, Orient3d>({a, b, c, d, e});
}

}  // namespace predicates
