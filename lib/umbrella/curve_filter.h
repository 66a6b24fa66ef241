/// @file
/// The filter in the plane: an umbrella of a vertex is two edges, and the best
/// are the two Gabriel edges with the smallest lower lambda bound.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/triangulation2.h"

namespace umbrella {

/// Ends in ascending order.
using Edge = std::array<delaunay::VertexId, 2>;

/// An edge of the triangulation and its lambda-interval [Adamy02, Def. 2.1].
struct DelaunayEdge {
  Edge ends;
  /// The smaller sine of the two angles opposite the edge, 0 beyond the hull:
  /// |e| / (2 R_i) by the law of sines. Relative error below 2^-50, or
  /// absolute below 2^-100 where that is more.
  double lambda_lower = 0;
  double length = 0;  ///< infinite if it overflows
  /// No point in the open diametral disc, exactly; lambda's upper bound is 1.
  bool is_gabriel = false;
};

/// The order of edges: lower lambda, then length, then ends. It depends on the
/// set of points alone, as VertexIds do.
bool ranks_before(const DelaunayEdge& a, const DelaunayEdge& b);

/// All edges, by ascending ends; none if the points are collinear.
std::vector<DelaunayEdge> delaunay_edges(
    const delaunay::Triangulation2& triangulation);

struct CurveFilterResult {
  std::vector<Edge> edges;   ///< picked by one end at least, ascending
  std::vector<Edge> agreed;  ///< picked by both ends, ascending
  /// Vertices with fewer than two Gabriel edges: they pick none. Ascending.
  std::vector<delaunay::VertexId> without_umbrella;
};

/// At each vertex the first two Gabriel edges in the order of ranks_before()
/// [Adamy02, Sec. 3.1].
///
/// @param n_vertices  all ends are below it
/// @param edges  distinct, in any order
CurveFilterResult curve_filter(std::size_t n_vertices,
                               std::span<const DelaunayEdge> edges);

}  // namespace umbrella
