#include "umbrella/delaunay_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "umbrella/circumradius_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::kFacetCorners;

}  // namespace

Triangle DelaunayTriangle::corners() const {
  const Cell& cell = triangulation_->cell(facet_.cell());
  const auto& slots = kFacetCorners[facet_.index()];
  const VertexId a = cell.vertex[slots[0]], b = cell.vertex[slots[1]],
                 c = cell.vertex[slots[2]];
  const VertexId low = std::min(a, b), high = std::max(a, b);
  return {std::min(low, c), std::max(low, std::min(high, c)),
          std::max(high, c)};
}

std::array<Point3, 3> DelaunayTriangle::points() const {
  const auto [a, b, c] = corners();
  return {triangulation_->point(a), triangulation_->point(b),
          triangulation_->point(c)};
}

bool DelaunayTriangle::on_hull() const {
  return triangulation_->cell(facet_.cell()).is_infinite() ||
         triangulation_->cell(opposite().cell()).is_infinite();
}

LambdaInterval DelaunayTriangle::lambda() const {
  const double r2 = squared_circumradius();
  const auto [one, other] = cells();
  const double l1 = std::sqrt(r2 / spheres_->squared_radius(one));
  const double l2 = std::sqrt(r2 / spheres_->squared_radius(other));
  return {std::min({l1, l2, 1.0}),
          is_gabriel() ? 1.0 : std::min(std::max(l1, l2), 1.0)};
}

double DelaunayTriangle::squared_circumradius() const {
  return umbrella::squared_circumradius(points(), spheres_->scale());
}

double DelaunayTriangle::exact_squared_lambda_lower() const {
  if (on_hull()) return 0;
  const auto [a, b, c] = points();
  const auto towards = [&](delaunay::Facet f) {
    const Cell& cell = triangulation_->cell(f.cell());
    return umbrella::exact_squared_lambda(
        {a, b, c, triangulation_->point(cell.vertex[f.index()])});
  };
  return std::min(towards(facet_), towards(opposite()));
}

double DelaunayTriangle::exact_squared_circumradius() const {
  return umbrella::exact_squared_circumradius(points(), spheres_->scale());
}

double DelaunayTriangle::circumradius() const {
  return std::sqrt(squared_circumradius()) / spheres_->scale();
}

double DelaunayTriangle::area() const {
  const auto [a, b, c] = points();
  return (b - a).cross(c - a).norm() / 2;
}

}  // namespace umbrella
