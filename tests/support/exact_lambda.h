/// @file
/// Radii and lambda by exact rationals, from textbook formulas: nothing is
/// shared with lib/umbrella.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>

namespace tests {

using Rational = boost::multiprecision::cpp_rational;

/// Squared radius of the circle through a, b, c: the product of the squared
/// sides over 16 times the squared area by Heron.
Rational squared_circle_radius(const std::array<Eigen::Vector3d, 3>& abc);

/// Squared radius of the sphere through four points: the centre solves three
/// linear equations, by Cramer.
Rational squared_sphere_radius(const std::array<Eigen::Vector3d, 4>& abcd);

/// Whether no double is nearer to `exact` than `x`.
bool is_nearest(double x, const Rational& exact);

}  // namespace tests
