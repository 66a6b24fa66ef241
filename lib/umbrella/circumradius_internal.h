/// @file
/// Squared circumradii as fractions, the same formulas for any kind of number,
/// and their exact evaluation.
#pragma once

#include <array>
#include <span>

#include "delaunay/triangulation3.h"
#include "umbrella/exact_ratio.h"

namespace umbrella {

template <class T>
using Vector = std::array<T, 3>;

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/// Four times the square of a radius.
template <class T>
struct RadiusFraction {
  T numerator;
  T denominator;
};

/// Circle through 0, u, v: r = |u| |v| |u - v| / (2 |u x v|).
template <class T>
RadiusFraction<T> circle_radius(const Vector<T>& u, const Vector<T>& v) {
  const Vector<T> side = {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
  const Vector<T> n = cross(u, v);
  return {dot(u, u) * dot(v, v) * dot(side, side), dot(n, n)};
}

/// Centre of the sphere through 0, u, v, w, times twice this volume
/// det(u, v, w): |u|^2 v x w + |v|^2 w x u + |w|^2 u x v.
template <class T>
struct Sphere {
  Vector<T> center;
  T volume;
  Vector<T> normal_uv, normal_vw, normal_wu;
};

template <class T>
Sphere<T> sphere(const Vector<T>& u, const Vector<T>& v, const Vector<T>& w) {
  const Vector<T> uv = cross(u, v), vw = cross(v, w), wu = cross(w, u);
  const T uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  Vector<T> center;
  for (unsigned i = 0; i < 3; ++i)
    center[i] = uu * vw[i] + vv * wu[i] + ww * uv[i];
  return {center, dot(w, uv), uv, vw, wu};
}

/// R = |center| / (2 |volume|).
template <class T>
RadiusFraction<T> sphere_radius(const Sphere<T>& s) {
  return {dot(s.center, s.center), s.volume * s.volume};
}

/// Proofs in docs/math.md, "Circumspheres": in doubles a squared radius is off
/// by less than a 2^-35 part if the squared area or volume is at least this
/// part of what the edges at one corner allow, and no square is below kTiny,
/// where underflow could spoil it.
inline constexpr double kFat = 0x1p-22;
inline constexpr double kTiny = 0x1p-200;

/// A power of two that brings the largest coordinate to about 1, so that no
/// product of scaled coordinates overflows.
double power_of_two_scale(std::span<const delaunay::Point3> points);

inline Vector<double> scaled_difference(const delaunay::Point3& p,
                                        const delaunay::Point3& q,
                                        double scale) {
  return {scale * p[0] - scale * q[0], scale * p[1] - scale * q[1],
          scale * p[2] - scale * q[2]};
}

/// Square of the circumradius in units of 1 / scale, off by less than a 2^-35
/// part. The order of the corners may change the last bits.
///
/// @param scale  power_of_two_scale() of these and perhaps more points
double squared_circumradius(const delaunay::Point3& a,
                            const delaunay::Point3& b,
                            const delaunay::Point3& c, double scale);
double squared_circumradius(const std::array<delaunay::Point3, 4>& abcd,
                            double scale);

/// Each is the double nearest to the exact value for the given coordinates,
/// which may be any finite doubles; equal values give equal doubles.
///
/// @param scale  a power of two, the unit of the result: scale^2 r^2
/// @pre the points are not collinear, or not coplanar
double exact_squared_circumradius(const std::array<delaunay::Point3, 3>& abc,
                                  double scale);
double exact_squared_circumradius(const std::array<delaunay::Point3, 4>& abcd,
                                  double scale);
/// (r / R)^2 for the circle through a, b, c and the sphere through all four.
double exact_squared_lambda(const std::array<delaunay::Point3, 4>& abcd);

/// The same before rounding; the first is of 4 r^2 for the circle through a, b,
/// c, in the points' unit, and d any point off its plane.
ExactRatio squared_circumradius_ratio(
    const std::array<delaunay::Point3, 4>& abcd);
ExactRatio squared_lambda_ratio(const std::array<delaunay::Point3, 4>& abcd);

/// A number known to lie within `error` of hi + lo, |lo| being below an ulp of
/// hi.
struct Enclosure {
  double hi, lo;
  double error;  // infinite if nothing is known
};

/// Of such a ratio.
Enclosure enclosure(const Origin& origin);
/// Such a ratio, that of a circle in units of 4^e, where 2^e divides all
/// coordinates of the first three points.
WholeFraction whole_fraction(const Origin& origin);

}  // namespace umbrella
