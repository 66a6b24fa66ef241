#include "tests/support/point_sets.h"

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace tests {
namespace {

template <int kDim>
using Point = Eigen::Matrix<double, kDim, 1>;

/// Draws points of one family; coordinates are drawn in order, so that a seed
/// means the same points under every compiler.
template <int kDim>
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : rng_(seed) {}

  Point<kDim> point(Family family) {
    switch (family) {
      case Family::Uniform:
        return cube();
      case Family::Clustered:
        return clustered();
      case Family::Grid:
        return integers(0, 4);
      case Family::Cospherical:
        return cospherical();
      case Family::Rounded:
        return sphere();
      case Family::Collinear:
        return integer(-1000, 1000) * skew();
      case Family::AxisCollinear:
        return real(-1, 1) * Point<kDim>::Unit(0);
      case Family::Coplanar:
        return coplanar();
      case Family::UlpGrid:
        return ulp_grid();
      case Family::Huge:
        return huge();
      case Family::Tiny:
        return 1e-150 * cube();
      case Family::Subnormal:
        return std::ldexp(1, -1074) * integers(-9, 9);
      case Family::MixedExponents:
        return mixed_exponents();
      case Family::Duplicates:
        return signed_zero(integers(0, 1));
      case Family::NearlyFlat:
        return nearly_flat();
    }
    return {};
  }

 private:
  // Not std::uniform_*_distribution: those differ between libraries.
  double real(double low, double high) {
    const double unit = std::ldexp(static_cast<double>(rng_() >> 11U), -53);
    return low + unit * (high - low);
  }
  double integer(int low, int high) {
    const auto range = static_cast<std::uint64_t>(high - low + 1);
    return low + static_cast<double>(rng_() % range);
  }
  Point<kDim> each(auto&& draw) {
    Point<kDim> p;
    for (double& x : p) x = draw();
    return p;
  }

  Point<kDim> cube() {
    return each([&] { return real(0, 1); });
  }
  Point<kDim> integers(int low, int high) {
    return each([&] { return integer(low, high); });
  }
  Point<kDim> skew() {
    return Point<kDim>::LinSpaced(1, kDim);  // (1, 2) or (1, 2, 3)
  }
  Point<kDim> clustered() {
    const double center = integer(0, 6);
    const double radius = std::pow(10.0, -integer(0, 9));
    return Point<kDim>::Constant(std::sin(center)) + radius * cube();
  }

  // 65^2 is a sum of two squares in five ways: 36 points on a circle, and in
  // space on each of three great circles.
  Point<kDim> cospherical() {
    static constexpr double kLegs[][2] = {
        {0, 65},  {16, 63}, {25, 60}, {33, 56}, {39, 52},
        {63, 16}, {60, 25}, {56, 33}, {52, 39}, {65, 0}};
    const auto& legs = kLegs[static_cast<std::size_t>(integer(0, 9))];
    Point<kDim> p = Point<kDim>::Zero();
    p[0] = legs[0];
    p[1] = legs[1];
    const auto turn = static_cast<int>(integer(0, kDim - 1));
    std::swap(p[kDim - 1], p[turn]);
    for (double& x : p) x = integer(0, 1) == 0 ? x : -x;
    return p;
  }
  Point<kDim> sphere() {
    Point<kDim> p;
    do {
      p = each([&] { return real(-1, 1); });
    } while (p.squaredNorm() > 1 || p.squaredNorm() < 0.01);
    return p.normalized();
  }
  // x + y (+ z) = 7 on integers: a line in the plane, a plane in space.
  Point<kDim> coplanar() {
    Point<kDim> p = integers(-20, 20);
    p[kDim - 1] = 7 - p.template head<kDim - 1>().sum();
    return p;
  }
  Point<kDim> ulp_grid() {
    const double ulp = std::numeric_limits<double>::epsilon() / 2;
    return Point<kDim>::Constant(0.5) + ulp * integers(0, 15);
  }
  Point<kDim> huge() {
    const double magnitude = std::pow(10.0, real(150, 300));
    return magnitude * cube();
  }
  Point<kDim> mixed_exponents() {
    return each([&] {
      const double magnitude = std::pow(10.0, real(-300, 300));
      return integer(0, 1) == 0 ? magnitude : -magnitude;
    });
  }
  Point<kDim> signed_zero(Point<kDim> p) {
    for (double& x : p)
      if (x == 0 && integer(0, 1) == 0) x = -0.0;
    return p;
  }
  Point<kDim> nearly_flat() {
    Point<kDim> p = cube();
    p[kDim - 1] = p.template head<kDim - 1>().sum() / 3;
    if (integer(0, 2) == 0)
      p[kDim - 1] = std::nextafter(p[kDim - 1], integer(0, 1) * 9);
    return p;
  }

  std::mt19937_64 rng_;
};

}  // namespace

std::string_view name(Family family) {
  switch (family) {
    case Family::Uniform:
      return "uniform";
    case Family::Clustered:
      return "clustered";
    case Family::Grid:
      return "grid";
    case Family::Cospherical:
      return "cospherical";
    case Family::Rounded:
      return "rounded to a sphere";
    case Family::Collinear:
      return "collinear";
    case Family::AxisCollinear:
      return "collinear along an axis";
    case Family::Coplanar:
      return "coplanar";
    case Family::UlpGrid:
      return "one-ulp grid";
    case Family::Huge:
      return "huge";
    case Family::Tiny:
      return "tiny";
    case Family::Subnormal:
      return "subnormal";
    case Family::MixedExponents:
      return "mixed exponents";
    case Family::Duplicates:
      return "duplicates";
    case Family::NearlyFlat:
      return "nearly flat";
  }
  return {};
}

template <int kDim>
Points<kDim> make_points(Family family, std::size_t n, std::uint64_t seed) {
  Generator<kDim> generator(seed);
  Points<kDim> points(n);
  for (auto& p : points) p = generator.point(family);
  return points;
}

template Points<2> make_points(Family, std::size_t, std::uint64_t);
template Points<3> make_points(Family, std::size_t, std::uint64_t);

}  // namespace tests
