/// @file
/// Circumsphere of 0, u, v, w, moved to p: centre p + o with
/// o = (|u|^2 v x w + |v|^2 w x u + |w|^2 u x v) / (2 u.(v x w)).
/// The bounds are certain under four conditions (docs/math.md, "Cached
/// circumsphere"); NaN and overflow fail them, and so does det = 0, which is
/// what a corner at infinity makes. Two cells are computed at once, in vector
/// registers of a size that every 64-bit processor has.
#include <algorithm>
#include <cstddef>
#include <limits>

#include "delaunay/star_spheres_internal.h"

namespace delaunay {
namespace {

/// A number for each of two cells.
using Lanes [[gnu::vector_size(16)]] = double;

struct Vectors {
  Lanes x, y, z;
};

struct Corner {
  Vectors offset;
  Lanes norm2;
};

struct Spheres {
  Vectors center;
  Lanes inside2, outside2;
};

Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Lanes dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Lanes max(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

/// @param least_r2  smaller spheres are not certain
Spheres spheres(const Vectors& p, double least_r2,
                const std::array<Corner, 3>& corner) {
  constexpr double kMaxFlatness2 = 0x1p41;
  constexpr double kMargin = 0x1p-22;
  constexpr Lanes kZero = {};
  constexpr Lanes kNever = kZero + std::numeric_limits<double>::infinity();

  const auto& [u, v, w] = corner;
  const Vectors vw = cross(v.offset, w.offset);
  const Vectors wu = cross(w.offset, u.offset);
  const Vectors uv = cross(u.offset, v.offset);
  const Lanes det = dot(u.offset, vw);
  const Lanes scale = 0.5 / det;
  const Vectors o = {
      (u.norm2 * vw.x + v.norm2 * wu.x + w.norm2 * uv.x) * scale,
      (u.norm2 * vw.y + v.norm2 * wu.y + w.norm2 * uv.y) * scale,
      (u.norm2 * vw.z + v.norm2 * wu.z + w.norm2 * uv.z) * scale};
  const Lanes r2 = dot(o, o);
  const Vectors c = {p.x + o.x, p.y + o.y, p.z + o.z};
  const Lanes l2 = max(max(u.norm2, v.norm2), w.norm2);
  const auto good = (l2 * l2 * l2 < kMaxFlatness2 * (det * det)) &
                    (least_r2 < r2) & (r2 < 0x1p120);
  return {{good ? c.x : kZero, good ? c.y : kZero, good ? c.z : kZero},
          good ? r2 * (1 - kMargin) : kZero,
          good ? r2 * (1 + kMargin) : kNever};
}

Corner side_by_side(const Spoke& a, const Spoke& b) {
  const auto& u = a.offset;
  const auto& v = b.offset;
  return {{Lanes{u[0], v[0]}, Lanes{u[1], v[1]}, Lanes{u[2], v[2]}},
          Lanes{a.norm2, b.norm2}};
}

void write(Cell& cell, const Spheres& s, std::size_t lane) {
  cell.center = {s.center.x[lane], s.center.y[lane], s.center.z[lane]};
  cell.inside2 = static_cast<float>(s.inside2[lane]);
  cell.outside2 = static_cast<float>(s.outside2[lane]);
}

}  // namespace

void set_star_spheres(const double* apex, const Star& star, Cell* all) {
  constexpr double kMinRadius2 = 0x1p-52;  // in squared distances of the apex
  const double* p = apex;
  const double least_r2 = std::max(
      0x1p-120, kMinRadius2 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
  const Vectors twice = {Lanes{p[0], p[0]}, Lanes{p[1], p[1]},
                         Lanes{p[2], p[2]}};
  const std::size_t n = star.cells.size();
  for (std::size_t k = 0; k < n; k += 2) {
    const std::size_t l = std::min(k + 1, n - 1);
    std::array<Corner, 3> corner;
    for (std::size_t i = 0; i < 3; ++i)
      corner[i] = side_by_side(star.spokes[star.corners[k][i]],
                               star.spokes[star.corners[l][i]]);
    const Spheres s = spheres(twice, least_r2, corner);
    write(all[index(star.cells[k])], s, 0);
    write(all[index(star.cells[l])], s, 1);
  }
}

void forget_sphere(Cell& cell) {
  cell.center = {0, 0, 0};
  cell.inside2 = 0;
  cell.outside2 = std::numeric_limits<float>::infinity();
}

}  // namespace delaunay
