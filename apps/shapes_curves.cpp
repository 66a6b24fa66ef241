#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Eigen::Vector2d;

// Point t of the closed polygon with these corners, its edges equal in t.
template <std::size_t kCorners>
Vector2d along(const std::array<Vector2d, kCorners>& corners, double t) {
  const double at = (t - std::floor(t)) * kCorners;
  const auto i = std::min(static_cast<std::size_t>(at), kCorners - 1);
  const double s = at - static_cast<double>(i);
  return (1 - s) * corners[i] + s * corners[(i + 1) % kCorners];
}

}  // namespace

Vector2d circle(double t) {
  const Turn at = turn(t);
  return {at.cos, at.sin};
}

Vector2d ellipse(double t) {
  const Turn at = turn(t);
  return {at.cos, 0.3 * at.sin};
}

Vector2d fourier(double t) {
  const Turn at = turn(t);
  const double r = 1 + 0.25 * turn(3 * t).cos + 0.15 * turn(5 * t).sin;
  return {r * at.cos, r * at.sin};
}

Vector2d star(double t) {
  std::array<Vector2d, 10> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Turn at = turn(0.25 + 0.1 * static_cast<double>(i));
    corners[i] = (i % 2 == 0 ? 1.0 : 0.45) * Vector2d(at.cos, at.sin);
  }
  return along(corners, t);
}

Vector2d square(double t) {
  return along(std::array<Vector2d, 4>{Vector2d(0, 0), Vector2d(1, 0),
                                       Vector2d(1, 1), Vector2d(0, 1)},
               t);
}

Vector2d two_circles(double t) {
  return circle(t) + Vector2d(t < 1 ? -1.2 : 1.2, 0);
}

// Length by a fine polygon; within an n-th of it, the middle half is used, so
// that neighbours keep a distance.
std::vector<Site> scatter(const Curve& curve, std::size_t n, Random& random) {
  const std::size_t steps = 4 * n + 1000;
  const std::size_t total = steps * static_cast<std::size_t>(curve.components);
  const auto parameter = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(steps);
  };
  std::vector<double> length(total + 1, 0);
  for (std::size_t i = 0; i < total; ++i) {
    const bool last = (i + 1) % steps == 0;
    const Vector2d from = curve.point(parameter(i));
    const Vector2d to = curve.point(parameter(last ? i + 1 - steps : i + 1));
    length[i + 1] = length[i] + (to - from).norm();
  }
  std::vector<Site> sites;
  sites.reserve(n);
  const double arc = length.back() / static_cast<double>(n);
  std::size_t i = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double at =
        (static_cast<double>(k) + 0.25 + 0.5 * random.unit()) * arc;
    while (i + 1 < total && length[i + 1] <= at) ++i;
    const double part = (at - length[i]) / (length[i + 1] - length[i]);
    const Vector2d p =
        curve.point((static_cast<double>(i) + std::clamp(part, 0.0, 1.0)) /
                    static_cast<double>(steps));
    sites.push_back({{p.x(), p.y(), 0}, arc});
  }
  return sites;
}

}  // namespace shapes
