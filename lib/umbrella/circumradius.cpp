#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "umbrella/big_integer_internal.h"
#include "umbrella/circumradius_internal.h"
#include "umbrella/double_double_internal.h"

namespace umbrella {
namespace {

using delaunay::Point3;

/// The largest e for which all coordinates are whole multiples of 2^e.
template <std::size_t kPoints>
int common_exponent(const std::array<Point3, kPoints>& points) {
  int exponent = INT_MAX;
  for (const Point3& p : points)
    for (const double x : p) exponent = std::min(exponent, lowest_bit(x));
  return exponent;
}

/// Differences to the first point, as whole multiples of 2^exponent.
template <std::size_t kPoints>
struct WholeDifferences {
  std::array<Vector<BigInteger>, kPoints - 1> difference;
  int exponent;

  explicit WholeDifferences(const std::array<Point3, kPoints>& points)
      : exponent(common_exponent(points)) {
    const auto whole = [&](double x) { return BigInteger(x, exponent); };
    for (std::size_t k = 1; k < kPoints; ++k)
      for (Eigen::Index i = 0; i < 3; ++i)
        difference[k - 1][static_cast<std::size_t>(i)] =
            whole(points[k][i]) - whole(points[0][i]);
  }
};

/// The same where they are so small that every number made of them here is a
/// whole double, as on integer grids: with |d| <= 7 the largest, a product of
/// 12 differences, is below 2^48 (docs/math.md, "Small whole numbers").
template <std::size_t kPoints>
struct SmallDifferences {
  std::array<Vector<double>, kPoints - 1> difference;
  int exponent = 0;

