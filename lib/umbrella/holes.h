/// @file
/// The places where the cleaned triangles are no surface yet.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "umbrella/triangle.h"

namespace umbrella {

/// Vertices to be covered anew together; all ascending.
struct Hole {
  /// Without umbrella, and joined by edges at which exactly one triangle is
  /// left.
  std::vector<VertexId> core;
  /// The core, and every vertex that a deleted triangle joins to it in one
  /// step. Holes may share such vertices.
  std::vector<VertexId> vertices;
};

/// The holes [Adamy02, Sec. 3.2], by their smallest core vertex. The step over
/// deleted triangles leads to vertices with an umbrella as well: without them
/// most holes of a hard scan cannot be closed, docs/umbrella.md "Holes".
///
/// @param n_vertices  all ids below are less than it
/// @param triangles  what the clean-up has left
/// @param deleted  what it has deleted
/// @param without_umbrella  vertices, ascending
std::vector<Hole> find_holes(std::size_t n_vertices,
                             std::span<const RankedTriangle> triangles,
                             std::span<const RankedTriangle> deleted,
                             std::span<const VertexId> without_umbrella);

}  // namespace umbrella
