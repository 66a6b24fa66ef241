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

/// A facet within the hull or on it, and the cell there with the larger sphere.
struct FacetView {
  std::array<const Point3*, 4> points;  // corners; that cell's apex
  const Point3* rival = nullptr;  // apex of the other cell, if it may be larger
  bool on_hull = false;

  FacetView() = default;
  FacetView(const Triangulation3& t, Facet facet) {
    const Cell& here = t.cell(facet.cell());
    const Facet beyond = here.neighbor[facet.index()];
    const Cell& there = t.cell(beyond.cell());
    std::array<VertexId, 3> corners;
    for (unsigned i = 0; i < 3; ++i)
      corners[i] = here.vertex[kFacetCorners[facet.index()][i]];
    sort_corners(corners);
    for (unsigned i = 0; i < 3; ++i) points[i] = &t.point(corners[i]);

    on_hull = here.is_infinite() || there.is_infinite();
    const bool is_beyond =
        on_hull ? here.is_infinite() : there.inside2 > here.inside2;
    const VertexId near = here.vertex[facet.index()];
    const VertexId far = there.vertex[beyond.index()];
    points[3] = &t.point(is_beyond ? far : near);
    // Squared radii lie within a 2^-22 part of what is cached, and are computed
    // to a 2^-35 part: beyond such a gap there is no rival.
    constexpr double kGap = 1 + 0x1p-20;
    if (!on_hull && std::max(here.inside2, there.inside2) <=
                        kGap * std::min(here.outside2, there.outside2))
      rival = &t.point(is_beyond ? near : far);
  }
};

/// Radii of four facets in plain doubles.
struct Geometry {
  Lanes triangle, cell;  // squared radii, right where fat
  Eigen::Array<bool, kLanes, 1> is_fat_triangle, is_fat_cell;

  explicit Geometry(const std::array<Vector<Lanes>, 4>& v) {
    const auto edge = [&](unsigned k) -> Vector<Lanes> {
      return {v[k][0] - v[0][0], v[k][1] - v[0][1], v[k][2] - v[0][2]};
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

FacetRadii radii_of(const FacetView& view, const Geometry& geometry,
                    std::size_t lane, double scale) {
  const auto l = static_cast<Eigen::Index>(lane);
  const auto& [a, b, c, d] = view.points;
  FacetRadii radii = {geometry.triangle[l], geometry.cell[l]};
  if (!geometry.is_fat_triangle[l])
    radii.triangle = squared_circumradius(*a, *b, *c, scale);
  if (!geometry.is_fat_cell[l])
    radii.larger_cell = squared_circumradius({*a, *b, *c, *d}, scale);
  if (view.rival != nullptr)
    radii.larger_cell =
        std::max(radii.larger_cell,
                 squared_circumradius({*a, *b, *c, *view.rival}, scale));
  if (view.on_hull) radii.larger_cell = std::numeric_limits<double>::infinity();
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

void Circumspheres::measure(std::span<const Facet> facets,
                            std::span<FacetRadii> radii) const {
  for (std::size_t first = 0; first < facets.size(); first += kLanes) {
    const std::size_t n = std::min(facets.size() - first, kLanes);
    std::array<FacetView, kLanes> views;
    std::array<Vector<Lanes>, 4> v;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Facet facet = facets[first + std::min(lane, n - 1)];
      views[lane] = FacetView(*triangulation_, facet);
      for (unsigned k = 0; k < 4; ++k)
        for (unsigned i = 0; i < 3; ++i)
          v[k][i][static_cast<Eigen::Index>(lane)] =
              scale_ * (*views[lane].points[k])[i];
    }
    const Geometry geometry(v);
    for (std::size_t lane = 0; lane < n; ++lane)
      radii[first + lane] = radii_of(views[lane], geometry, lane, scale_);
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
