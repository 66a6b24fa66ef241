// Parts of bodies as a designer's mesh gives them, by points on edges alone.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "umbrella/triangle.h"

namespace support {

using Points = std::vector<umbrella::Point3>;

struct Circle {
  double x = 0, y = 0;
  double radius = 1;
};

inline void add_ring(const Circle& circle, double z, int n, Points& points) {
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.emplace_back(circle.x + circle.radius * std::cos(angle),
                        circle.y + circle.radius * std::sin(angle), z);
  }
}

/// Turned any way; every second time written with six digits.
inline Points placed(Points points, int trial, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Eigen::Quaterniond q{unit(rng), unit(rng), unit(rng), unit(rng)};
  for (umbrella::Point3& p : points) {
    p = q.normalized() * p;
    if (trial % 2 == 1)
      for (double& x : p) x = std::round(x * 1e6) / 1e6;
  }
  return points;
}

}  // namespace support
