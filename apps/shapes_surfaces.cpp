#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Eigen::Vector3d;

// Archimedes: (height, longitude) preserves area.
Vector3d direction(double u, double v) {
  const double z = 2 * u - 1;
  const double rho = std::sqrt(std::max(0.0, 1 - z * z));
  const Turn phi = turn(v);
  return {rho * phi.cos, rho * phi.sin, z};
}

double wave(double turns) { return turn(turns).sin; }

// The surface of a box with one corner at 0; u runs through the faces.
Site box(const Vector3d& size, double u, double v) {
  const Vector3d face(size.y() * size.z(), size.z() * size.x(),
                      size.x() * size.y());
  double at = u * 2 * face.sum();
  int axis = 0;
  while (axis < 2 && at >= 2 * face[axis]) at -= 2 * face[axis++];
  const bool far_side = at >= face[axis];
  if (far_side) at -= face[axis];
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  Vector3d p;
  p[axis] = far_side ? size[axis] : 0;
  p[next] = std::min(1.0, at / face[axis]) * size[next];
  p[last] = v * size[last];
  return {p, 1};
}

// Three rings in a row, blended: sum of (r / distance to ring i)^4 = 1. Every
// point of the surface is seen from the nearest point of the nearest ring, so
// it is reached once by shooting from all rings and keeping what is nearest.
constexpr double kRingTube = 0.42;
constexpr std::array<double, 3> kRingCenter = {-2.2, 0, 2.2};

// From a point of a ring (unit circle), at right angles to it.
struct Ray {
  Vector3d origin;
  Vector3d unit;
  Vector3d at(double t) const { return origin + t * unit; }
};

Ray ray_from_ring(int ring, double longitude, double around) {
  const Turn phi = turn(longitude);
  const Turn theta = turn(around);
  const Vector3d out(phi.cos, phi.sin, 0);
  return {Vector3d(kRingCenter[ring], 0, 0) + out,
          theta.cos * out + theta.sin * Vector3d::UnitZ()};
}

double squared_distance_to_ring(int ring, const Vector3d& p) {
  const double x = p.x() - kRingCenter[ring];
  const double off = std::sqrt(x * x + p.y() * p.y()) - 1;
  return off * off + p.z() * p.z();
}

int nearest_ring(const Vector3d& p) {
  const std::array<double, 3> d2 = {squared_distance_to_ring(0, p),
                                    squared_distance_to_ring(1, p),
                                    squared_distance_to_ring(2, p)};
  return static_cast<int>(std::min_element(d2.begin(), d2.end()) - d2.begin());
}

}  // namespace

// For one ring alone this is distance / r.
double three_holes_level(const Vector3d& p) {
  double sum = 0;
  for (int ring = 0; ring < 3; ++ring) {
    const double ratio =
        kRingTube * kRingTube / squared_distance_to_ring(ring, p);
    sum += ratio * ratio;
  }
  return 1 / std::sqrt(std::sqrt(sum));
}

// Taylor series on an eighth of a turn either way: the first term left out is
// below 2e-18.
Turn turn(double turns) {
  const double reduced = turns - std::floor(turns);
  const int quarter = static_cast<int>(std::lround(4 * reduced));
  const double x = (reduced - 0.25 * quarter) * 2 * std::numbers::pi;
  double s = 0;
  double c = 0;
  for (int k = 17; k > 1; k -= 2) {
    s = (s + 1) * (-x * x / (k * (k - 1)));
    c = (c + 1) * (-x * x / ((k - 1) * (k - 2)));
  }
  s = (s + 1) * x;
  c = c + 1;
  switch (quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

Site sphere(double u, double v) { return {direction(u, v), 1}; }

Site ellipsoid(double u, double v) {
  return {direction(u, v).cwiseProduct(Vector3d(1, 0.6, 0.3)), 1};
}

double bumpy_radius(const Vector3d& d) {
  const double height =
      wave(1.5 * d.x()) + wave(1.5 * d.y()) + wave(1.5 * d.z());
  return 1 + 0.06 * height;
}

Site bumpy(double u, double v) {
  const Vector3d d = direction(u, v);
  return {bumpy_radius(d) * d, 1};
}

Site two_spheres(double u, double v) {
  const bool second = u >= 0.5;
  const Vector3d center(second ? 1.05 : -1.05, 0, 0);
  return {center + direction(second ? 2 * u - 1 : 2 * u, v), 1};
}

Site torus(double u, double v) {
  constexpr double kTube = 0.4;
  const Turn phi = turn(u);
  const Turn theta = turn(v);
  const double rho = 1 + kTube * theta.cos;
  return {{rho * phi.cos, rho * phi.sin, kTube * theta.sin}, 1};
}

// A tube about the (2, 3) torus knot c(t) = (p cos 2t, p sin 2t, a sin 3t),
// p = R + a cos 3t. The torus normal at c is a unit vector across the knot;
// with the tangent it gives the frame of the tube.
Site knot(double u, double v) {
  constexpr double kRing = 1;
  constexpr double kCore = 0.5;
  constexpr double kTube = 0.2;
  const Turn two = turn(2 * u);
  const Turn three = turn(3 * u);
  const double p = kRing + kCore * three.cos;
  const Vector3d center(p * two.cos, p * two.sin, kCore * three.sin);
  const double dp = -3 * kCore * three.sin;
  const Vector3d tangent(dp * two.cos - 2 * p * two.sin,
                         dp * two.sin + 2 * p * two.cos, 3 * kCore * three.cos);
  const Vector3d normal(three.cos * two.cos, three.cos * two.sin, three.sin);
  const Vector3d across = tangent.cross(normal).normalized();
  const Turn around = turn(v);
  return {center + kTube * (around.cos * normal + around.sin * across),
          0.75 + 0.25 * turn(5 * u + 0.1 * around.sin).cos};
}

Site three_holes(double u, double v) {
  const int ring = std::min(2, static_cast<int>(3 * u));
  const Ray ray = ray_from_ring(ring, 3 * u - ring, v);
  double t0 = kRingTube;
  double t1 = 1.3 * kRingTube;
  double f0 = three_holes_level(ray.at(t0)) - 1;
  for (int step = 0; step < 8; ++step) {  // secants, to the last bits
    const double f1 = three_holes_level(ray.at(t1)) - 1;
    if (f1 == f0) break;
    const double t2 = t1 - f1 * (t1 - t0) / (f1 - f0);
    t0 = t1;
    f0 = f1;
    t1 = t2;
  }
  const Vector3d p = ray.at(t1);
  const bool converged =
      t1 > 0 && t1 < 1 && std::abs(three_holes_level(p) - 1) < 1e-12;
  if (!converged || nearest_ring(p) != ring) return {Vector3d::Zero(), 0};
  return {p, 0.75 + 0.25 * wave(0.2 * p.x() + 0.3 * p.y())};
}

Site cube(double u, double v) { return box(Vector3d(1, 1, 1), u, v); }

Site plate(double u, double v) { return box(Vector3d(1, 1, 0.05), u, v); }

Site two_sheets(double u, double v) {
  const bool second = u >= 0.5;
  const double x = second ? 2 * u - 1 : 2 * u;
  const double height = 0.05 * wave(x) * wave(v);
  return {{x, v, second ? height + 0.1 : height}, 1};
}

}  // namespace shapes
