/// @file
/// The model of a 0/1 program with the least weighted sum.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "ilp/problem.h"
#include "ilp/solver.h"

namespace ilp {

struct Minimum {
  /// Optimal: no model has a smaller sum. Feasible: the limits came first, and
  /// `model` is the best found. Infeasible: there is none. Limit: none found.
  Status status = Status::Limit;
  Model model;           ///< empty if there is none
  std::int64_t sum = 0;  ///< of the model
};

using OnBetter = std::function<void(const Model&, std::int64_t sum)>;

/// Branch and bound: each model found bounds the sum of the next from above.
///
/// The solver keeps that bound: later calls look for better models only.
/// @param sum        each variable at most once
/// @param on_better  called with each model that is better than all before
/// @throws std::invalid_argument  as Problem::add_linear()
Minimum minimize_sum(Solver& solver, std::span<const Term> sum,
                     const Limits& limits = {}, const OnBetter& on_better = {});

}  // namespace ilp
