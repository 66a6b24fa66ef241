/// @file
/// CaDiCaL [Biere20] on our programs, by clauses.
#pragma once

#include "ilp/minimize.h"
#include "ilp/problem.h"
#include "ilp/solver.h"

namespace support {

/// Any model. The rows of the linear form are written down, those that are no
/// clauses by decision diagrams; cycles are cut lazily, in the strong form,
/// where a model breaks them.
/// @param limits  conflicts count for each search between two cuts
/// @return Feasible, Infeasible or Limit
ilp::Minimum solve_by_clauses(const ilp::Problem& problem,
                              const ilp::Limits& limits = {});

}  // namespace support
