#include "predicates/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "predicates/filter_internal.h"
#include "predicates/predicates.h"
#include "predicates/wide_integer_internal.h"

namespace predicates {
namespace {

using internal::certain_sign;
using internal::Orient3d;
using internal::Points;
using internal::vector3;
using Offset = internal::Vector3<double>;

constexpr auto kMinus = [](double a, double b) { return a - b; };

double largest_coordinate(const Offset& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// Two numbers in a vector register of a size that every 64-bit processor has.
using Lanes [[gnu::vector_size(16)]] = double;

/// A number for each corner a, b, c, d of a cell.
struct Quad {
  Lanes ab, cd;

  friend Quad operator+(const Quad& p, const Quad& q) {
    return {p.ab + q.ab, p.cd + q.cd};
  }
  friend Quad operator-(const Quad& p, const Quad& q) {
    return {p.ab - q.ab, p.cd - q.cd};
  }
  friend Quad operator*(const Quad& p, const Quad& q) {
    return {p.ab * q.ab, p.cd * q.cd};
  }
  friend Quad operator*(double s, const Quad& q) {
    return {s * q.ab, s * q.cd};
  }
};

/// To each corner what the next has, in the circle a b c d.
Quad next(const Quad& q) {
  return {__builtin_shufflevector(q.ab, q.cd, 1, 2),
          __builtin_shufflevector(q.cd, q.ab, 1, 2)};
}
Quad opposite(const Quad& q) { return {q.cd, q.ab}; }

double sum(const Quad& q) {
  const Lanes s = q.ab + q.cd;
  return s[0] + s[1];
}

constexpr Lanes kZero = {};

Lanes max(const Lanes& p, const Lanes& q) { return p > q ? p : q; }

/// 0 if none is positive.
double largest(const Quad& q) {
  const Lanes m = max(max(q.ab, q.cd), kZero);
  return std::max(m[0], m[1]);
}

Quad where_positive(const Quad& condition, const Quad& q) {
  return {condition.ab > kZero ? q.ab : kZero,
          condition.cd > kZero ? q.cd : kZero};
}

Quad where_negative(const Quad& condition, const Quad& q) {
  return {condition.ab < kZero ? q.ab : kZero,
          condition.cd < kZero ? q.cd : kZero};
}

/// Integers for four corners.
struct Integers {
  std::array<std::int64_t, 4> at;

  /// @param q  multiples of `unit`
  Integers(const Quad& q, double unit)
      : at{static_cast<std::int64_t>(q.ab[0] / unit),
           static_cast<std::int64_t>(q.ab[1] / unit),
           static_cast<std::int64_t>(q.cd[0] / unit),
           static_cast<std::int64_t>(q.cd[1] / unit)} {}
};

/// As Lattice::insphere_perturbed, for corners up to 2^19 units from e.
int insphere_of_integers(const Integers& x, const Integers& y,
                         const Integers& z) {
  const auto side = [&](std::size_t p, std::size_t q) {
    return x.at[p] * y.at[q] - y.at[p] * x.at[q];
  };
  using internal::Int128;
  constexpr std::int64_t kPlaceX = std::int64_t{1} << 42U;
  constexpr std::int64_t kPlaceY = std::int64_t{1} << 21U;
  Int128 det = 0;
  std::int64_t raises = 0;
  std::int64_t lowers = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t p = (i + 1) % 4, q = (i + 2) % 4, r = (i + 3) % 4;
    const std::int64_t minor =
        side(p, q) * z.at[r] - side(p, r) * z.at[q] + side(q, r) * z.at[p];
    const std::int64_t weight = i % 2 == 0 ? minor : -minor;
    const std::int64_t norm2 =
        x.at[i] * x.at[i] + y.at[i] * y.at[i] + z.at[i] * z.at[i];
    det += Int128{weight} * norm2;
    const std::int64_t place = kPlaceX * x.at[i] + kPlaceY * y.at[i] + z.at[i];
    raises = std::max(raises, weight > 0 ? place : 0);
    lowers = std::max(lowers, weight < 0 ? place : 0);
  }
  if (det != 0) return det > 0 ? 1 : -1;
  return raises > lowers ? 1 : -1;
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

// The determinant of internal::Insphere, expanded by the corners' squared
// distances from e: their cofactors are the weights of the corners' raises.
// Of the corners with a weight, and e with a negative one, the
// lexicographically largest decides where the determinant vanishes.
int Lattice::insphere_perturbed(const double* a, const double* b,
                                const double* c, const double* d,
                                const double* e) const {
  constexpr double kReach = 0x1p9;
  constexpr double kFarReach = 0x1p19;
  constexpr Quad kSigns = {{1, -1}, {1, -1}};
  if (unit_ == 0) return predicates::insphere_perturbed(a, b, c, d, e);
  const Quad x = {{a[0] - e[0], b[0] - e[0]}, {c[0] - e[0], d[0] - e[0]}};
  const Quad y = {{a[1] - e[1], b[1] - e[1]}, {c[1] - e[1], d[1] - e[1]}};
  const Quad z = {{a[2] - e[2], b[2] - e[2]}, {c[2] - e[2], d[2] - e[2]}};
  const Quad norm2 = x * x + y * y + z * z;
  const double reach2 = largest(norm2) / (unit_ * unit_);
  if (reach2 > kFarReach * kFarReach)
    return predicates::insphere_perturbed(a, b, c, d, e);
  if (reach2 > kReach * kReach)
    return insphere_of_integers({x, unit_}, {y, unit_}, {z, unit_});

  // ab, bc, cd, da and ac, bd, ca, db, where pq = p.x q.y - p.y q.x.
  const Quad side = x * next(y) - y * next(x);
  const Quad diagonal = x * opposite(y) - y * opposite(x);
  const Quad weight =
      kSigns * (next(side) * next(opposite(z)) - next(diagonal) * opposite(z) +
                opposite(side) * next(z));
  const double det = sum(weight * norm2);
  if (det != 0) return certain_sign(det, 0);

  // Of two points the lexicographically larger has the larger place.
  const Quad place = 0x1p22 * x + 0x1p11 * y + z;
  const double raises = largest(where_positive(weight, place));
  const double lowers = largest(where_negative(weight, place));
  // No branch, which would be guessed wrong.
  return std::signbit(lowers - raises) * 2 - 1;
}

}  // namespace predicates