  static std::optional<SmallDifferences> of(
      const std::array<Point3, kPoints>& points) {
    constexpr double kLargest = 7;
    SmallDifferences small;
    // A rounded difference is at least 2^53 multiples, and fails the test, as
    // does what overflows.
    small.exponent = common_exponent(points);
    const double unit = std::ldexp(1, -small.exponent);
    for (std::size_t k = 1; k < kPoints; ++k)
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double d = (points[k][i] - points[0][i]) * unit;
        if (!(std::abs(d) <= kLargest)) return std::nullopt;
        small.difference[k - 1][static_cast<std::size_t>(i)] = d;
      }
    return small;
  }
};

/// (r / R)^2 of the circle through 0, u, v and the sphere through w as well.
template <class T>
RadiusFraction<T> lambda_fraction(const Vector<T>& u, const Vector<T>& v,
                                  const Vector<T>& w) {
  const RadiusFraction<T> circle = circle_radius(u, v);
  const RadiusFraction<T> ball = sphere_radius(sphere(u, v, w));
  return {circle.numerator * ball.denominator,
          circle.denominator * ball.numerator};
}

WholeFraction whole_lambda(const std::array<Point3, 4>& abcd) {
  const WholeDifferences<4> d(abcd);
  const auto& [u, v, w] = d.difference;
  RadiusFraction<BigInteger> lambda = lambda_fraction(u, v, w);
  return {std::move(lambda.numerator), std::move(lambda.denominator)};
}

ExactRatio ratio(const RadiusFraction<double>& whole, int exponent) {
  return {static_cast<std::int64_t>(whole.numerator),
          static_cast<std::int64_t>(whole.denominator), exponent};
}

double squared_radius(const RadiusFraction<BigInteger>& fraction, int exponent,
                      double scale) {
  constexpr int kQuarter = -2;  // the fraction is of 4 r^2
  return nearest_quotient(fraction.numerator, fraction.denominator,
                          2 * (exponent + std::ilogb(scale)) + kQuarter);
}

/// Error of radii in DoubleDouble, as a part, for the flattest fat ones; it
/// grows with the flatness.
constexpr double kPairError = 0x1p-94;

/// Up to here pairs still give 2^-36.
constexpr double kFlattestPair = 0x1p58;

using Pair = DoubleDouble;

/// A squared radius in pairs of doubles, and how flat its simplex is.
struct PairRadius {
  Pair value;
  double flatness;  // infinite where underflow could spoil the value
};

std::array<Pair, 3> pair_difference(const Point3& p, const Point3& q,
                                    double scale) {
  return {Pair::difference(scale * p[0], scale * q[0]),
          Pair::difference(scale * p[1], scale * q[1]),
          Pair::difference(scale * p[2], scale * q[2])};
}

PairRadius pair_radius(const RadiusFraction<Pair>& fraction,
                       std::initializer_list<Pair> squared_lengths) {
  double product = 1, least = 1;
  for (const Pair& l : squared_lengths) {
    product *= l.hi;
    least = std::min(least, l.hi);
  }
  const double flat2 = product / fraction.denominator.hi;
  return {fraction.numerator / fraction.denominator,
          least >= kTiny && flat2 > 0
              ? std::sqrt(flat2)
              : std::numeric_limits<double>::infinity()};
}

PairRadius pair_radius(const std::array<Point3, 3>& abc, double scale) {
  const auto u = pair_difference(abc[1], abc[0], scale);
  const auto v = pair_difference(abc[2], abc[0], scale);
  return pair_radius(circle_radius(u, v), {dot(u, u), dot(v, v)});
}

PairRadius pair_radius(const std::array<Point3, 4>& abcd, double scale) {
  const auto u = pair_difference(abcd[1], abcd[0], scale);
  const auto v = pair_difference(abcd[2], abcd[0], scale);
  const auto w = pair_difference(abcd[3], abcd[0], scale);
  return pair_radius(sphere_radius(sphere(u, v, w)),
                     {dot(u, u), dot(v, v), dot(w, w)});
}

struct PairLambda {
  Pair value;
  double error;  // infinite where underflow could spoil the value
};

PairLambda pair_lambda(const std::array<Point3, 4>& abcd) {
  const double scale = power_of_two_scale(abcd);
  const PairRadius r =
      pair_radius(std::array{abcd[0], abcd[1], abcd[2]}, scale);
  const PairRadius R = pair_radius(abcd, scale);
  const Pair quotient = r.value / R.value;
  return {quotient, kPairError * (r.flatness + R.flatness) * quotient.hi};
}

/// Of 4 r^2 for the circle through the first three points.
Enclosure circle_enclosure(const std::array<Point3, 4>& abcd) {
  const std::array abc = {abcd[0], abcd[1], abcd[2]};
  const double scale = power_of_two_scale(abc);
  const PairRadius r = pair_radius(abc, scale);
  const int shift = -2 * std::ilogb(scale);
  const double hi = std::ldexp(r.value.hi, shift);
  // Where bits may have been lost nothing is known.
  constexpr double kLeast = 0x1p-800, kMost = 0x1p+1000;
  if (!(r.value.hi >= kLeast && hi >= kLeast && hi <= kMost))
    return {0, 0, std::numeric_limits<double>::infinity()};
  return {hi, std::ldexp(r.value.lo, shift), kPairError * r.flatness * hi};
}

std::optional<double> quarter_rounded(const PairRadius& r) {
  const auto rounded = r.value.rounded(kPairError * r.flatness * r.value.hi);
  return rounded ? std::optional(*rounded / 4) : std::nullopt;
}

/// Where doubles alone do not give 2^-35.
template <std::size_t kPoints>
double refined(const std::array<Point3, kPoints>& corners, double scale) {
  const PairRadius r = pair_radius(corners, scale);
  return r.flatness <= kFlattestPair
             ? r.value.hi / 4
             : exact_squared_circumradius(corners, scale);
}

}  // namespace

double power_of_two_scale(std::span<const Point3> points) {
  Point3 extent = Point3::Zero();
  for (const Point3& p : points) extent = extent.cwiseMax(p.cwiseAbs());
  const double largest = extent.maxCoeff();
  if (largest == 0) return 1;
  return std::ldexp(1, std::clamp(-std::ilogb(largest), -1022, 1022));
}

