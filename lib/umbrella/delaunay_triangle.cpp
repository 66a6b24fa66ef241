#include "umbrella/delaunay_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrella/circumradius_internal.h"

namespace umbrella {

using delaunay::Cell;

std::array<bool, 2> DelaunayTriangle::beyond_hull() const {
  return {triangulation_->cell(facet_.cell()).is_infinite(),
          triangulation_->cell(opposite().cell()).is_infinite()};
}

LambdaInterval DelaunayTriangle::lambda() const {
  const double r2 = squared_circumradius();
  const double lower = std::sqrt(squared_lambda_lower());
  if (is_gabriel()) return {lower, 1};
  const double smallest = std::min(spheres_->squared_radius(facet_.cell()),
                                   spheres_->squared_radius(opposite().cell()));
  const double upper2 = is_safe_quotient(r2, smallest)
                            ? r2 / smallest
                            : std::max(exact_squared_lambda(facet_),
                                       exact_squared_lambda(opposite()));
  return {lower, std::min(std::sqrt(upper2), 1.0)};
}

std::array<double, 2> DelaunayTriangle::squared_lambdas() const {
  const double r2 = squared_circumradius();
  const auto towards = [&](delaunay::Facet side) {
    const double R2 = spheres_->squared_radius(side.cell());
    return is_safe_quotient(r2, R2) ? std::min(r2 / R2, 1.0)
                                    : exact_squared_lambda(side);
  };
  return {towards(facet_), towards(opposite())};
}

std::array<double, 2> DelaunayTriangle::exact_squared_lambdas() const {
  return {exact_squared_lambda(facet_), exact_squared_lambda(opposite())};
}

std::array<double, 2> DelaunayTriangle::exact_squared_cell_radii() const {
  const auto of = [&](delaunay::Facet side) {
    return triangulation_->cell(side.cell()).is_infinite()
               ? std::numeric_limits<double>::infinity()
               : umbrella::exact_squared_circumradius(corners_of(side),
                                                      spheres_->scale());
  };
  return {of(facet_), of(opposite())};
}

double DelaunayTriangle::squared_area() const {
  const auto [a, b, c] = points();
  const auto n = cross(scaled_difference(b, a, spheres_->scale()),
                       scaled_difference(c, a, spheres_->scale()));
  return dot(n, n) / 4;
}

double DelaunayTriangle::exact_squared_lambda_lower() const {
  if (on_hull()) return 0;
  return std::min(exact_squared_lambda(facet_),
                  exact_squared_lambda(opposite()));
}

/// Those of the triangle, and the apex of the cell on one side.
std::array<Point3, 4> DelaunayTriangle::corners_of(delaunay::Facet side) const {
  const auto [a, b, c] = points();
  const Cell& cell = triangulation_->cell(side.cell());
  return {a, b, c, triangulation_->point(cell.vertex[side.index()])};
}

/// Towards the cell of a facet.
double DelaunayTriangle::exact_squared_lambda(delaunay::Facet side) const {
  if (triangulation_->cell(side.cell()).is_infinite()) return 0;
  return umbrella::exact_squared_lambda(corners_of(side));
}

ExactRatio DelaunayTriangle::squared_lambda_lower_ratio() const {
  if (on_hull()) return {};
  if (const auto side = spheres_->larger_side(facet_))
    return squared_lambda_ratio(corners_of(*side));
  const ExactRatio here = squared_lambda_ratio(corners_of(facet_));
  const ExactRatio there = squared_lambda_ratio(corners_of(opposite()));
  return compare(here, there) <= 0 ? here : there;
}

ExactRatio DelaunayTriangle::squared_circumradius_ratio() const {
  const bool is_infinite = triangulation_->cell(facet_.cell()).is_infinite();
  return umbrella::squared_circumradius_ratio(
      corners_of(is_infinite ? opposite() : facet_));
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
