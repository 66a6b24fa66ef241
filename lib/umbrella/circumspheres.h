/// @file
/// Circumspheres of the cells of a triangulation, and what two of them say
/// about the facet between.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Squares of circumradii, in the squared unit of 1 / Circumspheres::scale();
/// relative errors below 2^-35.
struct FacetRadii {
  double triangle;
  double larger_cell;  ///< of the two at the facet; infinite on the hull
};

/// What the radii at a facet depend on.
struct FacetPoints {
  LocatedTriangle triangle;
  VertexId apex;  ///< of the cell with the larger sphere; kInfinite on the hull
  /// Of the other cell, if that may be the larger one after all; or kInfinite.
  VertexId rival;
};

/// A view of a triangulation: every answer is computed when it is asked for,
/// most of them from the spheres that the cells carry. Answers are the same for
/// a set of points however its cells are numbered.
class Circumspheres {
 public:
  /// @param triangulation  must outlive this object
  explicit Circumspheres(const delaunay::Triangulation3& triangulation);

  /// Square of the circumradius of a cell, in the squared unit of
  /// 1 / scale(); relative error below 2^-35. Infinite beyond the hull.
  double squared_radius(delaunay::CellId c) const;

  FacetPoints points_of(delaunay::Facet f) const;

  /// Both radii of each facet. Many at once take half the time.
  ///
  /// @param radii  as long as `facets`
  void measure(std::span<const FacetPoints> facets,
               std::span<FacetRadii> radii) const;
  FacetRadii measure(delaunay::Facet f) const {
    const FacetPoints points = points_of(f);
    FacetRadii radii{};
    measure({&points, 1}, {&radii, 1});
    return radii;
  }

  /// The side of a facet within the hull whose cell certainly has the larger
  /// sphere, by a 2^-22 part at least; none where the cached spheres are too
  /// near each other to tell.
  std::optional<delaunay::Facet> larger_side(delaunay::Facet f) const {
    // Squared radii lie within a 2^-22 part of what is cached.
    constexpr double kGap = 1 + 0x1p-20;
    const delaunay::Cell& here = triangulation_->cell(f.cell());
    const delaunay::Facet beyond = here.neighbor[f.index()];
    const delaunay::Cell& there = triangulation_->cell(beyond.cell());
    if (here.inside2 > kGap * there.outside2) return f;
    if (there.inside2 > kGap * here.outside2) return beyond;
    return std::nullopt;
  }

  /// Whether the facet's open diametral ball holds no sample point: it holds
  /// none exactly if neither cell has its apex there. Exact.
  ///
  /// With centres d apart and radii R, S, the heights of the centres over the
  /// facet, each towards its cell, are (d^2 + R^2 - S^2) / 2d and
  /// (d^2 - R^2 + S^2) / 2d: an apex lies in the ball where one is negative.
  bool is_gabriel(delaunay::Facet f) const {
    const delaunay::Cell& a = triangulation_->cell(f.cell());
    const delaunay::Cell& b = opposite(f);
    const double x = a.center[0] - b.center[0];
    const double y = a.center[1] - b.center[1];
    const double z = a.center[2] - b.center[2];
    const Bracket R(a), S(b);
    const double excess =
        2 * (x * x + y * y + z * z) - std::abs(R.twice_middle - S.twice_middle);
    const double error = R.error + S.error;
    // Where a sphere is not known, no comparison holds.
    if (std::abs(excess) > error) [[likely]]
      return excess > 0;
    return is_gabriel_exact(f);
  }

  /// Whether the cell's vertex opposite the facet lies outside the facet's
  /// open diametral ball. Exact. True beyond the hull.
  bool apex_outside_diametral_ball(delaunay::Facet f) const;

  /// Power of two by which coordinates are multiplied before they are squared,
  /// so that no square overflows: the largest coordinate is then about 1.
  double scale() const { return scale_; }

 private:
  /// What a cell's cached sphere says about its squared radius.
  struct Bracket {
    explicit Bracket(const delaunay::Cell& cell)
        : twice_middle(static_cast<double>(cell.inside2) + cell.outside2),
          error(kCachedError * cell.outside2 + cell.outside2 - cell.inside2) {}
    double twice_middle;
    double error;
  };
  /// Proof in docs/math.md, "Gabriel triangles from two spheres".
  static constexpr double kCachedError = 0x1p-19;

  const delaunay::Cell& opposite(delaunay::Facet f) const {
    const delaunay::Facet beyond =
        triangulation_->cell(f.cell()).neighbor[f.index()];
    return triangulation_->cell(beyond.cell());
  }
  bool is_gabriel_exact(delaunay::Facet f) const;

  const delaunay::Triangulation3* triangulation_;
  double scale_;
};

}  // namespace umbrella
