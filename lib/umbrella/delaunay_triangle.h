/// @file
/// One Delaunay triangle, and what a criterion may ask about it.
#pragma once

#include <algorithm>
#include <array>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/exact_ratio.h"
#include "umbrella/lambda_interval.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// A view: every answer is computed when it is asked for. The objects it looks
/// at must outlive it. Answers depend on the set of points
/// alone, not on how cells are numbered or which cell the facet is seen from.
class DelaunayTriangle {
 public:
  /// @param radii  spheres.measure(facet), of who has measured many at once
  DelaunayTriangle(const delaunay::Triangulation3& triangulation,
                   const Circumspheres& spheres, delaunay::Facet facet,
                   const FacetRadii* radii = nullptr)
      : triangulation_(&triangulation),
        spheres_(&spheres),
        radii_(radii),
        facet_(facet) {}

  Triangle corners() const {
    return umbrella::corners(*triangulation_, facet_);
  }
  /// In the order of corners().
  std::array<Point3, 3> points() const {
    const auto [a, b, c] = corners();
    return {triangulation_->point(a), triangulation_->point(b),
            triangulation_->point(c)};
  }

  /// The two cells at the triangle, one of them perhaps beyond the hull.
  std::array<delaunay::CellId, 2> cells() const {
    return {facet_.cell(), opposite().cell()};
  }
  /// Which of cells() are beyond the hull.
  std::array<bool, 2> beyond_hull() const;
  bool on_hull() const {
    const auto [here, there] = beyond_hull();
    return here || there;
  }

  /// Whether the centre of each of cells() is on its own side of the triangle,
  /// or in its plane; exact. True beyond the hull.
  std::array<bool, 2> centers_on_own_side() const {
    return {spheres_->apex_outside_diametral_ball(facet_),
            spheres_->apex_outside_diametral_ball(opposite())};
  }

  /// No sample point lies in the open diametral ball; exact.
  bool is_gabriel() const { return spheres_->is_gabriel(facet_); }

  /// Relative error below 2^-34, and far less for triangles and cells that
  /// are not needles or slivers. See exact_...() for the last bit.
  LambdaInterval lambda() const;
  /// Square of the lower bound of lambda().
  double squared_lambda_lower() const {
    const auto [triangle, larger_cell] = radii();
    return is_safe_quotient(triangle, larger_cell)
               ? triangle / larger_cell
               : exact_squared_lambda_lower();
  }
  /// Squares of lambda_1 and lambda_2 [Adamy02, Sec. 2], towards cells(): 0
  /// beyond the hull.
  std::array<double, 2> squared_lambdas() const;
  /// Squared circumradii of cells(), as squared_circumradius(); infinite
  /// beyond the hull.
  std::array<double, 2> squared_cell_radii() const {
    return {spheres_->squared_radius(facet_.cell()),
            spheres_->squared_radius(opposite().cell())};
  }
  /// In units of (1 / scale)^2, scale as in Circumspheres; so it ranks at
  /// any size.
  double squared_circumradius() const { return radii().triangle; }
  /// In units of (1 / scale)^4.
  double squared_area() const;

  /// The doubles nearest to the exact values; slow.
  double exact_squared_lambda_lower() const;
  double exact_squared_circumradius() const;
  std::array<double, 2> exact_squared_lambdas() const;
  std::array<double, 2> exact_squared_cell_radii() const;
  /// Before rounding; slower still. The latter is of 4 r^2.
  ExactRatio squared_lambda_lower_ratio() const;
  ExactRatio squared_circumradius_ratio() const;

  double circumradius() const;  ///< in the unit of the points
  double area() const;          ///< in the squared unit of the points

 private:
  /// Neither operand has lost bits to under- or overflow; false for the
  /// infinite radius beyond the hull.
  static bool is_safe_quotient(double r2, double R2) {
    return r2 >= 0x1p-960 && R2 <= 0x1p+960;
  }
  FacetRadii radii() const {
    return radii_ != nullptr ? *radii_ : spheres_->measure(facet_);
  }
  double exact_squared_lambda(delaunay::Facet side) const;
  std::array<Point3, 4> corners_of(delaunay::Facet side) const;
  delaunay::Facet opposite() const {
    return triangulation_->cell(facet_.cell()).neighbor[facet_.index()];
  }

  const delaunay::Triangulation3* triangulation_;
  const Circumspheres* spheres_;
  const FacetRadii* radii_;
  delaunay::Facet facet_;
};

}  // namespace umbrella
