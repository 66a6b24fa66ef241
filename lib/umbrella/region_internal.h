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

/// a with b; ascending both.
std::vector<VertexId> united(std::span<const VertexId> a,
                             std::span<const VertexId> b);

/// Walks about the vertices of a triangulation.
class Neighborhoods {
 public:
  explicit Neighborhoods(const delaunay::Triangulation3& triangulation);

  /// The candidate triangles of a region, by ascending corners.
  std::vector<LocatedTriangle> candidates(const Region& region);

  /// Vertices joined to one of these by a Delaunay edge, and these; ascending.
  std::vector<VertexId> ring(std::span<const VertexId> vertices);

 private:
  void collect_cells(std::span<const VertexId> vertices);
  void collect_star(VertexId v);

  const delaunay::Triangulation3& triangulation_;
  std::vector<delaunay::CellId> cell_of_vertex_;
  /// Of a cell; side by side, for they are looked up together.
  struct Marks {
    std::uint32_t call = 0;  // the last that met it
    std::uint32_t star = 0;  // the last that met it
  };
  std::vector<Marks> marks_;
  std::uint32_t n_calls_ = 0;
  std::uint32_t n_stars_ = 0;
  std::vector<delaunay::CellId> cells_;  // last collected, all within the hull
  std::vector<delaunay::CellId> stack_;
  std::vector<std::uint8_t> mark_;  // of vertices, zero between calls
};

}  // namespace umbrella
