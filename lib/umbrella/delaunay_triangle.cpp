#include "umbrella/delaunay_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "umbrella/circumradius_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::kFacetCorners;
using delaunay::Triangulation3;

}  // namespace

DelaunayTriangle::DelaunayTriangle(const Triangulation3& triangulation,
                                   const Circumspheres& spheres,
                                   delaunay::Facet facet)
    : triangulation_(&triangulation), spheres_(&spheres), facet_(facet) {
  const Cell& cell = triangulation.cell(facet.cell());
  const auto& slots = kFacetCorners[facet.index()];
  for (unsigned i = 0; i < 3; ++i) corners_[i] = cell.vertex[slots[i]];
  std::sort(corners_.begin(), corners_.end());
}

std::array<Point3, 3> DelaunayTriangle::points() const {
  return {triangulation_->point(corners_[0]),
          triangulation_->point(corners_[1]),
          triangulation_->point(corners_[2])};
}

delaunay::Facet DelaunayTriangle::opposite() const {
  return triangulation_->cell(facet_.cell()).neighbor[facet_.index()];
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

double DelaunayTriangle::squared_lambda_lower() const {
  const auto [one, other] = cells();
  return squared_circumradius() / std::max(spheres_->squared_radius(one),
                                           spheres_->squared_radius(other));
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
