/// @file
/// What is solved as one program: vertices, and the Delaunay triangles that may
/// cover them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/holes.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

struct Region {
  /// A Delaunay triangle with all corners among these is a candidate.
  std::vector<VertexId> vertices;
  /// So is one with `reach` corners among these, wherever the others lie.
  std::vector<VertexId> stuck;
  unsigned reach = 3;
};

/// The holes, those put together that share a vertex or all corners of a
/// triangle of the surface. By their smallest vertex.
std::vector<Region> merge_holes(std::span<const Hole> holes,
                                const WorkingSurface& surface);

/// The vertices of a region and of its candidates; ascending.
std::vector<VertexId> vertices_of(const Region& region,
                                  std::span<const LocatedTriangle> candidates);

/// a with b; ascending both.
std::vector<VertexId> united(std::span<const VertexId> a,
                             std::span<const VertexId> b);

/// Cells at some vertices, all within the hull, and in an order that depends on
/// how the triangulation numbers them.
class CellSet {
 public:
  /// @param surface  knows a cell at most vertices; both must outlive this
  CellSet(const delaunay::Triangulation3& triangulation,
          const WorkingSurface& surface);

  /// Puts the cells at these vertices in place of those before.
  void collect(std::span<const VertexId> vertices);
  /// Calls visit(id, cell) for each of them. Defined in region.cpp, for it
  /// alone.
  template <class Visit>
  void collect(std::span<const VertexId> vertices, Visit visit);

  std::span<const delaunay::CellId> cells() const { return cells_; }
  const delaunay::Cell& cell(std::uint32_t position) const {
    return triangulation_.cell(cells_[position]);
  }
  /// Where the cell is in cells(); for all beyond the hull cells().size(); for
  /// others the largest number.
  std::uint32_t position(delaunay::CellId c) const;
  /// The same triangle from its other cell.
  delaunay::Facet opposite(delaunay::Facet facet) const {
    return triangulation_.cell(facet.cell()).neighbor[facet.index()];
  }
  VertexId apex(delaunay::Facet facet) const {
    return triangulation_.cell(facet.cell()).vertex[facet.index()];
  }

 private:
  enum class Mark : std::uint8_t { None, Wanted, Met };

  bool is_finite(delaunay::CellId c) const {
    return index(c) < triangulation_.n_finite_cells();
  }
  std::size_t slot(delaunay::CellId c) const;
  void enter(delaunay::CellId c, unsigned from);
  template <class Visit>
  void enter_all_from(delaunay::CellId c, Visit visit);
  void enter_neighbors(const delaunay::Cell& cell, unsigned from);
  void widen();
  std::optional<delaunay::CellId> cell_on_surface(VertexId v) const;
  delaunay::CellId cell_by_walk(VertexId v) const;
  delaunay::CellId cell_near(VertexId v) const;
  bool is_beyond(const delaunay::Cell& cell, unsigned i, VertexId v) const;

  const delaunay::Triangulation3& triangulation_;
  const WorkingSurface& surface_;
  static constexpr unsigned kNowhere = 4;
  std::vector<delaunay::CellId> cells_;
  std::vector<std::uint8_t> from_;    // by position: facet that led there
  std::size_t n_done_ = 0;            // whose neighbors were looked at
  std::vector<std::uint32_t> slots_;  // hashed positions in `cells_`
  std::vector<Mark> marks_;           // by vertex, none between calls
};

/// Walks about the vertices of a triangulation.
class Neighborhoods {
 public:
  Neighborhoods(const delaunay::Triangulation3& triangulation,
                const WorkingSurface& surface);

  /// The candidate triangles of a region, by ascending corners.
  std::vector<LocatedTriangle> candidates(const Region& region);

  /// Those at the vertices of the last call of one of these.
  const CellSet& cells() const { return cells_; }

  /// Vertices joined to one of these by a Delaunay edge, and these; ascending.
  std::vector<VertexId> ring(std::span<const VertexId> vertices);

 private:
  const delaunay::Triangulation3& triangulation_;
  CellSet cells_;
  std::vector<std::uint8_t> mark_;  // of vertices, zero between calls
};

}  // namespace umbrella
