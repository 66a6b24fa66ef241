#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>
#include <span>

#include "umbrella/big_integer_internal.h"
#include "umbrella/circumradius_internal.h"

namespace umbrella {
namespace {

using delaunay::Point3;

/// Differences to the first point, as whole multiples of 2^exponent.
template <std::size_t kPoints>
struct WholeDifferences {
  std::array<Vector<BigInteger>, kPoints - 1> difference;
  int exponent = 0;

  explicit WholeDifferences(const std::array<Point3, kPoints>& points) {
    exponent = INT_MAX;
    for (const Point3& p : points)
      for (const double x : p) exponent = std::min(exponent, lowest_bit(x));
    const auto whole = [&](double x) { return BigInteger(x, exponent); };
    for (std::size_t k = 1; k < kPoints; ++k)
      for (Eigen::Index i = 0; i < 3; ++i)
        difference[k - 1][static_cast<std::size_t>(i)] =
            whole(points[k][i]) - whole(points[0][i]);
  }
};

double squared_radius(const RadiusFraction<BigInteger>& fraction, int exponent,
                      double scale) {
  constexpr int kQuarter = -2;  // the fraction is of 4 r^2
  return nearest_quotient(fraction.numerator, fraction.denominator,
                          2 * (exponent + std::ilogb(scale)) + kQuarter);
}

}  // namespace

double exact_squared_circumradius(const std::array<Point3, 3>& abc,
                                  double scale) {
  const WholeDifferences<3> d(abc);
  return squared_radius(circle_radius(d.difference[0], d.difference[1]),
                        d.exponent, scale);
}

double exact_squared_circumradius(const std::array<Point3, 4>& abcd,
                                  double scale) {
  const WholeDifferences<4> d(abcd);
  const auto s = sphere(d.difference[0], d.difference[1], d.difference[2]);
  return squared_radius(sphere_radius(s), d.exponent, scale);
}

double exact_squared_lambda(const std::array<Point3, 4>& abcd) {
  const WholeDifferences<4> d(abcd);
  const auto& [u, v, w] = d.difference;
  const auto circle = circle_radius(u, v);
  const auto ball = sphere_radius(sphere(u, v, w));
  return nearest_quotient(circle.numerator * ball.denominator,
                          circle.denominator * ball.numerator, 0);
}

}  // namespace umbrella
