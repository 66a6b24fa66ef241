/// @file
/// CGAL's Delaunay triangulation, as a peer.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "bench/seconds.h"

namespace bench {

struct CgalDelaunay3 {
  std::size_t n_finite_cells;
  Seconds seconds;  ///< of the construction alone, without copying the points
};

/// Delaunay_triangulation_3 with compact location, the kernel of exact
/// predicates and inexact constructions, and the range constructor.
CgalDelaunay3 cgal_delaunay3(std::span<const Eigen::Vector3d> points);

}  // namespace bench
