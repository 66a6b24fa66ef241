/// @file
/// What the shapes are made of: random numbers, angles, surfaces and curves.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace shapes {

/// The engine is fixed by the standard; its distributions are not, so the
/// mapping to doubles is our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  /// Uniform in 0 .. n-1, up to a bias of n / 2^64.
  std::uint64_t below(std::uint64_t n) { return engine_() % n; }

 private:
  std::mt19937_64 engine_;
};

/// Cosine and sine of an angle in turns, by operations that are the same on
/// every machine (libm's are not); error below 1e-15.
struct Turn {
  double cos;
  double sin;
};
Turn turn(double turns);

/// A point and the distance that it wants to its neighbours, relative to the
/// other points of the shape: in (0, 1], or 0 for "no point here".
struct Site {
  Eigen::Vector3d position;
  double spacing;
};

/// Maps the unit square onto a surface, evenly within a factor of a few.
using Surface = Site (*)(double u, double v);

Site sphere(double u, double v);
Site ellipsoid(double u, double v);
Site bumpy(double u, double v);
Site two_spheres(double u, double v);
Site torus(double u, double v);
Site knot(double u, double v);
Site three_holes(double u, double v);
Site cube(double u, double v);
Site plate(double u, double v);
Site two_sheets(double u, double v);

/// 1 on the surface `three_holes`, more outside; nearly linear across it.
double three_holes_level(const Eigen::Vector3d& p);
/// Of the surface `bumpy` in that direction, a unit vector.
double bumpy_radius(const Eigen::Vector3d& direction);

/// n sites of a surface, no two of them nearer than about 0.6 of the distance
/// of the best packing; `spacing` is that least distance, absolute.
std::vector<Site> scatter(Surface surface, std::size_t n, Random& random);

/// Closed curves in the plane: `point(t)` for t in [k, k + 1) runs once
/// through component k.
struct Curve {
  Eigen::Vector2d (*point)(double t);
  int components = 1;
};

Eigen::Vector2d circle(double t);
Eigen::Vector2d ellipse(double t);
Eigen::Vector2d fourier(double t);
Eigen::Vector2d star(double t);
Eigen::Vector2d square(double t);
Eigen::Vector2d two_circles(double t);

/// n sites along a curve, one in each n-th of its length.
std::vector<Site> scatter(const Curve& curve, std::size_t n, Random& random);

/// n random points of the unit cube.
std::vector<Site> uniform(std::size_t n, Random& random);
/// The first n points of the smallest cubic lattice that holds them.
std::vector<Site> lattice(std::size_t n);
/// n integer points exactly on one sphere about 0.
std::vector<Site> lattice_sphere(std::size_t n, Random& random);

}  // namespace shapes