double squared_circumradius(const Point3& a, const Point3& b, const Point3& c,
                            double scale) {
  const auto u = scaled_difference(b, a, scale);
  const auto v = scaled_difference(c, a, scale);
  const auto r = circle_radius(u, v);
  const double uu = dot(u, u), vv = dot(v, v);
  const bool fat =
      std::min(uu, vv) >= kTiny && r.denominator >= kFat * (uu * vv);
  return fat ? r.numerator / (4 * r.denominator)
             : refined(std::array{a, b, c}, scale);
}

double squared_circumradius(const std::array<Point3, 4>& abcd, double scale) {
  const auto u = scaled_difference(abcd[1], abcd[0], scale);
  const auto v = scaled_difference(abcd[2], abcd[0], scale);
  const auto w = scaled_difference(abcd[3], abcd[0], scale);
  const auto r = sphere_radius(sphere(u, v, w));
  const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const bool fat =
      std::min({uu, vv, ww}) >= kTiny && r.denominator >= kFat * (uu * vv * ww);
  return fat ? r.numerator / (4 * r.denominator) : refined(abcd, scale);
}

double exact_squared_circumradius(const std::array<Point3, 3>& abc,
                                  double scale) {
  if (const auto small = SmallDifferences<3>::of(abc)) {
    const auto& [u, v] = small->difference;
    const RadiusFraction<double> r = circle_radius(u, v);
    return std::ldexp(r.numerator / (4 * r.denominator),
                      2 * (small->exponent + std::ilogb(scale)));
  }
  if (const auto r2 = quarter_rounded(pair_radius(abc, scale))) return *r2;
  const WholeDifferences<3> d(abc);
  return squared_radius(circle_radius(d.difference[0], d.difference[1]),
                        d.exponent, scale);
}

double exact_squared_circumradius(const std::array<Point3, 4>& abcd,
                                  double scale) {
  if (const auto r2 = quarter_rounded(pair_radius(abcd, scale))) return *r2;
  const WholeDifferences<4> d(abcd);
  const auto s = sphere(d.difference[0], d.difference[1], d.difference[2]);
  return squared_radius(sphere_radius(s), d.exponent, scale);
}

double exact_squared_lambda(const std::array<Point3, 4>& abcd) {
  if (const auto small = SmallDifferences<4>::of(abcd)) {
    const auto& [u, v, w] = small->difference;
    const RadiusFraction<double> lambda = lambda_fraction(u, v, w);
    return lambda.numerator / lambda.denominator;
  }
  const auto [quotient, error] = pair_lambda(abcd);
  if (const auto lambda = quotient.rounded(error)) return *lambda;
  const WholeFraction lambda = whole_lambda(abcd);
  return nearest_quotient(lambda.numerator, lambda.denominator, 0);
}

ExactRatio squared_lambda_ratio(const std::array<Point3, 4>& abcd) {
  if (const auto small = SmallDifferences<4>::of(abcd)) {
    const auto& [u, v, w] = small->difference;
    return ratio(lambda_fraction(u, v, w), 0);
  }
  return {Origin{abcd, false}, 0};
}

ExactRatio squared_circumradius_ratio(const std::array<Point3, 4>& abcd) {
  const std::array abc = {abcd[0], abcd[1], abcd[2]};
  if (const auto small = SmallDifferences<3>::of(abc)) {
    const auto& [u, v] = small->difference;
    return ratio(circle_radius(u, v), 2 * small->exponent);
  }
  return {Origin{abcd, true}, 2 * common_exponent(abc)};
}

Enclosure enclosure(const Origin& origin) {
  if (origin.circle_only) return circle_enclosure(origin.points);
  const auto [quotient, error] = pair_lambda(origin.points);
  // Nothing is known where 0 was divided by 0.
  if (!(quotient.hi >= 0))
    return {0, 0, std::numeric_limits<double>::infinity()};
  return {quotient.hi, quotient.lo, error};
}

WholeFraction whole_fraction(const Origin& origin) {
  const auto& [a, b, c, d] = origin.points;
  if (!origin.circle_only) return whole_lambda(origin.points);
  const WholeDifferences<3> differences({a, b, c});
  const auto& [u, v] = differences.difference;
  RadiusFraction<BigInteger> r = circle_radius(u, v);
  return {std::move(r.numerator), std::move(r.denominator)};
}

}  // namespace umbrella
