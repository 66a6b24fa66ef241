/// @file
/// Which points hang together, by their spacing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/triangle.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Points are in one group if Delaunay edges lead from one to the other that
/// are at most twice as long as the longest edge of the triangles at either
/// end, or than the longest of all at a point without triangles.
class PointGroups {
 public:
  /// Groups are found when first asked for.
  /// @param triangulation, triangles  must outlive this object
  /// @param surface  likewise; serves to find a cell at a vertex, whatever has
  ///   become of the triangles
  PointGroups(const delaunay::Triangulation3& triangulation,
              std::span<const RankedTriangle> triangles,
              const WorkingSurface& surface)
      : triangulation_(triangulation),
        triangles_(triangles),
        surface_(surface) {}

  /// How many points the groups of these have together. May be called by
  /// several threads.
  std::size_t n_points_with(std::span<const VertexId> vertices);

 private:
  void find();
  DisjointSets corner_sets() const;
  std::vector<delaunay::CellId> cells_between(DisjointSets& sets) const;
  std::vector<double> squared_reach(
      std::span<const delaunay::CellId> cells) const;

  const delaunay::Triangulation3& triangulation_;
  std::span<const RankedTriangle> triangles_;
  const WorkingSurface& surface_;
  std::once_flag is_found_;
  std::vector<std::uint32_t> group_;     // by vertex: the first of the group
  std::vector<std::uint32_t> n_points_;  // by first vertex
};

}  // namespace umbrella
