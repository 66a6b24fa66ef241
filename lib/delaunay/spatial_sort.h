/// @file
/// Distinct points along a Hilbert curve, and the rounds in which an
/// incremental construction inserts them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/ids.h"
#include "delaunay/lazy_vector.h"

namespace delaunay {

/// The distinct points of an input in an order that depends on them alone, not
/// on their rows.
template <int kDim>
struct SpatialOrder {
  /// Along a Hilbert curve through the bounding cube; points of one curve cell
  /// by coordinates, x first.
  LazyVector<Eigen::Matrix<double, kDim, 1>> points;
  /// For each input row, its position in `points`; duplicates share one. -0
  /// and 0 are equal, and `points` holds 0.
  std::vector<VertexId> vertex_of_row;
};

/// The same on any number of threads.
///
/// @throws std::invalid_argument  a coordinate is not finite (names the row)
SpatialOrder<2> spatial_order(std::span<const Eigen::Vector2d> points,
                              unsigned threads = 1);
SpatialOrder<3> spatial_order(std::span<const Eigen::Vector3d> points,
                              unsigned threads = 1);

/// The first input row of each point.
///
/// @param vertex_of_row  as in SpatialOrder, of `n_points` points
std::vector<std::uint32_t> first_rows(std::size_t n_points,
                                      std::span<const VertexId> vertex_of_row);

/// Biased randomised insertion order [Amenta03]: 0 .. n-1 cut into rounds of
/// growing size, each round a pseudo-random subset in ascending order.
/// Depends on the arguments alone.
///
/// @param log2_growth  a round and those before it together hold 2^log2_growth
///   times the vertices of those before it
/// @pre log2_growth > 0
std::vector<VertexId> insertion_order(std::size_t n, unsigned log2_growth = 3);

}  // namespace delaunay
