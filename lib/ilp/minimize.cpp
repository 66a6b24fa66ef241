// Searching from above: any model, then a better one, until there is none. The
// decisions take the cheap value of each variable first, and once there is a
// model, the value that it has there: better ones are mostly near.

#include "ilp/minimize.h"

#include <cstdint>
#include <vector>

#include "ilp/budget.h"

namespace ilp {
namespace {

std::int64_t value(std::span<const Term> sum, const Model& model) {
  std::int64_t total = 0;
  for (const auto& [var, a] : sum)
    if (model[index(var)]) total += a;
  return total;
}

}  // namespace

Minimum minimize_sum(Solver& solver, std::span<const Term> sum,
                     const Limits& limits, const OnBetter& on_better) {
  const Budget budget(solver, limits);
  std::vector<Literal> preferred;
  for (const auto& [var, a] : sum) preferred.emplace_back(var, a < 0);
  solver.prefer(preferred);

  Minimum best;
  for (;;) {
    const Status status = solver.solve({}, budget.left());
    const bool has_model = !best.model.empty();
    if (status == Status::Infeasible)
      best.status = has_model ? Status::Optimal : Status::Infeasible;
    if (status == Status::Limit)
      best.status = has_model ? Status::Feasible : Status::Limit;
    if (status != Status::Feasible) return best;

    best.model = solver.model();
    best.sum = value(sum, best.model);
    if (on_better) on_better(best.model, best.sum);
    for (Literal& l : preferred)
      l = Literal(l.var(), best.model[index(l.var())]);
    solver.prefer(preferred);
    solver.require_better(sum);
  }
}

}  // namespace ilp
