/// @file
/// How far apart points are along a curve, near each of them.
#pragma once

#include <span>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_graph_internal.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

/// The lower median length of the links at most three steps from v; 0 if there
/// are fewer than two.
double link_spacing(const delaunay::Triangulation2& t, const CurveLinks& links,
                    delaunay::VertexId v);

/// link_spacing(), or where that is 0 the one of the nearest Delaunay neighbour
/// that has one, or the distance to the nearest neighbour. Positive.
double spacing(CurveGraph& graph, const CurveLinks& links,
               delaunay::VertexId v);

/// The median of link_spacing() where it is known; 0 if nowhere. From some 10^4
/// vertices, or all.
double typical_spacing(const delaunay::Triangulation2& t,
                       const CurveLinks& links);

/// How uneven the spacing is: nine of ten links are at most so many times as
/// long as the spacing at their ends. In [1, 100]; from some 10^4 links, or
/// all.
double spread(const delaunay::Triangulation2& t, const CurveLinks& links);

}  // namespace umbrella
