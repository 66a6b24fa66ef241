/// @file
/// The filter in the plane for many points: what curve_filter() picks, without
/// a list of all edges.
#pragma once

#include <array>
#include <vector>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

/// The first two Gabriel edges of each vertex, in the order of lambda, then
/// length, then ends. Lambda is rounded as doubles are: near ties may be
/// ordered otherwise than by ranks_before().
struct PickedEdges {
  /// The other ends; kNone where a vertex has fewer than two Gabriel edges.
  std::vector<std::array<delaunay::VertexId, 2>> others;
  /// Squares of the lower lambda bounds; 2 where there is no edge.
  std::vector<std::array<double, 2>> lambda2;
  std::size_t n_gabriel = 0;  ///< edges to pick from
};

PickedEdges pick_edges(const delaunay::Triangulation2& triangulation);

/// The edges that both ends have picked.
CurveLinks agreed_links(const PickedEdges& picked);

}  // namespace umbrella
