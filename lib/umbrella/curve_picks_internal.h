/// @file
/// The filter in the plane for many points: what curve_filter() picks, without
/// a list of all edges.
#pragma once

#include <array>
#include <vector>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

/// A Gabriel edge as one of its ends sees it.
struct CurvePick {
  delaunay::VertexId other = CurveLinks::kNone;
  double lambda2 = 0;  ///< square of the lower lambda bound
  double length2 = 0;  ///< square of the length
};

/// The first two Gabriel edges of each vertex, in the order of lambda, then
/// length, then ends. Lambda is rounded as doubles are: near ties may be
/// ordered otherwise than by ranks_before().
using CurvePicks = std::vector<std::array<CurvePick, 2>>;

struct PickedEdges {
  CurvePicks picks;
  std::size_t n_gabriel = 0;  ///< edges to pick from
};

PickedEdges pick_edges(const delaunay::Triangulation2& triangulation);

/// The edges that both ends have picked.
CurveLinks agreed_links(const CurvePicks& picks);

}  // namespace umbrella
