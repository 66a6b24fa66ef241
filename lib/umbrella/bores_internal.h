/// @file
/// Bores that a closed surface has lids on.
#pragma once

#include <cstddef>

#include "delaunay/triangulation3.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/closing.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

struct OpenedBores {
  std::size_t count = 0;
  Spent spent;
};

/// Takes the lids off bores (find_lidded_bores). A wall is put between the ends
/// of each, and the face about them where it has been lost, if a program about
/// them has such a solution: a handle more, in as many pieces. Goes on as long
/// as one is opened.
///
/// A mesh that a designer has made holds no corner within a flat face. One that
/// a scan has made holds many, but not on a circle about nothing.
///
/// @param options  all programs together may take the propagations of one
/// region
///   of all points, and the conflicts of three
/// @param surface  closed and manifold; changed where a bore was opened
OpenedBores open_bores(const delaunay::Triangulation3& triangulation,
                       const ClosingOptions& options, WorkingSurface& surface);

}  // namespace umbrella
