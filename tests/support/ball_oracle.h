/// @file
/// Sides of diametral balls by big integers, from explicit centres.
#pragma once

#include <array>
#include <cstddef>

#include "tests/support/exact_oracle.h"

namespace oracle {

/// Side of the ball with centre (a + b) / 2 through a.
template <std::size_t kDim>
int diametral_ball_of_edge(const std::array<const double*, 3>& points) {
  const auto p = to_integers<kDim>(points);
  Integer to_p = 0;
  Integer to_a = 0;
  for (std::size_t i = 0; i < kDim; ++i) {
    const Integer twice_center = p[0][i] + p[1][i];
    to_p += (2 * p[2][i] - twice_center) * (2 * p[2][i] - twice_center);
    to_a += (2 * p[0][i] - twice_center) * (2 * p[0][i] - twice_center);
  }
  return Integer(to_p - to_a).sign();
}

/// Side of the ball centred at the circumcentre of the first three points,
/// found by Cramer's rule: equidistant from them, in their plane.
inline int diametral_ball_of_triangle(
    const std::array<const double*, 4>& points) {
  const auto p = to_integers<3>(points);
  using Row = std::array<Integer, 3>;
  const auto minus = [](const Row& s, const Row& t) {
    return Row{s[0] - t[0], s[1] - t[1], s[2] - t[2]};
  };
  const auto dot = [](const Row& s, const Row& t) {
    return Integer(s[0] * t[0] + s[1] * t[1] + s[2] * t[2]);
  };
  const auto cross = [](const Row& s, const Row& t) {
    return Row{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2],
               s[0] * t[1] - s[1] * t[0]};
  };
  const Row u = minus(p[0], p[2]);
  const Row v = minus(p[1], p[2]);
  const Row n = cross(u, v);
  // Rows u, v, n of the system for the centre o: 2 u.o = |a|^2 - |c|^2, ...
  const Row right = {dot(p[0], p[0]) - dot(p[2], p[2]),
                     dot(p[1], p[1]) - dot(p[2], p[2]), 2 * dot(n, p[2])};
  const Integer d = 2 * dot(u, cross(v, n));
  const Row vn = cross(v, n);
  const Row nu = cross(n, u);
  Row scaled_center;  // d * o
  Integer to_p = 0;
  Integer to_c = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    scaled_center[i] = right[0] * vn[i] + right[1] * nu[i] + right[2] * n[i];
    const Integer dp = d * p[3][i] - scaled_center[i];
    const Integer dc = d * p[2][i] - scaled_center[i];
    to_p += dp * dp;
    to_c += dc * dc;
  }
  return Integer(to_p - to_c).sign();
}

}  // namespace oracle
