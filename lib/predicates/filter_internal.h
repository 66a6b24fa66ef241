/// @file
/// First stage: the polynomial in doubles, with a bound on its error.
///
/// A filter returns the sign, or 0 when rounding could have changed it; it
/// never returns a wrong sign, whatever overflows or underflows.
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#include "predicates/polynomial_internal.h"

namespace predicates::internal {

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0,
              "the bounds below assume plain IEEE double arithmetic");

/// A rounded value and the same expression with every term made positive: the
/// `permanent` of [Shewchuk97], which bounds the rounding error.
struct Rounded {
  double value;
  double magnitude;

  friend constexpr Rounded operator+(Rounded a, Rounded b) {
    return {a.value + b.value, a.magnitude + b.magnitude};
  }
  friend constexpr Rounded operator-(Rounded a, Rounded b) {
    return {a.value - b.value, a.magnitude + b.magnitude};
  }
  friend constexpr Rounded operator*(Rounded a, Rounded b) {
    return {a.value * b.value, a.magnitude * b.magnitude};
  }
};

inline constexpr auto kRoundedMinus = [](double a, double b) {
  return Rounded{a - b, std::abs(a - b)};
};

inline double squared_distance2(const double* a, const double* b) {
  const auto u = vector2(kRoundedMinus, a, b);
  return dot(u, u).value;
}

inline double squared_distance3(const double* a, const double* b) {
  const auto u = vector3(kRoundedMinus, a, b);
  return dot(u, u).value;
}

/// Sign of a value that is off by at most `bound`; 0 if that leaves it open.
/// Infinite or NaN bounds and NaN values leave it open.
constexpr int certain_sign(double value, double bound) {
  if (value > bound) return 1;
  if (-value > bound) return -1;
  return 0;
}

/// Unit roundoff.
inline constexpr double kRoundoff = 0x1p-53;

/// Far above what underflow adds to a product, and normal, since arithmetic
/// with subnormals is slow.
inline constexpr double kTiny = 0x1p-1000;

inline int orient2d_filter(const double* a, const double* b, const double* c) {
  const Rounded det = Orient2d::evaluate(kRoundedMinus, Points<3>{a, b, c});
  return certain_sign(det.value, 5 * kRoundoff * det.magnitude + kTiny);
}

inline int orient3d_filter(const double* a, const double* b, const double* c,
                           const double* d) {
  const Rounded det = Orient3d::evaluate(kRoundedMinus, Points<4>{a, b, c, d});
  const double size = 1 + (std::abs(b[2] - a[2]) + std::abs(c[2] - a[2]) +
                           std::abs(d[2] - a[2]));
  return certain_sign(det.value, 9 * kRoundoff * det.magnitude + kTiny * size);
}

inline int incircle_filter(const double* a, const double* b, const double* c,
                           const double* d) {
  const Rounded det = Incircle::evaluate(kRoundedMinus, Points<4>{a, b, c, d});
  const double size = 1 + (squared_distance2(a, d) + squared_distance2(b, d) +
                           squared_distance2(c, d));
  return certain_sign(det.value, 12 * kRoundoff * det.magnitude + kTiny * size);
}

inline int insphere_filter(const double* a, const double* b, const double* c,
                           const double* d, const double* e) {
  const Rounded det =
      Insphere::evaluate(kRoundedMinus, Points<5>{a, b, c, d, e});
  const double size = 1 + ((squared_distance3(a, e) + squared_distance3(b, e)) +
                           (squared_distance3(c, e) + squared_distance3(d, e)));
  return certain_sign(det.value,
                      17 * kRoundoff * det.magnitude + kTiny * (size * size));
}

inline int gabriel_edge_filter(const double* a, const double* b,
                               const double* p) {
  const Rounded g = GabrielEdge::evaluate(kRoundedMinus, Points<3>{a, b, p});
  return certain_sign(g.value, 5 * kRoundoff * g.magnitude + kTiny);
}

inline int gabriel_triangle_filter(const double* a, const double* b,
                                   const double* c, const double* p) {
  const Rounded g =
      GabrielTriangle::evaluate(kRoundedMinus, Points<4>{a, b, c, p});
  const double size = 1 + (squared_distance3(a, c) + squared_distance3(b, c) +
                           squared_distance3(p, c));
  return certain_sign(g.value,
                      20 * kRoundoff * g.magnitude + kTiny * (size * size));
}

}  // namespace predicates::internal
