#include <algorithm>

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
