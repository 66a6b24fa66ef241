/// @file
/// Puts ranks that doubles cannot tell apart in their exact order.
#pragma once

#include <functional>
#include <vector>

#include "umbrella/exact_ratio.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Twice what a rank may be off by, relatively.
inline constexpr double kNearTie = 0x1p-32;

/// Changes ranks that are off by less than kNearTie / 2 so that their order is
/// that of the exact ones, and equal ones are equal. Ranks must not be
/// negative, and a primary of zero must be exact.
///
/// Primaries change by no more than they were off; where `exact` had to decide
/// between them, and at zero, secondaries become consecutive numbers.
///
/// @param exact  called only for triangles too close to another one
void order_exactly(std::vector<RankedTriangle>& triangles,
                   const std::function<ExactRank(delaunay::Facet)>& exact);

}  // namespace umbrella
