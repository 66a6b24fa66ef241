// One pass over the cells answers both questions of a facet: with the centre
// in barycentric coordinates, its sign at a corner says on which side of the
// opposite facet the centre lies, hence whether the corner lies in the facet's
// diametral ball; so two cells decide a Gabriel triangle, and no ball is
// tested twice.
#include "umbrella/circumspheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "predicates/gabriel.h"
#include "umbrella/circumradius_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::kFacetCorners;
using delaunay::Point3;
using delaunay::Triangulation3;
using delaunay::VertexId;

// Proofs in docs/math.md, "Circumspheres": with M^2 the largest of |u|^2,
// |v|^2, |w|^2, each barycentric coordinate (times 2 volume^2) is off by less
// than kSideError M^6, if M^2 is at least kTiny: below, underflow could spoil
// it.
constexpr double kSideError = 0x1p-43;
constexpr double kTiny = 0x1p-200;

struct CellGeometry {
  double squared_radius;
  std::array<double, 4> side;  // 2 volume^2 times barycentric coordinates
  double side_error;           // infinite where nothing is certain
};

/// @param v  corners in any fixed order
CellGeometry measure(const std::array<const Point3*, 4>& v, double scale) {
  const auto a = scaled_difference(*v[1], *v[0], scale);
  const auto b = scaled_difference(*v[2], *v[0], scale);
  const auto c = scaled_difference(*v[3], *v[0], scale);
  const Sphere<double> s = sphere(a, b, c);
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);

  const double side1 = dot(s.center, s.normal_vw);
  const double side2 = dot(s.center, s.normal_wu);
  const double side3 = dot(s.center, s.normal_uv);
  const double side0 = 2 * (s.volume * s.volume) - (side1 + side2 + side3);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double longest = std::max({aa, bb, cc});
  return {
      squared_circumradius(s, {aa, bb, cc}, v, scale),
      {side0, side1, side2, side3},
      longest < kTiny ? kInfinity : kSideError * (longest * longest * longest)};
}

/// The corners of a cell, ascending.
std::array<VertexId, 4> sorted(std::array<VertexId, 4> v) {
  const auto order = [&v](unsigned i, unsigned k) {
    const VertexId low = std::min(v[i], v[k]);
    v[k] = std::max(v[i], v[k]);
    v[i] = low;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return v;
}

bool apex_outside(const Triangulation3& t, const Cell& cell, unsigned facet) {
  const auto& corners = kFacetCorners[facet];
  const auto at = [&](unsigned i) { return t.point(cell.vertex[i]).data(); };
  return predicates::gabriel_triangle(at(corners[0]), at(corners[1]),
                                      at(corners[2]), at(facet)) >= 0;
}

/// Bit i: whether the corner opposite facet i lies outside its diametral ball.
/// @param sorted  the corners of the cell in the order of `geometry`
unsigned apexes_outside(const Triangulation3& t, const Cell& cell,
                        const std::array<VertexId, 4>& sorted,
                        const CellGeometry& geometry) {
  unsigned bits = 0;
  for (unsigned facet = 0; facet < 4; ++facet) {
    unsigned position = 0;
    for (const VertexId v : sorted)
      position += v < cell.vertex[facet] ? 1U : 0U;
    const double side = geometry.side[position];
    const bool outside = std::abs(side) > geometry.side_error
                             ? side > 0
                             : apex_outside(t, cell, facet);
    bits |= (outside ? 1U : 0U) << facet;
  }
  return bits;
}

}  // namespace

Circumspheres::Circumspheres(const Triangulation3& triangulation)
    : squared_radius_(triangulation.cells().size(),
                      std::numeric_limits<double>::infinity()),
      apex_outside_(triangulation.cells().size(), 0b1111),
      scale_(power_of_two_scale(triangulation.points())) {
  for (std::size_t i = 0; i < triangulation.n_finite_cells(); ++i) {
    const Cell& cell = triangulation.cells()[i];
    const auto vertex = sorted(cell.vertex);
    std::array<const Point3*, 4> corner;
    for (unsigned k = 0; k < 4; ++k)
      corner[k] = &triangulation.point(vertex[k]);
    const CellGeometry geometry = measure(corner, scale_);
    squared_radius_[i] = geometry.squared_radius;
    apex_outside_[i] = static_cast<std::uint8_t>(
        apexes_outside(triangulation, cell, vertex, geometry));
  }
}

}  // namespace umbrella
