#include "tests/support/exact_lambda.h"

#include <cmath>
#include <limits>

namespace tests {
namespace {

using Row = std::array<Rational, 3>;

Rational determinant(const Row& a, const Row& b, const Row& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) -
         a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Row difference(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  return {Rational(p[0]) - Rational(q[0]), Rational(p[1]) - Rational(q[1]),
          Rational(p[2]) - Rational(q[2])};
}

Rational squared(const Row& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

}  // namespace

Rational squared_circle_radius(const std::array<Eigen::Vector3d, 3>& abc) {
  const Rational a = squared(difference(abc[1], abc[2]));
  const Rational b = squared(difference(abc[2], abc[0]));
  const Rational c = squared(difference(abc[0], abc[1]));
  const Rational area16 = 2 * (a * b + b * c + c * a) - (a * a + b * b + c * c);
  return a * b * c / area16;
}

Rational squared_sphere_radius(const std::array<Eigen::Vector3d, 4>& abcd) {
  const Row u = difference(abcd[1], abcd[0]);
  const Row v = difference(abcd[2], abcd[0]);
  const Row w = difference(abcd[3], abcd[0]);
  const Row right = {squared(u) / 2, squared(v) / 2, squared(w) / 2};
  const Rational d = determinant(u, v, w);
  Row center;
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Row, 3> columns = {u, v, w};
    for (std::size_t k = 0; k < 3; ++k) columns[k][i] = right[k];
    center[i] = determinant(columns[0], columns[1], columns[2]) / d;
  }
  return squared(center);
}

bool is_nearest(double x, const Rational& exact) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto distance = [&](double y) {
    const Rational d = Rational(y) - exact;
    return d < 0 ? Rational(-d) : d;
  };
  return distance(x) <= distance(std::nextafter(x, kInfinity)) &&
         distance(x) <= distance(std::nextafter(x, -kInfinity));
}

}  // namespace tests
