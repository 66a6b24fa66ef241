/// @file
/// The best solution of a 0/1 program by a rule of order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ilp/problem.h"
#include "ilp/solver.h"

namespace ilp {

struct Improvement {
  /// Optimal: `model` is the least one. Feasible: the limits came first, and
  /// `model` is the least found. Infeasible: there is none. Limit: none found.
  Status status = Status::Limit;
  Model model;  ///< empty if there is none
  /// So many variables of the order have the values of the least model.
  std::size_t n_proven = 0;
};

/// Conflicts of the search in the order itself, before the search in any order.
/// Chosen by BM_MinimizeWorstFirst; it makes no difference to the result.
inline constexpr std::uint64_t kInOrderConflicts = 2000;

/// The lexicographically least model: in the given order each variable is
/// false where a model with the values so far remains. With triangles from
/// worst to best this is the integer form of the min-max rule of [Adamy02].
/// Its values on `worst_first` are unique, whatever was solved before.
///
/// The solver keeps this order, and what it learned. After Infeasible its
/// core() says why.
///
/// @param worst_first  variables, each once; the others count for nothing
Improvement minimize_worst_first(Solver& solver,
                                 std::span<const VarId> worst_first,
                                 const Limits& limits = {},
                                 std::uint64_t in_order = kInOrderConflicts);

}  // namespace ilp
