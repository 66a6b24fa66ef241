/// @file
/// First stage: the polynomial in doubles, with a bound on its error.
///
/// A filter returns the sign, or 0 when rounding could have changed it; it
/// never returns a wrong sign, whatever overflows or underflows.
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#include "predicates/determinant_internal.h"

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

inline Rounded rounded_difference(double a, double b) {
  return {a - b, std::abs(a - b)};
}

inline Vector2<Rounded> rounded_difference2(const double* a, const double* b) {
  return {rounded_difference(a[0], b[0]), rounded_difference(a[1], b[1])};
}

inline Vector3<Rounded> rounded_difference3(const double* a, const double* b) {
  return {rounded_difference(a[0], b[0]), rounded_difference(a[1], b[1]),
          rounded_difference(a[2], b[2])};
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

inline int orient2d_filter(const double* a, const double* b, const double* c) {
  const auto det =
      orient2d_polynomial(rounded_difference2(b, a), rounded_difference2(c, a));
  return certain_sign(det.value, 5 * kRoundoff * det.magnitude + 0x1p-1000);
}

inline int orient3d_filter(const double* a, const double* b, const double* c,
                           const double* d) {
  const auto u = rounded_difference3(b, a);
  const auto v = rounded_difference3(c, a);
  const auto w = rounded_difference3(d, a);
  const auto det = orient3d_polynomial(u, v, w);
  const double size = u.z.magnitude + v.z.magnitude + w.z.magnitude;
  return certain_sign(det.value,
                      9 * kRoundoff * det.magnitude + 0x1p-1000 * (1 + size));
}

inline int incircle_filter(const double* a, const double* b, const double* c,
                           const double* d) {
  const auto u = rounded_difference2(a, d);
  const auto v = rounded_difference2(b, d);
  const auto w = rounded_difference2(c, d);
  const auto det = incircle_polynomial(u, v, w);
  const double size = dot(u, u).value + dot(v, v).value + dot(w, w).value;
  return certain_sign(det.value,
                      12 * kRoundoff * det.magnitude + 0x1p-1000 * (1 + size));
}

inline int insphere_filter(const double* a, const double* b, const double* c,
                           const double* d, const double* e) {
  const auto p = rounded_difference3(a, e);
  const auto q = rounded_difference3(b, e);
  const auto r = rounded_difference3(c, e);
  const auto s = rounded_difference3(d, e);
  const auto det = insphere_polynomial(p, q, r, s);
  const double size = 1 + ((dot(p, p).value + dot(q, q).value) +
                           (dot(r, r).value + dot(s, s).value));
  return certain_sign(
      det.value, 17 * kRoundoff * det.magnitude + 0x1p-1000 * (size * size));
}

}  // namespace predicates::internal
