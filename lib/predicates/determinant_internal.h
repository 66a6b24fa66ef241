/// @file
/// The six polynomials, each written once. Every stage evaluates these same
/// expressions, over its own number type: doubles that carry a magnitude,
/// integers of growing width, expansions. A product may have another type than
/// its factors; sums and differences are taken between terms of equal degree.
///
/// Arguments are differences of points: relative to the last point of an
/// in-circle or in-sphere test, and to the point named for the others.
#pragma once

namespace predicates::internal {

template <class T>
struct Vector2 {
  T x, y;
};

template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
constexpr auto dot(const Vector2<T>& u, const Vector2<T>& v) {
  return u.x * v.x + u.y * v.y;
}

template <class S, class T>
constexpr auto dot(const Vector3<S>& u, const Vector3<T>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

template <class S, class T>
constexpr auto cross(const Vector3<S>& u, const Vector3<T>& v) {
  using Product = decltype(u.x * v.x);
  return Vector3<Product>{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                          u.x * v.y - u.y * v.x};
}

/// u x v in the plane of x and y.
template <template <class> class Vector, class T>
constexpr auto cross_xy(const Vector<T>& u, const Vector<T>& v) {
  return u.x * v.y - u.y * v.x;
}

/// det(u, v): degree 2. orient2d with u = b - a, v = c - a.
template <class T>
constexpr auto orient2d_polynomial(const Vector2<T>& u, const Vector2<T>& v) {
  return cross_xy(u, v);
}

/// det(u, v, w): degree 3. orient3d relative to a.
template <class T>
constexpr auto orient3d_polynomial(const Vector3<T>& u, const Vector3<T>& v,
                                   const Vector3<T>& w) {
  return cross_xy(v, w) * u.z + cross_xy(w, u) * v.z + cross_xy(u, v) * w.z;
}

/// det of rows (p, |p|^2), p = a, b, c: degree 4. incircle relative to d.
template <class T>
constexpr auto incircle_polynomial(const Vector2<T>& a, const Vector2<T>& b,
                                   const Vector2<T>& c) {
  return dot(a, a) * cross_xy(b, c) + dot(b, b) * cross_xy(c, a) +
         dot(c, c) * cross_xy(a, b);
}

/// Minus the det of rows (p, |p|^2), p = a, b, c, d: degree 5. insphere
/// relative to e.
template <class T>
constexpr auto insphere_polynomial(const Vector3<T>& a, const Vector3<T>& b,
                                   const Vector3<T>& c, const Vector3<T>& d) {
  const auto ab = cross_xy(a, b), bc = cross_xy(b, c), cd = cross_xy(c, d);
  const auto da = cross_xy(d, a), ac = cross_xy(a, c), bd = cross_xy(b, d);
  const auto abc = bc * a.z - ac * b.z + ab * c.z;
  const auto bcd = cd * b.z - bd * c.z + bc * d.z;
  const auto cda = da * c.z + ac * d.z + cd * a.z;
  const auto dab = ab * d.z + bd * a.z + da * b.z;
  return (dab * dot(c, c) - abc * dot(d, d)) +
         (bcd * dot(a, a) - cda * dot(b, b));
}

/// a.b: degree 2. Side of the diametral circle relative to the query point.
template <class T>
constexpr auto gabriel_edge_polynomial(const Vector2<T>& a,
                                       const Vector2<T>& b) {
  return dot(a, b);
}

/// n.(|w|^2 n + p x w) with n = u x v, p = |u|^2 v - |v|^2 u: degree 6,
/// docs/math.md "Diametral ball of a triangle". u, v are two corners and w the
/// query point, relative to the third corner.
template <class T>
constexpr auto gabriel_triangle_polynomial(const Vector3<T>& u,
                                           const Vector3<T>& v,
                                           const Vector3<T>& w) {
  const auto uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const auto n = cross(u, v);
  using Cubic = decltype(uu * v.x);
  const Vector3<Cubic> p = {uu * v.x - vv * u.x, uu * v.y - vv * u.y,
                            uu * v.z - vv * u.z};
  const auto q = cross(p, w);
  using Quartic = decltype(ww * n.x);
  const Vector3<Quartic> r = {ww * n.x + q.x, ww * n.y + q.y, ww * n.z + q.z};
  return dot(n, r);
}

}  // namespace predicates::internal
