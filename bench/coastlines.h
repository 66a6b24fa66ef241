/// @file
/// Rings of coastlines as instances of curve reconstruction: their order is the
/// truth.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/curve_instances.h"

namespace bench {

/// Rings of at least `least` and at most `most` points, none twice, from a file
/// of scripts/decode_coastlines.py. Degrees of longitude are shortened as at
/// the ring's mean latitude.
///
/// @return none if the file cannot be read
std::vector<tests::CurveInstance> coastlines(const std::string& path,
                                             std::size_t least,
                                             std::size_t most);

}  // namespace bench
