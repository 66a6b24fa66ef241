/// @file
/// Unevaluated sums of two doubles, some 106 bits [Dekker71; Joldes17].
#pragma once

#include <cmath>
#include <optional>

namespace umbrella {

/// hi + lo with |lo| at most half an ulp of hi. Each operation is off by less
/// than a 2^-103 part, unless something over- or underflows.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  /// a - b without error.
  static DoubleDouble difference(double a, double b) {
    const double d = a - b, back = d - a;
    return {d, (a - (d - back)) - (b + back)};
  }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = difference(a.hi, -b.hi);
    const DoubleDouble low = difference(a.lo, -b.lo);
    const DoubleDouble sum = normal(high.hi, high.lo + low.hi);
    return normal(sum.hi, sum.lo + low.lo);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + DoubleDouble{-b.hi, -b.lo};
  }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.hi, b.hi);
    return normal(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.hi / b.hi;
    const DoubleDouble rest = a - b * DoubleDouble{first, 0};
    return normal(first, (rest.hi + rest.lo) / b.hi);
  }

  /// The double nearest to every number off this one by at most `error`; none
  /// if they do not agree, or something is not finite.
  std::optional<double> rounded(double error) const {
    if (hi + (lo - error) != hi || hi + (lo + error) != hi) return std::nullopt;
    return hi;
  }

 private:
  /// a + b for |a| >= |b|.
  static DoubleDouble normal(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  /// a b without error, by halves of 26 bits.
  static DoubleDouble product(double a, double b) {
    constexpr double kSplit = 0x1p27 + 1;
    const double ta = kSplit * a, tb = kSplit * b;
    const double a1 = ta - (ta - a), b1 = tb - (tb - b);
    const double a2 = a - a1, b2 = b - b1;
    const double p = a * b;
    return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
  }
};

}  // namespace umbrella
