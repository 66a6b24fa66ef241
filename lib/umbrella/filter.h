/// @file
/// UMBRELLAFILTER [Adamy02, Sec. 3]: at each vertex the umbrella whose worst
/// triangle is best.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "umbrella/rank_order.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct FilterResult {
  /// Union of the umbrellas of all vertices, in the order of the input.
  RankedTriangles triangles;
  /// Vertices around which no admissible triangles close, ascending. They
  /// choose nothing.
  std::vector<VertexId> without_umbrella;
  /// Vertices at which there are other triangles than those of one umbrella, or
  /// none, ascending; none if nobody knows.
  std::optional<std::vector<VertexId>> unsettled;
};

/// Takes the triangles at each vertex v in their order until they hold an
/// umbrella: a cycle in the graph G_v, which joins p and q for
/// each triangle v p q. One edge closes the first cycle, so the umbrella is
/// unique; the other triangles taken at v are dropped again.
///
/// @param n_vertices  all ids in `triangles` are below it
/// @param triangles  in any order; quickest if moved here, and with
///   ascending first corners
/// @param threads  at most so many, with the same result for any number
FilterResult umbrella_filter(std::size_t n_vertices, RankedTriangles triangles,
                             unsigned threads = 1);

}  // namespace umbrella
