/// @file
/// Flat faces that a closed surface has lost.
#pragma once

#include <cstddef>
#include <cstdint>

#include "delaunay/triangulation3.h"
#include "umbrella/closing.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

struct RegainedFaces {
  std::size_t count = 0;
  std::uint64_t conflicts = 0;
  std::uint64_t propagations = 0;  ///< all that was taken off the effort
};

/// Puts flat faces with holes (flat_faces_internal.h), of which the surface has
/// less than half, into it, if a program about them has a solution with all of
/// their triangles: through the same points, with no more pieces and no more
/// handles. Not where the surface goes through the plane at most edges of the
/// outline, which is that of a section then. Only if a look at the surface says
/// that the body is a designed one.
///
/// @param options  all programs together may take what one region may
/// @param surface  closed and manifold; changed where a face was put in
RegainedFaces regain_faces(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           WorkingSurface& surface);

}  // namespace umbrella
