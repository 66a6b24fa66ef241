#include <algorithm>
#include <cmath>

#include "umbrella/badness_internal.h"
#include "umbrella/circumradius_internal.h"

namespace umbrella {

using delaunay::Facet;

Badness::Badness(const delaunay::Triangulation3& triangulation,
                 CloseWeight weight)
    : triangulation_(triangulation),
      weight_(weight),
      scale_(power_of_two_scale(triangulation.points())) {}

double Badness::operator()(const Triangle& corners, Facet facet) const {
  const auto& [a, b, c] = corners;
  const std::array<Point3, 3> abc = {triangulation_.point(a),
                                     triangulation_.point(b),
                                     triangulation_.point(c)};
  switch (weight_) {
    case CloseWeight::BallOverlap:
      return ball_overlap(abc, facet);
    case CloseWeight::LambdaLower:
      return squared_lambda_lower(abc, facet);
    case CloseWeight::Area: {
      const auto n = cross(scaled_difference(abc[1], abc[0], scale_),
                           scaled_difference(abc[2], abc[0], scale_));
      return dot(n, n);
    }
    case CloseWeight::Circumradius:
      break;
  }
  return squared_circumradius(abc[0], abc[1], abc[2], scale_);
}

// The ball of a cell rises over the plane of the triangle as a cap that meets
// it at an angle phi: 0 for no cap, pi for a half space. With the centre h over
// the plane, on the side of the cell, (sin phi, cos phi) = (r, -h) / R; with w
// the apex and o the centre of the triangle, seen from a, and n the normal, h =
// (w.w / 2 - o.w) |n| / |n.w|. Two balls cut each other at pi if phi + phi' =
// pi, when they are one, and less as both grow: the negative cosine of the sum.
double Badness::ball_overlap(const std::array<Point3, 3>& abc,
                             Facet facet) const {
  const auto u = scaled_difference(abc[1], abc[0], scale_);
  const auto v = scaled_difference(abc[2], abc[0], scale_);
  const auto n = cross(u, v);
  const auto to_u = cross(n, u), from_v = cross(v, n);
  const double n2 = dot(n, n), u2 = dot(u, u), v2 = dot(v, v);
  std::array<double, 3> o;
  for (unsigned i = 0; i < 3; ++i)
    o[i] = (u2 * from_v[i] + v2 * to_u[i]) / (2 * n2);
  const double r = std::sqrt(dot(o, o));

  std::array<double, 2> sine = {0, 0}, cosine = {-1, -1};  // on the hull
  for (unsigned k = 0; k < 2; ++k) {
    const delaunay::Cell& cell = triangulation_.cell(facet.cell());
    if (!cell.is_infinite()) {
      const Point3& apex = triangulation_.point(cell.vertex[facet.index()]);
      const auto w = scaled_difference(apex, abc[0], scale_);
      const double height = std::abs(dot(n, w)) / std::sqrt(n2);
      const double rise = dot(w, w) / 2 - dot(o, w);
      const double length = std::hypot(r * height, rise);
      sine[k] = r * height / length;
      cosine[k] = -rise / length;
    }
    facet = cell.neighbor[facet.index()];
  }
  const double overlap = sine[0] * sine[1] - cosine[0] * cosine[1];
  return std::isnan(overlap) ? 1 : overlap;  // of a needle past all precision
}

double Badness::squared_lambda_lower(const std::array<Point3, 3>& abc,
                                     Facet facet) const {
  double largest = 0;
  for (const Facet side :
       {facet, triangulation_.cell(facet.cell()).neighbor[facet.index()]}) {
    const delaunay::Cell& cell = triangulation_.cell(side.cell());
    if (cell.is_infinite()) return 0;
    const Point3& apex = triangulation_.point(cell.vertex[side.index()]);
    largest = std::max(
        largest, squared_circumradius({abc[0], abc[1], abc[2], apex}, scale_));
  }
  return squared_circumradius(abc[0], abc[1], abc[2], scale_) / largest;
}

}  // namespace umbrella
