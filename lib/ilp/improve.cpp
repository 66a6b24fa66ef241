// Two exact ways to one result. A search that decides strictly in the given
// order, each variable false, meets the least model first: whatever is true in
// it follows from smaller variables that are false. That is the quickest while
// conflicts are few. Past a budget, any model is found by the adaptive search,
// and made smaller: variables in order, one that is true in the best model so
// far is assumed false; if a model remains, it is the new best, else the
// variable is true in all that come. A variable that is false costs nothing.

#include "ilp/improve.h"

#include <algorithm>

#include "ilp/budget.h"

namespace ilp {
namespace {

Improvement descend(Solver& solver, std::span<const VarId> worst_first,
                    const Budget& budget) {
  Improvement best;
  best.status = solver.solve({}, budget.left());
  if (best.status != Status::Feasible) return best;
  best.model = solver.model();

  for (const VarId v : worst_first) {
    solver.assume(Literal(v, false));
    if (best.model[index(v)]) {
      const Status status = solver.solve_assumed(budget.left());
      if (status == Status::Limit) return best;
      if (status == Status::Feasible) {
        best.model = solver.model();
      } else {
        solver.retract();
        solver.assume(Literal(v, true));
      }
    }
    ++best.n_proven;
  }
  best.status = Status::Optimal;
  return best;
}

}  // namespace

Improvement minimize_worst_first(Solver& solver,
                                 std::span<const VarId> worst_first,
                                 const Limits& limits, std::uint64_t in_order) {
  const Budget budget(solver, limits);
  solver.set_priority(worst_first);
  solver.set_branching(Branching::Static);
  Limits trial = limits;
  trial.conflicts = std::min(limits.conflicts, in_order);
  const Status status = solver.solve({}, trial);
  solver.set_branching(Branching::Adaptive);

  if (status == Status::Feasible)
    return {Status::Optimal, solver.model(), worst_first.size()};
  if (status == Status::Infeasible) return {status, {}, 0};
  return descend(solver, worst_first, budget);
}

}  // namespace ilp
