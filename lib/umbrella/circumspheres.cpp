// One pass over the cells answers both questions of a facet: with the centre
// in barycentric coordinates, its sign at a corner says on which side of the
// opposite facet the centre lies, hence whether the corner lies in the facet's
// diametral ball; so two cells decide a Gabriel triangle, and no ball is
// tested twice. Cells are taken by fours, so that the arithmetic fills vector
// registers.
#include "umbrella/circumspheres.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
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

/// One number for each of some cells; arithmetic is on all at once.
constexpr std::size_t kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

/// A corner of a cell and its place there, in 32 bits; ascends with the vertex.
class Corner {
 public:
  Corner(VertexId vertex, unsigned place)
      : bits_(static_cast<std::uint32_t>(vertex) << 2U | place) {}
  Corner() = default;
  VertexId vertex() const { return VertexId{bits_ >> 2U}; }
  unsigned place() const { return bits_ & 3U; }
  friend auto operator<=>(Corner, Corner) = default;

 private:
  std::uint32_t bits_ = 0;
};
static_assert(Triangulation3::max_points() <= std::size_t{1} << 30U);

using Corners = std::array<Corner, 4>;

/// Ascending: so results do not depend on the order in the cell.
Corners sorted_corners(const Cell& cell) {
  Corners corners = {Corner(cell.vertex[0], 0), Corner(cell.vertex[1], 1),
                     Corner(cell.vertex[2], 2), Corner(cell.vertex[3], 3)};
  const auto order = [&corners](unsigned i, unsigned k) {
    const Corner low = std::min(corners[i], corners[k]);
    corners[k] = std::max(corners[i], corners[k]);
    corners[i] = low;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return corners;
}

struct Geometry {
  Lanes squared_radius;  // right where is_fat
  Eigen::Array<bool, kLanes, 1> is_fat;
  std::array<Lanes, 4> side;  // 2 volume^2 times barycentric coordinates
  Lanes side_error;           // infinite where nothing is certain
};

/// @param v  corners in any fixed order, scaled
Geometry measure(const std::array<Vector<Lanes>, 4>& v) {
  const auto edge = [&](unsigned k) -> Vector<Lanes> {
    return {v[k][0] - v[0][0], v[k][1] - v[0][1], v[k][2] - v[0][2]};
  };
  const Vector<Lanes> a = edge(1), b = edge(2), c = edge(3);
  const Sphere<Lanes> s = sphere(a, b, c);
  const RadiusFraction<Lanes> r = sphere_radius(s);
  const Lanes aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  const Lanes longest = aa.max(bb).max(cc), shortest = aa.min(bb).min(cc);

  Geometry result;
  result.squared_radius = r.numerator / (4 * r.denominator);
  result.is_fat = shortest >= kTiny && r.denominator >= kFat * (aa * bb * cc);
  auto& side = result.side;
  side[1] = dot(s.center, s.normal_vw);
  side[2] = dot(s.center, s.normal_wu);
  side[3] = dot(s.center, s.normal_uv);
  side[0] = 2 * r.denominator - (side[1] + side[2] + side[3]);
  result.side_error = (longest < kTiny)
                          .select(std::numeric_limits<double>::infinity(),
                                  kSideError * (longest * longest * longest));
  return result;
}

bool apex_outside(const Triangulation3& t, const Cell& cell, unsigned facet) {
  const auto& corners = kFacetCorners[facet];
  const auto at = [&](unsigned i) { return t.point(cell.vertex[i]).data(); };
  return predicates::gabriel_triangle(at(corners[0]), at(corners[1]),
                                      at(corners[2]), at(facet)) >= 0;
}

/// The squared radius of a cell where doubles do not suffice.
double refined(const Triangulation3& t, const Corners& corners, double scale) {
  return refined_squared_circumradius(
      std::array{t.point(corners[0].vertex()), t.point(corners[1].vertex()),
                 t.point(corners[2].vertex()), t.point(corners[3].vertex())},
      scale);
}

/// Bit i: whether the corner opposite facet i lies outside its diametral ball.
unsigned apexes_outside(const Triangulation3& t, const Cell& cell,
                        const Corners& corners, const Geometry& geometry,
                        Eigen::Index lane) {
  unsigned bits = 0;
  for (unsigned k = 0; k < 4; ++k) {
    const unsigned facet = corners[k].place();
    const double side = geometry.side[k][lane];
    const bool outside = std::abs(side) > geometry.side_error[lane]
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
  const std::size_t n = triangulation.n_finite_cells();
  for (std::size_t first = 0; first < n; first += kLanes)
    add_cells(triangulation, first, std::min(n - first, kLanes));
}

void Circumspheres::add_cells(const Triangulation3& triangulation,
                              std::size_t first, std::size_t n) {
  std::array<Corners, kLanes> corners;
  std::array<Vector<Lanes>, 4> v;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t cell = first + std::min(lane, n - 1);
    corners[lane] = sorted_corners(triangulation.cells()[cell]);
    for (unsigned k = 0; k < 4; ++k) {
      const Point3& p = triangulation.point(corners[lane][k].vertex());
      for (unsigned i = 0; i < 3; ++i)
        v[k][i][static_cast<Eigen::Index>(lane)] = scale_ * p[i];
    }
  }
  const Geometry geometry = measure(v);
  for (std::size_t lane = 0; lane < n; ++lane) {
    const auto l = static_cast<Eigen::Index>(lane);
    const Cell& cell = triangulation.cells()[first + lane];
    squared_radius_[first + lane] =
        geometry.is_fat[l] ? geometry.squared_radius[l]
                           : refined(triangulation, corners[lane], scale_);
    apex_outside_[first + lane] = static_cast<std::uint8_t>(
        apexes_outside(triangulation, cell, corners[lane], geometry, l));
  }
}

}  // namespace umbrella
