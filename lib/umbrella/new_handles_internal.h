/// @file
/// Whether closing a surface may have made a handle that should not be.
#pragma once

#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Whether a loop of at most `max_edges` edges near the triangles that were
/// added seems to go round a handle that they have part in.
///
/// Where the added triangles are discs, any loop can be moved away from them:
/// the surface has no handle that the other triangles do not have. About the
/// rest of them loops are looked for on the neighbourhood alone; what does not
/// bound there may still bound beyond.
bool may_have_new_handle(const WorkingSurface& surface, unsigned max_edges);

}  // namespace umbrella
