/// @file
/// Delaunay triangulation of points in R^3 by exact predicates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/counters.h"
#include "delaunay/ids.h"
#include "delaunay/lazy_vector.h"

namespace delaunay {

using Point3 = Eigen::Vector3d;

/// A cell seen through one of its facets, in 32 bits.
class Facet {
 public:
  Facet() = default;
  constexpr Facet(CellId cell, unsigned index)
      : bits_((static_cast<std::uint32_t>(cell) << 2) | index) {}
  constexpr CellId cell() const { return CellId{bits_ >> 2}; }
  /// The facet is the one opposite this corner of the cell, 0 to 3.
  constexpr unsigned index() const { return bits_ & 3U; }
  friend constexpr bool operator==(Facet, Facet) = default;

 private:
  std::uint32_t bits_ = 0;
};

/// Tetrahedron with orient3d(v0, v1, v2, v3) > 0; `neighbor[i]` is the facet
/// opposite vertex[i], seen from the cell on its other side. A cell beyond the
/// hull has vertex[3] == kInfinite, and would be positive with any point
/// strictly beyond the hull facet v0 v1 v2 in its place.
struct alignas(64) Cell {
  std::array<VertexId, 4> vertex;
  std::array<Facet, 4> neighbor;
  /// Circumcentre, times 2^Triangulation3::scale_exponent() in input units;
  /// meaningful where outside2 is finite (then its error is below 2^-24 of
  /// the radius), which it is not for flat or infinite cells.
  std::array<double, 3> center;
  float inside2;   ///< squared distance to center below this: certainly inside
  float outside2;  ///< squared distance to center above this: certainly outside

  bool is_infinite() const { return vertex[3] == kInfinite; }
};

/// Corners of facet i of a positive cell, counter-clockwise seen from
/// outside the cell (from across the facet).
inline constexpr std::array<std::array<unsigned, 3>, 4> kFacetCorners = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

class Triangulation3 {
 public:
  /// Bowyer-Watson insertion along a Hilbert curve; the same set of points
  /// gives the same triangulation, whatever their order and the number of
  /// threads. How cells are numbered, which even permutation of its corners a
  /// cell holds and how its sphere is rounded depends on the set of points and
  /// the number of threads alone.
  ///
  /// @param points  any unit, duplicates allowed, at most max_points()
  /// @param threads  at most so many
  /// @throws std::invalid_argument  a coordinate is not finite (names the row)
  ///   or there are too many points
  /// @throws std::length_error  there are over 2^30 cells, infinite ones among
  ///   them; with max_points() that is 8 a point
  explicit Triangulation3(std::span<const Point3> points, unsigned threads = 1);

  static constexpr std::size_t max_points() { return std::size_t{1} << 27U; }

  /// -1 (no point) to 3; below 3 there are no cells, and that is no error.
  int dimension() const { return dimension_; }

  /// Distinct points, along a Hilbert curve: an order that depends on the
  /// set of points alone. VertexIds are positions in it.
  std::span<const Point3> points() const { return points_; }
  const Point3& point(VertexId v) const { return points_[index(v)]; }

  /// The vertex of each input row; rows with equal coordinates share one.
  std::span<const VertexId> vertex_of_row() const { return vertex_of_row_; }

  /// Cells inside the hull come first, n_finite_cells() of them.
  std::span<const Cell> cells() const { return cells_; }
  std::size_t n_finite_cells() const { return n_finite_cells_; }
  const Cell& cell(CellId c) const { return cells_[index(c)]; }

  /// See Cell::center.
  int scale_exponent() const { return scale_exponent_; }

  /// All 0 unless the build counts.
  const Counters& counters() const { return counters_; }

 private:
  friend class CanonicalCells;  // copies, and numbers the cells of the copy
  friend class CellWindow;      // the same with some of the cells

  LazyVector<Point3> points_;
  std::vector<VertexId> vertex_of_row_;
  LazyVector<Cell> cells_;
  std::size_t n_finite_cells_ = 0;
  Counters counters_;
  int scale_exponent_ = 0;
  int dimension_ = -1;
};

}  // namespace delaunay
