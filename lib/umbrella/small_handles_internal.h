/// @file
/// Handles that are too small for the sampling to mean them.
#pragma once

#include <cstddef>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/closing.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Where a loop of at most options.handle_edges edges goes round a handle,
/// looks for the best surface about it through the same points without the
/// handle: with all points used, one handle less is four triangles less.
/// Components stay as many.
///
/// @param triangles  of a closed manifold surface, by ascending corners;
///   changed where handles go
/// @return how many went
std::size_t remove_small_handles(const delaunay::Triangulation3& triangulation,
                                 const ClosingOptions& options,
                                 std::vector<LocatedTriangle>& triangles);

}  // namespace umbrella
