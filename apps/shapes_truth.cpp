#include "apps/shapes_truth.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Eigen::Vector3d;

double to_sphere(const Vector3d& p) { return std::abs(p.norm() - 1); }

double to_two_spheres(const Vector3d& p) {
  const Vector3d half(1.05, 0, 0);
  return std::min(to_sphere(p - half), to_sphere(p + half));
}

double to_torus(const Vector3d& p) {
  return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - 0.4);
}

/// A box with one corner at 0.
double to_box(const Vector3d& size, const Vector3d& p) {
  const Vector3d beyond = (p - size / 2).cwiseAbs() - size / 2;
  const double inside = beyond.maxCoeff();  // < 0: the nearest face
  return inside < 0 ? -inside : beyond.cwiseMax(0).norm();
}

// The nearest point is p_i a_i^2 / (a_i^2 + t) for the root t > -min a_i^2 of
// sum (a_i p_i / (a_i^2 + t))^2 = 1; the left side falls.
double to_ellipsoid(const Vector3d& p) {
  const Vector3d a2 = Vector3d(1, 0.6, 0.3).cwiseAbs2();
  const auto nearest = [&](double t) -> Vector3d {
    return p.cwiseProduct(a2).cwiseQuotient((a2.array() + t).matrix());
  };
  double low = -a2.minCoeff() * (1 - 1e-12), high = p.norm() + 1;
  for (int step = 0; step < 100; ++step) {
    const double t = (low + high) / 2;
    const double level = nearest(t).cwiseAbs2().cwiseQuotient(a2).sum();
    (level > 1 ? low : high) = t;
  }
  return (p - nearest(high)).norm();
}

Vector3d knot_center(double t) {
  const Turn two = turn(2 * t), three = turn(3 * t);
  const double p = 1 + 0.5 * three.cos;
  return {p * two.cos, p * two.sin, 0.5 * three.sin};
}

constexpr int kKnotPlaces = 512;

std::vector<Vector3d> knot_places() {
  std::vector<Vector3d> places;
  places.reserve(kKnotPlaces);
  for (int i = 0; i < kKnotPlaces; ++i)
    places.push_back(knot_center(static_cast<double>(i) / kKnotPlaces));
  return places;
}

/// A tube: the distance to its middle curve, from the nearest of many places on
/// by golden sections.
double to_knot(const Vector3d& p) {
  static const std::vector<Vector3d> places = knot_places();
  const auto d2 = [&](double t) { return (p - knot_center(t)).squaredNorm(); };
  const auto nearest = std::min_element(
      places.begin(), places.end(), [&](const Vector3d& a, const Vector3d& b) {
        return (p - a).squaredNorm() < (p - b).squaredNorm();
      });
  constexpr double kStep = 1.0 / kKnotPlaces;
  constexpr double kGolden = 0.6180339887498949;
  const double middle = kStep * static_cast<double>(nearest - places.begin());
  double low = middle - kStep, high = middle + kStep;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = d2(a), at_b = d2(b);
  for (int step = 0; step < 20; ++step) {
    if (at_a < at_b) {
      high = std::exchange(b, a);
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = d2(a);
    } else {
      low = std::exchange(a, b);
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = d2(b);
    }
  }
  return std::abs(std::sqrt(std::min(at_a, at_b)) - 0.2);
}

/// |f| / |grad f|.
template <class Function>
double first_order(Function f, const Vector3d& p) {
  constexpr double kStep = 1e-6;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    gradient[axis] = (f(p + step) - f(p - step)) / (2 * kStep);
  }
  return std::abs(f(p)) / gradient.norm();
}

double to_bumpy(const Vector3d& p) {
  return first_order(
      [](const Vector3d& q) { return q.norm() - bumpy_radius(q.normalized()); },
      p);
}

double to_three_holes(const Vector3d& p) {
  return first_order([](const Vector3d& q) { return three_holes_level(q) - 1; },
                     p);
}

}  // namespace

std::optional<Truth> truth(std::string_view name) {
  if (name == "sphere") return Truth{0, 1, to_sphere};
  if (name == "two-spheres") return Truth{0, 2, to_two_spheres};
  if (name == "torus") return Truth{1, 1, to_torus};
  if (name == "ellipsoid") return Truth{0, 1, to_ellipsoid};
  if (name == "knot") return Truth{1, 1, to_knot};
  if (name == "bumpy") return Truth{0, 1, to_bumpy, false};
  if (name == "3holes") return Truth{3, 1, to_three_holes, false};
  if (name == "cube")
    return Truth{
        0, 1, [](const Vector3d& p) { return to_box(Vector3d(1, 1, 1), p); }};
  if (name == "plate")
    return Truth{0, 1, [](const Vector3d& p) {
                   return to_box(Vector3d(1, 1, 0.05), p);
                 }};
  sample(name, 0);  // knows all names
  return std::nullopt;
}

}  // namespace shapes
