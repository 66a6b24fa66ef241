/// @file
/// CGAL's planar Delaunay triangulation, as a peer.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "bench/seconds.h"

namespace bench {

struct CgalDelaunay2 {
  std::size_t n_finite_cells;
  Seconds seconds;  ///< of the construction alone, without copying the points
};

/// Delaunay_triangulation_2 with the kernel of exact predicates and inexact
/// constructions, and the range constructor.
CgalDelaunay2 cgal_delaunay2(std::span<const Eigen::Vector2d> points);

}  // namespace bench
