/// @file
/// The part of a triangulation that closing by cell labels has to look at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/cell_window.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// All cells at the open vertices, at those without a triangle, and at what is
/// within kRings Delaunay edges of them. The rest of the surface is closed and
/// manifold, and stays as it is.
class LabelWindow {
 public:
  static constexpr unsigned kRings = 3;

  /// @param kept  by ascending corners, not empty; must outlive this object
  /// @param open  ascending
  LabelWindow(const delaunay::Triangulation3& whole,
              std::span<const LocatedTriangle> kept,
              std::span<const VertexId> open);

  /// Whether it is small. If not, there is nothing in it.
  bool is_small() const { return cells_.has_value(); }

  const delaunay::Triangulation3& triangulation() const {
    return cells_->triangulation();
  }
  /// In terms of the window: kept triangles with a cell in it, open vertices,
  /// those with cells outside.
  std::span<const LocatedTriangle> kept() const { return kept_; }
  std::span<const VertexId> open() const { return open_; }
  std::span<const VertexId> border() const { return border_; }

  bool is_beyond_hull(delaunay::CellId beyond) const {
    return whole_.cell(cells_->original_of(beyond)).is_infinite();
  }
  /// Where a way outside the window ends, across triangles with corners far
  /// from open vertices.
  struct End {
    std::optional<delaunay::CellId> cell;  ///< of the window; none: the hull
    std::uint32_t parity;                  ///< of kept triangles on the way
  };
  static constexpr unsigned kDirections = 6;
  /// @param beyond  a cell beyond the window, where it begins
  std::optional<End> way_out(delaunay::CellId beyond, unsigned direction) const;

  /// Kept triangles outside the window with these of the window; both ascend.
  std::vector<LocatedTriangle> with_rest(
      std::span<const LocatedTriangle> triangles) const;
  VertexId to_original(VertexId v) const { return cells_->to_original(v); }

 private:
  enum class Mark : std::uint8_t { None, Near, Border };

  std::vector<delaunay::CellId> mark_centre(std::span<const VertexId> open);
  delaunay::CellId cell_at(VertexId v) const;
  bool find_cells(std::vector<delaunay::CellId>& cells);
  void enter(delaunay::CellId c, std::vector<delaunay::CellId>& cells);
  void enter_neighbors(delaunay::CellId c,
                       std::vector<delaunay::CellId>& cells);
  void locate_kept();
  delaunay::Facet in_lower_cell(delaunay::Facet f) const;
  delaunay::Facet original_in_lower_cell(delaunay::Facet f) const;
  bool is_kept(const Triangle& corners) const;
  bool is_near(const Triangle& corners) const;
  Point3 far_point(delaunay::CellId from, unsigned direction) const;
  std::optional<unsigned> facet_towards(const delaunay::Cell& cell,
                                        const Point3& point) const;

  const delaunay::Triangulation3& whole_;
  std::span<const LocatedTriangle> all_kept_;
  std::vector<Mark> marks_;           // by vertex of the whole
  std::vector<std::uint8_t> is_met_;  // by cell of the whole
  std::optional<delaunay::CellWindow> cells_;
  std::vector<LocatedTriangle> kept_;
  std::vector<std::size_t> place_of_kept_;  // among all that are kept
  std::vector<VertexId> open_, border_;
  std::array<Point3, 2> box_;  // about all points
};

}  // namespace umbrella
