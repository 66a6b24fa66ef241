// Each kind of constraint has a propagator of its own with the same four calls:
// propagate() follows up one literal of the trail, undo() takes that back,
// explain() finds the literals behind a reason when the search asks for them,
// and origin() names the constraint.

#include "ilp/propagate.h"

#include <algorithm>

namespace ilp {

Propagator::Propagator(const Problem& problem)
    : assignment_(problem.n_variables()),
      pairs_and_rings_(problem),
      sides_(problem),
      clauses_(problem.n_variables()),
      linears_(problem) {
  is_contradictory_ = !fix(problem) ||
                      !pairs_and_rings_.start(assignment_, conflict_) ||
                      !sides_.start(assignment_, conflict_) ||
                      !linears_.start(assignment_, conflict_);
  if (!is_contradictory_) add_initial_clauses(problem);
}

bool Propagator::fix(const Problem& problem) {
  for (const Literal l : problem.fixed()) {
    if (assignment_.holds(!l)) {
      conflict_ = {{}, {!l}};
      return false;
    }
    if (!assignment_.holds(l)) assignment_.assign(l, {});
  }
  return true;
}

void Propagator::add_initial_clauses(const Problem& problem) {
  clauses_.reserve(problem.n_rings() + problem.n_clauses(),
                   problem.rings().n_items());
  std::vector<Literal> clause;
  for (std::uint32_t r = 0; r < problem.n_rings(); ++r) {
    if (problem.is_optional(r)) continue;
    const std::span<const Spoke> spokes = problem.ring(r);
    clause.resize(spokes.size());
    std::ranges::transform(spokes, clause.begin(),
                           [](const Spoke& s) { return Literal(s.var, true); });
    add_clause(clause, Antecedent({ConstraintKind::Ring, r}), 0);
  }
  for (std::uint32_t c = 0; c < problem.n_clauses(); ++c) {
    clause.assign(problem.clause(c).begin(), problem.clause(c).end());
    if (normalize(clause))
      add_clause(clause, Antecedent({ConstraintKind::Clause, c}), 0);
  }
}

void Propagator::backtrack(std::uint32_t level) {
  if (level >= assignment_.n_levels()) return;
  const std::size_t n_kept = assignment_.begin_of_level(level + 1);
  while (n_followed_ > n_kept) {
    const Literal l = assignment_.trail()[--n_followed_];
    linears_.undo(l);
    sides_.undo(l);
    pairs_and_rings_.undo(l);
  }
  assignment_.backtrack(level);
  linears_.reopen();
}

bool Propagator::propagate() {
  while (!is_contradictory_ && n_followed_ < assignment_.trail().size()) {
    ++n_propagated_;
    if (propagate(assignment_.trail()[n_followed_++])) continue;
    is_contradictory_ = assignment_.n_levels() == 0;
    return false;
  }
  return !is_contradictory_;
}

bool Propagator::propagate(Literal l) {
  linears_.count(l);  // a conflict elsewhere must not keep it from undo()
  return pairs_and_rings_.propagate(l, assignment_, conflict_) &&
         sides_.propagate(l, assignment_, conflict_) &&
         linears_.propagate(l, assignment_, conflict_) &&
         clauses_.propagate(l, assignment_, conflict_);
}

void Propagator::explain(Literal l, std::vector<Literal>& out) const {
  switch (assignment_.reason(l.var()).kind) {
    case Reason::Kind::None:
      return;
    case Reason::Kind::Pair:
    case Reason::Kind::Ring:
      return pairs_and_rings_.explain(l, assignment_, out);
    case Reason::Kind::Sides:
      return sides_.explain(l, assignment_, out);
    case Reason::Kind::Clause:
      return clauses_.explain(l, assignment_, out);
    case Reason::Kind::Linear:
      return linears_.explain(l, assignment_, out);
  }
}

Antecedent Propagator::origin(const Reason& reason) const {
  switch (reason.kind) {
    case Reason::Kind::None:
      break;
    case Reason::Kind::Pair:
    case Reason::Kind::Ring:
      return pairs_and_rings_.origin(reason);
    case Reason::Kind::Sides:
      return sides_.origin(reason);
    case Reason::Kind::Clause:
      return clauses_.origin(reason);
    case Reason::Kind::Linear:
      return Antecedent({ConstraintKind::Linear, reason.index});
  }
  return Antecedent::nothing();
}

void Propagator::add_clause(std::span<Literal> literals, Antecedent origin,
                            std::uint32_t glue) {
  if (is_contradictory_) return;
  is_contradictory_ =
      !clauses_.add(literals, origin, glue, assignment_, conflict_);
}

void Propagator::add_linear(std::span<const Term> terms, std::int64_t bound) {
  linears_.add(terms, bound, assignment_.trail().first(n_followed_));
  settle(linears_.size() - 1);
}

void Propagator::tighten(std::uint32_t linear, std::int64_t bound) {
  linears_.tighten(linear, bound);
  settle(linear);
}

void Propagator::settle(std::uint32_t linear) {
  if (is_contradictory_) return;
  is_contradictory_ = !linears_.settle(linear, assignment_, conflict_);
}

}  // namespace ilp
