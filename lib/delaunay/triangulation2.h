/// @file
/// Delaunay triangulation of points in R^2 by exact predicates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/ids.h"
#include "delaunay/lazy_vector.h"

namespace delaunay {

using Point2 = Eigen::Vector2d;

/// A triangle seen through one of its sides, in 32 bits.
class Side {
 public:
  Side() = default;
  constexpr Side(CellId cell, unsigned index)
      : bits_((static_cast<std::uint32_t>(cell) << 2) | index) {}
  constexpr CellId cell() const { return CellId{bits_ >> 2}; }
  /// The side is the one opposite this corner of the triangle, 0 to 2.
  constexpr unsigned index() const { return bits_ & 3U; }
  friend constexpr bool operator==(Side, Side) = default;

 private:
  std::uint32_t bits_ = 0;
};

/// Triangle with orient2d(v0, v1, v2) > 0; `neighbor[i]` is the side opposite
/// vertex[i], seen from the triangle across it. A triangle beyond the hull has
/// vertex[2] == kInfinite, and would be positive with any point strictly
/// beyond the hull edge v0 v1 in its place.
struct Cell2 {
  std::array<VertexId, 3> vertex;
  std::array<Side, 3> neighbor;

  bool is_infinite() const { return vertex[2] == kInfinite; }
};

/// Corners of side i of a positive triangle, counter-clockwise around it.
inline constexpr std::array<std::array<unsigned, 2>, 3> kSideCorners = {
    {{1, 2}, {2, 0}, {0, 1}}};

class Triangulation2 {
 public:
  /// Bowyer-Watson insertion along a Hilbert curve; the same set of points
  /// gives the same triangulation with the same numbers, whatever their order.
  ///
  /// @param points  any unit, duplicates allowed, at most max_points()
  /// @throws std::invalid_argument  a coordinate is not finite (names the row)
  ///   or there are too many points
  explicit Triangulation2(std::span<const Point2> points);

  static constexpr std::size_t max_points() { return std::size_t{1} << 28U; }

  /// -1 (no point) to 2; below 2 there are no cells, and that is no error.
  int dimension() const { return dimension_; }

  /// Distinct points, along a Hilbert curve: an order that depends on the
  /// set of points alone. VertexIds are positions in it.
  std::span<const Point2> points() const { return points_; }
  const Point2& point(VertexId v) const { return points_[index(v)]; }

  /// The vertex of each input row; rows with equal coordinates share one.
  std::span<const VertexId> vertex_of_row() const { return vertex_of_row_; }

  /// Cells inside the hull come first, n_finite_cells() of them.
  std::span<const Cell2> cells() const { return cells_; }
  std::size_t n_finite_cells() const { return n_finite_cells_; }
  const Cell2& cell(CellId c) const { return cells_[index(c)]; }

 private:
  LazyVector<Point2> points_;
  std::vector<VertexId> vertex_of_row_;
  LazyVector<Cell2> cells_;
  std::size_t n_finite_cells_ = 0;
  int dimension_ = -1;
};

}  // namespace delaunay
