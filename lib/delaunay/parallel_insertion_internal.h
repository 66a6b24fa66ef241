/// @file
/// All insertions of a 3D triangulation, on one thread or several.
#pragma once

#include <array>
#include <cstddef>

#include "delaunay/mesh3_internal.h"

namespace delaunay {

struct InsertionOptions {
  static constexpr unsigned kMaxThreads = 255;

  unsigned threads = 1;  // at most kMaxThreads
  /// As many vertices of a round for each thread at least; fewer are not
  /// worth its start.
  std::size_t min_vertices = 4096;
};

/// Fills an empty mesh.
///
/// @param first  four vertices that span space
/// @return how many cells, the first ones, lie inside the hull
std::size_t insert_all(Mesh3& mesh, const std::array<VertexId, 4>& first,
                       const InsertionOptions& options);

}  // namespace delaunay
