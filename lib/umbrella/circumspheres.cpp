// Radii are computed for four facets at a time, so that the arithmetic fills
// vector registers; which cell at a facet is the larger one, and whether the
// facet is Gabriel, the cached spheres nearly always tell.
#include "umbrella/circumspheres.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "predicates/gabriel.h"
#include "umbrella/circumradius_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;
using delaunay::kFacetCorners;
using delaunay::kInfinite;
using delaunay::Point3;
using delaunay::Triangulation3;
using delaunay::VertexId;

/// One number for each of some facets; arithmetic is on all at once.
constexpr std::size_t kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

/// In place, ascending: so results do not depend on the order in the cell.
/// Plain numbers, for which minima are made without a jump.
template <std::size_t kCorners>
void sort_corners(std::array<VertexId, kCorners>& v) {
  const auto order = [&v](unsigned i, unsigned k) {
    const auto a = static_cast<std::uint32_t>(v[i]);
    const auto b = static_cast<std::uint32_t>(v[k]);
    v[i] = VertexId{a < b ? a : b};
    v[k] = VertexId{a < b ? b : a};
  };
  order(0, 1), order(1, 2), order(0, 1);
  if constexpr (kCorners == 4) order(2, 3), order(1, 2), order(0, 1);
}

/// Facets that are measured together: their coordinates first, then the
/// arithmetic. A processor waits where it reads four numbers at once that it
/// has just written one by one; with so many the first have long arrived.
constexpr std::size_t kBatch = 32;

/// Coordinates of the four points of each.
struct Batch {
  alignas(64) std::array<std::array<std::array<double, kBatch>, 3>, 4> points;

  void set(std::size_t i, const Triangulation3& t, const FacetPoints& facet) {
    const auto& [a, b, c] = facet.triangle.corners;
    // On the hull nobody looks at the sphere.
    const VertexId d = facet.apex == kInfinite ? a : facet.apex;
    unsigned k = 0;
    for (const VertexId v : {a, b, c, d}) {
      for (unsigned axis = 0; axis < 3; ++axis)
        points[k][axis][i] = t.point(v)[axis];
      ++k;
    }
  }
  Vector<Lanes> corner(unsigned k, std::size_t first, double scale) const {
    const auto lanes = [&](unsigned axis) -> Lanes {
      return scale * Eigen::Map<const Lanes>(&points[k][axis][first]);
    };
    return {lanes(0), lanes(1), lanes(2)};
  }
};

/// Radii of four facets in plain doubles.
struct Geometry {
  Lanes triangle, cell;  // squared radii, right where fat
  Eigen::Array<bool, kLanes, 1> is_fat_triangle, is_fat_cell;

  Geometry(const Batch& batch, std::size_t first, double scale) {
    const Vector<Lanes> origin = batch.corner(0, first, scale);
    const auto edge = [&](unsigned k) -> Vector<Lanes> {
      const Vector<Lanes> end = batch.corner(k, first, scale);
      return {end[0] - origin[0], end[1] - origin[1], end[2] - origin[2]};
    };
    const Vector<Lanes> a = edge(1), b = edge(2), c = edge(3);
    const Lanes aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const RadiusFraction<Lanes> r = circle_radius(a, b);
    const RadiusFraction<Lanes> R = sphere_radius(sphere(a, b, c));
    triangle = r.numerator / (4 * r.denominator);
    cell = R.numerator / (4 * R.denominator);
    const Lanes shortest = aa.min(bb);
    is_fat_triangle = shortest >= kTiny && r.denominator >= kFat * (aa * bb);
    is_fat_cell =
        shortest.min(cc) >= kTiny && R.denominator >= kFat * (aa * bb * cc);
  }
};

