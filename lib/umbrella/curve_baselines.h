/// @file
/// Reconstructions of curves by others, to compare with. Each gives edges of
/// the Delaunay triangulation, ascending; decisions are by rounded lengths and
/// angles where nothing else is said. Gabriel graphs and beta-skeletons are in
/// plane_complexes.h.
#pragma once

#include <vector>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_filter.h"

namespace umbrella {

/// Edges between samples in the Delaunay triangulation of the samples and of
/// their Voronoi vertices [Amenta98, Sec. 2].
std::vector<Edge> crust(const delaunay::Triangulation2& samples);

/// Each vertex to its nearest neighbour q and to the nearest r under an angle
/// of more than 90 degrees to q [Dey99].
std::vector<Edge> nn_crust(const delaunay::Triangulation2& samples);

/// The same, with r on the vertex's side of the bisector between it and q: the
/// angle may be as low as 60 degrees [Ohrhallinger16, Sec. 4].
std::vector<Edge> hnn_crust(const delaunay::Triangulation2& samples);

}  // namespace umbrella
