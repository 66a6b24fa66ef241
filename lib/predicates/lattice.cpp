#include "predicates/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "predicates/filter_internal.h"
#include "predicates/predicates.h"

namespace predicates {
namespace {

using internal::certain_sign;
using internal::Insphere;
using internal::Orient3d;
using internal::Points;
using internal::vector3;
using Offset = internal::Vector3<double>;

constexpr auto kMinus = [](double a, double b) { return a - b; };

double largest_coordinate(const Offset& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

bool lexicographically_less(const double* p, const double* q) {
  // No branch: they would be guessed wrong.
  const bool less_z = p[2] < q[2];
  const bool less_y = (p[1] < q[1]) | ((p[1] == q[1]) & less_z);
  return (p[0] < q[0]) | ((p[0] == q[0]) & less_y);
}

/// Of the points whose raise has weight in a vanishing determinant, the
/// largest decides; the query outside. The weights are the minors.
int raised_sign(const Points<5>& p, const std::array<double, 4>& minor) {
  const double* largest = p[4];
  double decisive = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    const double weight = i % 2 == 0 ? minor[i] : -minor[i];
    const bool wins = (weight != 0) & lexicographically_less(largest, p[i]);
    largest = wins ? p[i] : largest;
    decisive = wins ? weight : decisive;
  }
  return certain_sign(decisive, 0);
}

}  // namespace

int Lattice::orient3d(const double* a, const double* b, const double* c,
                      const double* d) const {
  constexpr double kReach = 0x1p16;
  double reach = 0;
  for (const double* q : {b, c, d})
    reach = std::max(reach, largest_coordinate(vector3(kMinus, q, a)));
  if (reach > kReach * unit_) return predicates::orient3d(a, b, c, d);
  return certain_sign(Orient3d::evaluate(kMinus, Points<4>{a, b, c, d}), 0);
}

int Lattice::insphere_perturbed(const double* a, const double* b,
                                const double* c, const double* d,
                                const double* e) const {
  constexpr double kReach = 0x1p9;
  const std::array q = {vector3(kMinus, a, e), vector3(kMinus, b, e),
                        vector3(kMinus, c, e), vector3(kMinus, d, e)};
  double reach = 0;
  for (const Offset& v : q) reach = std::max(reach, largest_coordinate(v));
  if (reach > kReach * unit_)
    return predicates::insphere_perturbed(a, b, c, d, e);
  const auto minor = Insphere::minors(q);
  const double det = Insphere::evaluate(q, minor);
  return det != 0 ? certain_sign(det, 0) : raised_sign({a, b, c, d, e}, minor);
}

}  // namespace predicates