/// Of the facet in that lane.
FacetRadii radii_of(const Triangulation3& t, const FacetPoints& facet,
                    const Geometry& geometry, std::size_t lane, double scale) {
  const auto l = static_cast<Eigen::Index>(lane);
  const Triangle& corners = facet.triangle.corners;
  const Point3 &a = t.point(corners[0]), &b = t.point(corners[1]),
               &c = t.point(corners[2]);
  FacetRadii radii = {geometry.triangle[l], geometry.cell[l]};
  if (!geometry.is_fat_triangle[l])
    radii.triangle = squared_circumradius(a, b, c, scale);
  if (facet.apex == kInfinite) {
    radii.larger_cell = std::numeric_limits<double>::infinity();
    return radii;
  }
  if (!geometry.is_fat_cell[l])
    radii.larger_cell =
        squared_circumradius({a, b, c, t.point(facet.apex)}, scale);
  if (facet.rival != kInfinite)
    radii.larger_cell =
        std::max(radii.larger_cell,
                 squared_circumradius({a, b, c, t.point(facet.rival)}, scale));
  return radii;
}

}  // namespace

Circumspheres::Circumspheres(const Triangulation3& triangulation)
    : triangulation_(&triangulation),
      scale_(power_of_two_scale(triangulation.points())) {}

double Circumspheres::squared_radius(CellId id) const {
  const Cell& cell = triangulation_->cell(id);
  if (cell.is_infinite()) return std::numeric_limits<double>::infinity();
  auto corners = cell.vertex;
  sort_corners(corners);
  const auto at = [&](unsigned i) { return triangulation_->point(corners[i]); };
  return squared_circumradius({at(0), at(1), at(2), at(3)}, scale_);
}

FacetPoints Circumspheres::points_of(Facet f) const {
  const Cell& here = triangulation_->cell(f.cell());
  const Facet beyond = here.neighbor[f.index()];
  const Cell& there = triangulation_->cell(beyond.cell());
  FacetPoints points = {{{}, f}, kInfinite, kInfinite};
  Triangle& corners = points.triangle.corners;
  for (unsigned i = 0; i < 3; ++i)
    corners[i] = here.vertex[kFacetCorners[f.index()][i]];
  sort_corners(corners);
  if (here.is_infinite() || there.is_infinite()) return points;

  // Looked up, not jumped to: which it is, no processor can guess.
  const std::array<VertexId, 2> apex = {here.vertex[f.index()],
                                        there.vertex[beyond.index()]};
  const unsigned larger = there.inside2 > here.inside2 ? 1 : 0;
  points.apex = apex[larger];
  // Squared radii lie within a 2^-22 part of what is cached, and are computed
  // to a 2^-35 part: beyond such a gap there is no rival.
  constexpr double kGap = 1 + 0x1p-20;
  if (std::max(here.inside2, there.inside2) <=
      kGap * std::min(here.outside2, there.outside2))
    points.rival = apex[1 - larger];
  return points;
}

void Circumspheres::measure(std::span<const FacetPoints> facets,
                            std::span<FacetRadii> radii) const {
  Batch batch;
  for (std::size_t begin = 0; begin < facets.size(); begin += kBatch) {
    const std::size_t n = std::min(facets.size() - begin, kBatch);
    for (std::size_t i = 0; i < n || i % kLanes != 0; ++i)
      batch.set(i, *triangulation_, facets[begin + std::min(i, n - 1)]);
    for (std::size_t first = 0; first < n; first += kLanes) {
      const Geometry geometry(batch, first, scale_);
      const std::size_t end = std::min(first + kLanes, n);
      for (std::size_t i = first; i < end; ++i)
        radii[begin + i] = radii_of(*triangulation_, facets[begin + i],
                                    geometry, i - first, scale_);
    }
  }
}

bool Circumspheres::is_gabriel_exact(Facet f) const {
  return apex_outside_diametral_ball(f) &&
         apex_outside_diametral_ball(
             triangulation_->cell(f.cell()).neighbor[f.index()]);
}

bool Circumspheres::apex_outside_diametral_ball(Facet f) const {
  const Cell& cell = triangulation_->cell(f.cell());
  if (cell.is_infinite()) return true;
  const auto at = [&](unsigned i) {
    return triangulation_->point(cell.vertex[i]).data();
  };
  const auto& corners = kFacetCorners[f.index()];
  return predicates::gabriel_triangle(at(corners[0]), at(corners[1]),
                                      at(corners[2]), at(f.index())) >= 0;
}

}  // namespace umbrella
