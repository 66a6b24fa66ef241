/// @file
/// What is solved as one program: vertices, and the Delaunay triangles that may
/// cover them.
#pragma once

#include <cstddef>
#include <cstdint>
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
  explicit CellSet(const delaunay::Triangulation3& triangulation);

  /// Puts the cells at these vertices in place of those before.
  void collect(std::span<const VertexId> vertices);

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

 private:
  bool is_there(delaunay::CellId c) const {
    const std::uint32_t place = place_[index(c)];
    return place < cells_.size() && cells_[place] == c;
  }
  void enter(delaunay::CellId c);
  void enter_neighbors(const delaunay::Cell& cell);

  const delaunay::Triangulation3& triangulation_;
  std::vector<delaunay::CellId> cell_of_vertex_;
  std::vector<delaunay::CellId> cells_;
  /// Of a cell within the hull: where it is in `cells_`, if it is there.
  std::vector<std::uint32_t> place_;
  std::vector<std::uint8_t> is_wanted_;  // by vertex, zero between calls
};

/// Walks about the vertices of a triangulation.
class Neighborhoods {
 public:
  explicit Neighborhoods(const delaunay::Triangulation3& triangulation);

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
