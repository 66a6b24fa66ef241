/// @file
/// Some cells of a triangulation, as a triangulation of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"

namespace delaunay {

/// A copy of some finite cells and their corners. Vertices keep their order,
/// and cells are numbered as in CanonicalCells: as if the others were left out
/// there. Where the window ends, a cell beyond lies across each facet; it is an
/// infinite cell, whatever the original has there. A walk around a vertex is
/// right if all its finite cells are in the window, around no other.
class CellWindow {
 public:
  /// @param original  must outlive this object
  /// @param cells  finite ones, distinct, in any order
  CellWindow(const Triangulation3& original, std::span<const CellId> cells);

  const Triangulation3& triangulation() const { return triangulation_; }
  /// Of a vertex of the window. Both ways keep the order.
  VertexId to_original(VertexId v) const { return vertices_[index(v)]; }
  /// @pre a corner of some of the cells
  VertexId from_original(VertexId v) const {
    return VertexId{number_of_[index(v)]};
  }
  bool has_cell(CellId original) const {
    return copy_of_[index(original)] != kNone;
  }
  /// @pre has_cell()
  CellId copy_of(CellId original) const {
    return CellId{copy_of_[index(original)]};
  }
  /// Of a cell that the window has, or of one beyond: then the cell across its
  /// facet with finite corners.
  CellId original_of(CellId copy) const { return original_of_[index(copy)]; }
  /// The facet of the copy for one of a cell that the window has, and back.
  Facet from_original(Facet f) const;
  Facet to_original(Facet f) const;

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  void number_vertices(std::span<const CellId> cells);
  void number_cells(std::span<const CellId> cells);
  void copy_cells();
  void add_cells_beyond();
  void add_cell_beyond(Facet facet);
  void link_cells_beyond();
  Facet beyond_original(Facet facet) const;

  const Triangulation3& original_;
  Triangulation3 triangulation_;
  std::vector<VertexId> vertices_;        // of the original; ascending
  std::vector<std::uint32_t> number_of_;  // by vertex of the original
  std::vector<std::uint32_t> copy_of_;    // by cell of the original
  std::vector<CellId> original_of_;       // by cell of the copy
};

}  // namespace delaunay
