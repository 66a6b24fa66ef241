/// @file
/// How good the triangles are that a change of the surface would swap.
#pragma once

#include "umbrella/attempt_internal.h"
#include "umbrella/badness_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Triangles that go are on the surface before a change only, those that come
/// after it only. How bad they are counts from Badness::least(), so that no
/// number is negative; where there are none it is 0.
struct Exchange {
  double worst_going = 0;
  double mean_going = 0;
  double mean_coming = 0;
};

/// Of the change that a solved attempt proposes.
/// @param surface  as it was when the attempt was made
Exchange exchange_of(const Attempt& solved, const WorkingSurface& surface,
                     const Badness& badness);

}  // namespace umbrella
