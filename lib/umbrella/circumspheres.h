/// @file
/// Circumspheres of all cells of a triangulation: their radii, and on which
/// side of each facet their centres lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/triangulation3.h"

namespace umbrella {

/// Computed once for a triangulation; every lambda-interval is read off it.
class Circumspheres {
 public:
  /// @param triangulation  must outlive this object
  explicit Circumspheres(const delaunay::Triangulation3& triangulation);

  /// Square of the circumradius of a cell, in the squared unit of
  /// 1 / scale(); relative error below 2^-31, and the same for a set of
  /// points however their cells are numbered. Infinite beyond the hull.
  double squared_radius(delaunay::CellId c) const {
    return squared_radius_[index(c)];
  }

  /// Whether the cell's vertex opposite the facet lies outside the facet's
  /// open diametral ball; equally, whether the cell's centre does not lie
  /// strictly beyond the facet. Exact. True beyond the hull.
  bool apex_outside_diametral_ball(delaunay::Facet f) const {
    return (apex_outside_[index(f.cell())] >> f.index() & 1U) != 0;
  }

  /// Power of two by which coordinates are multiplied before they are squared,
  /// so that no square overflows: the largest coordinate is then about 1.
  double scale() const { return scale_; }

 private:
  void add_cells(const delaunay::Triangulation3& triangulation,
                 std::size_t first, std::size_t n);

  std::vector<double> squared_radius_;
  std::vector<std::uint8_t> apex_outside_;  // bit i: facet i
  double scale_ = 1;
};

}  // namespace umbrella
