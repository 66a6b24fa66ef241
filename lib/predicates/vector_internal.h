/// @file
/// Difference vectors over the stages' number types, and their products.
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

template <class Minus, class Coordinate>
constexpr auto vector2(const Minus& minus, const Coordinate* to,
                       const Coordinate* from) {
  using T = decltype(minus(to[0], from[0]));
  return Vector2<T>{minus(to[0], from[0]), minus(to[1], from[1])};
}

template <class Minus, class Coordinate>
constexpr auto vector3(const Minus& minus, const Coordinate* to,
                       const Coordinate* from) {
  using T = decltype(minus(to[0], from[0]));
  return Vector3<T>{minus(to[0], from[0]), minus(to[1], from[1]),
                    minus(to[2], from[2])};
}

template <class T>
constexpr auto dot(const Vector2<T>& u, const Vector2<T>& v) {
  return u.x * v.x + u.y * v.y;
}

template <class S, class T>
constexpr auto dot(const Vector3<S>& u, const Vector3<T>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

/// The z of u x v.
template <template <class> class Vector, class T>
constexpr auto cross_xy(const Vector<T>& u, const Vector<T>& v) {
  return u.x * v.y - u.y * v.x;
}

template <class S, class T>
constexpr auto cross(const Vector3<S>& u, const Vector3<T>& v) {
  using Product = decltype(u.y * v.z - u.z * v.y);
  return Vector3<Product>{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                          u.x * v.y - u.y * v.x};
}

}  // namespace predicates::internal
