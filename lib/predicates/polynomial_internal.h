/// @file
/// The six predicates as polynomials in differences of coordinates, each
/// written once. Every stage evaluates these same expressions over its own
/// number type: doubles that carry a magnitude, integers of growing width,
/// expansions.
///
/// A stage passes `minus`, a function of two coordinates; what it returns has
/// + and - between terms of equal degree, and a product that may be of another
/// type than its factors.
///
/// Differences are from point kOrigin. Integer differences of at most
/// 2^kInt64Bits keep every term and sum below 2^63, and of at most
/// 2^kInt128Bits below 2^63 up to degree 2 and 2^127 above: docs/math.md,
/// "Small integers".
#pragma once

#include <array>
#include <cstddef>

#include "predicates/vector_internal.h"

namespace predicates::internal {

template <std::size_t kPoints>
using Points = std::array<const double*, kPoints>;

/// det(b - a, c - a).
struct Orient2d {
  static constexpr int kDegree = 2;
  static constexpr std::size_t kDimension = 2, kPoints = 3, kOrigin = 0;
  static constexpr int kInt64Bits = 30, kInt128Bits = 30;

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    return cross_xy(vector2(minus, p[1], p[0]), vector2(minus, p[2], p[0]));
  }
};

/// det(b - a, c - a, d - a).
struct Orient3d {
  static constexpr int kDegree = 3;
  static constexpr std::size_t kDimension = 3, kPoints = 4, kOrigin = 0;
  static constexpr int kInt64Bits = 20, kInt128Bits = 30;

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    const auto u = vector3(minus, p[1], p[0]);
    const auto v = vector3(minus, p[2], p[0]);
    const auto w = vector3(minus, p[3], p[0]);
    return cross_xy(v, w) * u.z + cross_xy(w, u) * v.z + cross_xy(u, v) * w.z;
  }
};

/// det of the rows (q, |q|^2), q = a - d, b - d, c - d.
struct Incircle {
  static constexpr int kDegree = 4;
  static constexpr std::size_t kDimension = 2, kPoints = 4, kOrigin = 3;
  static constexpr int kInt64Bits = 14, kInt128Bits = 29;

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    const auto a = vector2(minus, p[0], p[3]);
    const auto b = vector2(minus, p[1], p[3]);
    const auto c = vector2(minus, p[2], p[3]);
    return dot(a, a) * cross_xy(b, c) + dot(b, b) * cross_xy(c, a) +
           dot(c, c) * cross_xy(a, b);
  }
};

/// Minus the det of the rows (q, |q|^2), q = a - e, b - e, c - e, d - e.
struct Insphere {
  static constexpr int kDegree = 5;
  static constexpr std::size_t kDimension = 3, kPoints = 5, kOrigin = 4;
  static constexpr int kInt64Bits = 11, kInt128Bits = 24;

  /// Orientations of the simplex with e in place of a, b, c, d; the second and
  /// the fourth with the other sign.
  template <class Vector>
  static constexpr auto minors(const std::array<Vector, 4>& q) {
    const auto& [a, b, c, d] = q;
    const auto ab = cross_xy(a, b), bc = cross_xy(b, c), cd = cross_xy(c, d);
    const auto da = cross_xy(d, a), ac = cross_xy(a, c), bd = cross_xy(b, d);
    return std::array{
        cd * b.z - bd * c.z + bc * d.z, da * c.z + ac * d.z + cd * a.z,
        ab * d.z + bd * a.z + da * b.z, bc * a.z - ac * b.z + ab * c.z};
  }

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    const std::array q = {
        vector3(minus, p[0], p[4]), vector3(minus, p[1], p[4]),
        vector3(minus, p[2], p[4]), vector3(minus, p[3], p[4])};
    return evaluate(q, minors(q));
  }
  template <class Vector, class Minor>
  static constexpr auto evaluate(const std::array<Vector, 4>& q,
                                 const std::array<Minor, 4>& minor) {
    const auto& [a, b, c, d] = q;
    const auto& [bcd, cda, dab, abc] = minor;
    return (dab * dot(c, c) - abc * dot(d, d)) +
           (bcd * dot(a, a) - cda * dot(b, b));
  }
};

/// (a - p).(b - p): the angle over the diameter ab is acute outside.
struct GabrielEdge {
  static constexpr int kDegree = 2;
  static constexpr std::size_t kDimension = 2, kPoints = 3, kOrigin = 2;
  static constexpr int kInt64Bits = 30, kInt128Bits = 30;

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    return dot(vector2(minus, p[0], p[2]), vector2(minus, p[1], p[2]));
  }
};

/// n.(|w|^2 n + m x w) for the triangle u, v and the point w relative to c,
/// n = u x v, m = |u|^2 v - |v|^2 u; docs/math.md, "Diametral ball".
struct GabrielTriangle {
  static constexpr int kDegree = 6;
  static constexpr std::size_t kDimension = 3, kPoints = 4, kOrigin = 2;
  static constexpr int kInt64Bits = 9, kInt128Bits = 20;

  template <class Minus, class Points>
  static constexpr auto evaluate(const Minus& minus, const Points& p) {
    const auto u = vector3(minus, p[0], p[2]);
    const auto v = vector3(minus, p[1], p[2]);
    const auto w = vector3(minus, p[3], p[2]);
    const auto uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const auto n = cross(u, v);
    using Cubic = decltype(uu * v.x - vv * u.x);
    const Vector3<Cubic> m = {uu * v.x - vv * u.x, uu * v.y - vv * u.y,
                              uu * v.z - vv * u.z};
    const auto q = cross(m, w);
    using Quartic = decltype(ww * n.x + q.x);
    const Vector3<Quartic> r = {ww * n.x + q.x, ww * n.y + q.y, ww * n.z + q.z};
    return dot(n, r);
  }
};

}  // namespace predicates::internal
