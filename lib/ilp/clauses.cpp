#include "ilp/clauses.h"

#include <algorithm>
#include <utility>

namespace ilp {
namespace {

Reason reason_of(ClauseRef c) {
  return {Reason::Kind::Clause, static_cast<std::uint32_t>(c), {}};
}

}  // namespace

bool Clauses::add(std::span<Literal> literals, Antecedent origin,
                  std::uint32_t glue, Assignment& assignment,
                  Conflict& conflict) {
  std::size_t n_possible = 0;
  for (std::size_t k = 0; k < literals.size() && n_possible < 2; ++k)
    if (!assignment.holds(!literals[k]))
      std::swap(literals[n_possible++], literals[k]);
  const ClauseRef c = store_.add(literals, origin, glue);
  if (n_possible == 0) return fail(c, conflict);
  if (n_possible == 1 && assignment.is_open(literals[0].var()))
    assignment.assign(literals[0], reason_of(c));
  return true;
}

bool Clauses::visit_all(Literal failing, Assignment& assignment,
                        Conflict& conflict) {
  const std::size_t n = store_.watches(failing).size();
  std::size_t n_kept = 0;
  Visit visited = Visit::Kept;
  for (std::size_t i = 0; i < n; ++i) {
    Watch watch = store_.watches(failing)[i];
    if (visited != Visit::Failed)
      visited = assignment.holds(watch.blocker)
                    ? Visit::Kept
                    : visit(watch, failing, assignment, conflict);
    if (visited != Visit::Moved) store_.watches(failing)[n_kept++] = watch;
  }
  if (n_kept < n) store_.keep_watches(failing, n_kept);
  return visited != Visit::Failed;
}

// A watched literal fails: watch another, or the last one holds.
Clauses::Visit Clauses::visit(Watch& watch, Literal failing,
                              Assignment& assignment, Conflict& conflict) {
  const std::span<Literal> literals = store_.literals(watch.clause);
  if (literals[0] == failing) std::swap(literals[0], literals[1]);
  watch.blocker = literals[0];
  if (assignment.holds(literals[0])) return Visit::Kept;
  for (std::size_t k = 2; k < literals.size(); ++k) {
    if (assignment.holds(!literals[k])) continue;
    std::swap(literals[1], literals[k]);
    store_.watch(literals[1], watch);
    return Visit::Moved;
  }
  if (!assignment.is_open(literals[0].var())) {
    fail(watch.clause, conflict);
    return Visit::Failed;
  }
  assignment.assign(literals[0], reason_of(watch.clause));
  return Visit::Kept;
}

bool Clauses::fail(ClauseRef c, Conflict& conflict) const {
  conflict = {reason_of(c), {}};
  for (const Literal l : store_.literals(c)) conflict.literals.push_back(!l);
  return false;
}

void Clauses::explain(Literal l, const Assignment& assignment,
                      std::vector<Literal>& out) const {
  const ClauseRef c{assignment.reason(l.var()).index};
  for (const Literal other : store_.literals(c))
    if (other != l) out.push_back(!other);
}

void Clauses::forget(Assignment& assignment, const OnForgotten& on_forgotten) {
  std::vector<bool> is_reason(store_.size(), false);
  for (const Literal l : assignment.trail()) {
    const Reason& r = assignment.reason(l.var());
    if (r.kind == Reason::Kind::Clause) is_reason[r.index] = true;
  }
  std::vector<ClauseRef> worst_first;
  for (std::uint32_t i = 0; i < store_.size(); ++i)
    if (store_.glue(ClauseRef{i}) > 2 && !is_reason[i])
      worst_first.push_back(ClauseRef{i});
  std::ranges::stable_sort(worst_first, std::ranges::greater{},
                           [this](ClauseRef c) { return store_.glue(c); });
  worst_first.resize(worst_first.size() / 2);
  std::vector<bool> is_garbage(store_.size(), false);
  for (const ClauseRef c : worst_first) {
    is_garbage[static_cast<std::size_t>(c)] = true;
    on_forgotten(store_.literals(c));
  }

  const std::vector<ClauseRef> moved = store_.compact(is_garbage);
  for (const Literal l : assignment.trail()) {
    const Reason& r = assignment.reason(l.var());
    if (r.kind == Reason::Kind::Clause)
      assignment.set_reason_index(l.var(),
                                  static_cast<std::uint32_t>(moved[r.index]));
  }
}

}  // namespace ilp
