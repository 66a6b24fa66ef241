/// @file
/// A 0/1 program as plain linear inequalities, for other solvers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

/// The sum of the terms is at least, or exactly, `bound`.
struct LinearRow {
  std::vector<Term> terms;  ///< distinct variables
  std::int64_t bound;
  bool is_equation = false;
};

/// Minimise the objective subject to the rows, all variables 0 or 1.
struct LinearForm {
  std::size_t n_variables = 0;
  std::vector<Term> objective;
  std::vector<LinearRow> rows;
};

/// The inequalities of [Adamy02, Def. 3.3]: (3) and (4) for pairs, (5) for
/// required rings, and (6) in its strong form for the given cycles: the spokes
/// of the cycle and any one other add up to no more than the cycle's length.
/// Solver::cycles() names those that a search needed.
/// There are too many to write them all; without them a ring may have
/// several, so the form is a relaxation of the rings, and exact for all else.
///
/// Sides take a variable for each room, after those of the problem.
LinearForm linear_form(const Problem& problem,
                       std::span<const Cycle> cycles = {});

/// Where the true spokes of a ring form several cycles: all but the longest of
/// them. A model of linear_form() that has none is a model of the problem, and
/// any other breaks the form with these cycles added.
std::vector<Cycle> excess_cycles(const Problem& problem, const Model& model);

}  // namespace ilp
