/// @file
/// CBC [Forrest05] on our programs, by linear inequalities.
#pragma once

#include "ilp/minimize.h"
#include "ilp/problem.h"

namespace support {

/// Any model; cycles are cut in the strong form where a solution breaks them.
/// @return Feasible, Infeasible or Limit
ilp::Minimum solve_by_inequalities(const ilp::Problem& problem, double seconds);

}  // namespace support
