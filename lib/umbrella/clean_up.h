/// @file
/// Topological clean-up [Adamy02, Sec. 3.2]: after it each vertex has exactly
/// one umbrella, which holds all its triangles, or none.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "umbrella/rank_order.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct CleanUpOptions {
  /// Closed pieces of at most this many triangles are dissolved at the end:
  /// mostly tetrahedra that block their surroundings.
  std::size_t largest_dissolved = 12;
};

struct CleanUpResult {
  std::vector<RankedTriangle> triangles;   ///< what is left, in input order
  std::vector<RankedTriangle> deleted;     ///< the others, in input order
  std::vector<VertexId> without_umbrella;  ///< ascending
  std::size_t n_type2 = 0;                 ///< deleted as type 2
  std::size_t n_type3 = 0;                 ///< deleted as type 3
  std::size_t n_dissolved = 0;             ///< deleted with a small piece
};

/// A triangle t is in an umbrella at its corner v if its edge in the graph G_v
/// is no bridge. It is of type 2 if v has an umbrella but none with t, of type
/// 3 if it is in an umbrella at v and the non-bridges of G_v are more than one
/// simple cycle.
///
/// Deletes all triangles of type 2 at once, and again until there is none; then
/// the one of type 3 that ranks last; and repeats both.
///
/// @param n_vertices  all ids in `triangles` are below it
/// @param triangles  quickest if moved here
/// @param unsettled  vertices at which there are other triangles than those of
///   one umbrella, or none; ascending. All may be, if nobody knows
CleanUpResult clean_up(
    std::size_t n_vertices, RankedTriangles triangles,
    const CleanUpOptions& options = {},
    const std::optional<std::vector<VertexId>>& unsettled = {});

}  // namespace umbrella
