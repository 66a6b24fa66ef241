/// @file
/// The unit in which lengths are compared with Cell::center.
#pragma once

#include <algorithm>
#include <cmath>

#include "delaunay/triangulation3.h"

namespace umbrella {

/// What a coordinate is multiplied with: a power of two. No product of three
/// such lengths leaves the range of doubles.
inline double length_unit(const delaunay::Triangulation3& triangulation) {
  return std::ldexp(1,
                    std::clamp(-triangulation.scale_exponent(), -1000, 1000));
}

}  // namespace umbrella
