/// @file
/// What the closing minimises first.
#pragma once

#include <array>

#include "delaunay/triangulation3.h"
#include "umbrella/closing.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// How bad the triangles of a triangulation are, by a weight.
class Badness {
 public:
  /// @param triangulation  must outlive this object
  Badness(const delaunay::Triangulation3& triangulation, CloseWeight weight);

  /// The larger, the worse; in a unit of its own.
  /// @param facet  one of the two that are this triangle
  double operator()(const Triangle& corners, delaunay::Facet facet) const;

  /// No triangle has less.
  double least() const { return weight_ == CloseWeight::BallOverlap ? -1 : 0; }

 private:
  double ball_overlap(const std::array<Point3, 3>& abc,
                      delaunay::Facet facet) const;
  double squared_lambda_lower(const std::array<Point3, 3>& abc,
                              delaunay::Facet facet) const;

  const delaunay::Triangulation3& triangulation_;
  CloseWeight weight_;
  double scale_;
};

}  // namespace umbrella
