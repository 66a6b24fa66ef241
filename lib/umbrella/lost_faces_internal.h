/// @file
/// Flat faces that a closed surface has lost.
#pragma once

#include <cstddef>

#include "delaunay/triangulation3.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/closing.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

struct RegainedFaces {
  std::size_t count = 0;
  Spent spent;
};

/// Puts flat faces with holes (flat_faces_internal.h), of which the surface has
/// less than half, into it, if a program about them has a solution with all of
/// their triangles: through the same points, with no more pieces and no more
/// handles. Not where the surface goes through the plane at most edges of the
/// outline, which is that of a section then. Only if a look at the surface says
/// that the body is a designed one.
///
/// @param options  all programs together may take the propagations of one
/// region
///   of all points, and the conflicts of three
/// @param surface  closed and manifold; changed where a face was put in
RegainedFaces regain_faces(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           WorkingSurface& surface);

}  // namespace umbrella
