/// @file
/// Draws of five points on or near a degeneracy; 2D tests use x and y.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace inputs {

using Rng = std::mt19937_64;
using Point = std::array<double, 3>;
using Simplex = std::array<Point, 5>;

inline double uniform(Rng& rng) {
  return std::uniform_real_distribution<double>(-1, 1)(rng);
}

inline int below(Rng& rng, int n) {
  return static_cast<int>(rng() % static_cast<std::uint64_t>(n));
}

template <class Coordinate>
Simplex each_coordinate(const Coordinate& coordinate) {
  Simplex s;
  for (Point& p : s)
    for (double& x : p) x = coordinate();
  return s;
}

inline Simplex in_cube(Rng& rng) {
  return each_coordinate([&] { return uniform(rng); });
}

/// A corner of 4^3 integers: every degeneracy, coincident points too.
inline Simplex small_integers(Rng& rng) {
  return each_coordinate([&] { return below(rng, 4); });
}

/// As small_integers, on a far and fine lattice: exact in native integers only.
inline Simplex shifted_lattice(Rng& rng) {
  return each_coordinate([&] { return 1e6 + below(rng, 4) * 0x1p-20; });
}

/// Neighbouring doubles.
inline Simplex ulp_grid(Rng& rng) {
  return each_coordinate([&] { return 0.5 + below(rng, 8) * 0x1p-53; });
}

/// Kettner et al.'s classroom examples: nearly on the diagonal through 12 and
/// 24 [Kettner08].
inline Simplex kettner(Rng& rng) {
  Simplex s;
  for (double& x : s[0]) x = 0.5 + below(rng, 256) * 0x1p-53;
  s[1] = {12, 12, 12};
  s[2] = {24, 24, 24};
  for (double& x : s[3]) x = 17.3 + below(rng, 64) * 0x1p-48;
  for (double& x : s[4]) x = 24 + below(rng, 64) * 0x1p-48;
  if (below(rng, 2) == 0) std::swap(s[0], s[3]);
  return s;
}

/// On the sphere of radius 441 about the origin, times a random integer of up
/// to 40 bits: cospherical exactly, each magnitude of integers.
inline Simplex cospherical_integers(Rng& rng) {
  static constexpr std::array<Point, 5> kSolutions = {{{441, 0, 0},
                                                       {147, 294, 294},
                                                       {126, 189, 378},
                                                       {49, 196, 392},
                                                       {0, 441, 0}}};
  const auto factor =
      std::floor(std::exp2(40 * std::abs(uniform(rng)))) * 0x1p-13;
  Simplex s;
  for (Point& p : s) {
    p = kSolutions[rng() % kSolutions.size()];
    std::shuffle(p.begin(), p.end(), rng);
    for (double& x : p) x *= below(rng, 2) == 0 ? factor : -factor;
  }
  return s;
}

/// On the circle of radius 65 in each plane z = 0 .. 3: cocircular from above.
inline Simplex cocircular_integers(Rng& rng) {
  static constexpr std::array<Point, 4> kSolutions = {
      {{65, 0, 0}, {16, 63, 0}, {25, 60, 0}, {33, 56, 0}}};
  Simplex s;
  for (Point& p : s) {
    p = kSolutions[rng() % kSolutions.size()];
    if (below(rng, 2) == 0) std::swap(p[0], p[1]);
    for (double& x : p) x *= below(rng, 2) == 0 ? 1 : -1;
    p[2] = below(rng, 4);
  }
  return s;
}

/// Rounded to the sphere, or circle, of a random centre and radius.
inline Simplex rounded_to_sphere(Rng& rng) {
  const double radius = std::exp2(10 * uniform(rng));
  const bool flat = below(rng, 2) == 0;
  Simplex s = in_cube(rng);
  for (Point& p : s) {
    const double norm = std::hypot(p[0], p[1], flat ? 0 : p[2]);
    for (double& x : p) x = 3 + radius * (x / norm);
  }
  return s;
}

/// Nearly dependent: the last points are rounded combinations of the others.
inline Simplex nearly_flat(Rng& rng) {
  Simplex s = in_cube(rng);
  const double t = uniform(rng);
  const double r = uniform(rng);
  for (std::size_t i = 0; i < 3; ++i) {
    s[2][i] = s[0][i] + t * (s[1][i] - s[0][i]);
    s[3][i] = s[0][i] + r * (s[4][i] - s[0][i]);
  }
  return s;
}

/// Single precision: many trailing zeros, little cancellation in differences.
inline Simplex single_precision(Rng& rng) {
  return each_coordinate([&] { return static_cast<float>(uniform(rng)); });
}

}  // namespace inputs
