/// @file
/// Branch and bound without learning: what the solver is measured against.
#pragma once

#include <span>

#include "ilp/minimize.h"
#include "ilp/problem.h"
#include "ilp/solver.h"

namespace ilp {

/// Depth first in the given order, each variable false first, with the
/// propagation of the solver, and back to the last decision on a conflict. A
/// branch ends where its least possible sum is not below the best.
///
/// @param order  variables to decide first, each once
/// @param sum    to be minimised; none: the first model ends the search with
///   Feasible, and its values on `order` are the lexicographically least
Minimum depth_first(const Problem& problem, std::span<const VarId> order,
                    std::span<const Term> sum = {}, const Limits& limits = {});

}  // namespace ilp
