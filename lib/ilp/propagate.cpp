// Every constraint is watched by what it costs least to watch. A pair counts:
// how many of its variables are open, how many are true, and the XOR of either
// set, so that the last open variable, or the mate of a true one, is known
// without a search. A ring keeps nothing of its own: its nodes are pairs, so a
// walk from mate to mate along true spokes tells whether they close a cycle. A
// clause, and the demand that a ring has a true spoke at all, watches two
// literals [Moskewicz01]. Counts change when a literal leaves the queue (the
// trail's tail), not when it enters: a literal may hold uncounted.
//
// Reasons name the constraint only; explain() finds the literals, by their
// positions in the trail, when the search asks.

#include "ilp/propagate.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace ilp {
namespace {

Reason pair_reason(std::uint32_t p) { return {Reason::Kind::Pair, p, {}}; }

Reason clause_reason(ClauseRef c) {
  return {Reason::Kind::Clause, static_cast<std::uint32_t>(c), {}};
}

template <class Entry>
struct Occurrence {
  VarId var;
  Entry entry;
};

template <class Entry>
Rows<Entry> by_variable(std::size_t n_variables,
                        const std::vector<Occurrence<Entry>>& all) {
  return Rows<Entry>::grouped(
      n_variables, all.size(),
      [&all](std::size_t i) { return index(all[i].var); },
      [&all](std::size_t i) { return all[i].entry; });
}

}  // namespace

Propagator::Propagator(const Problem& problem)
    : links_(link(problem)),
      pairs_(links_.pairs.size()),
      clauses_(problem.n_variables()),
      values_(2 * problem.n_variables(), kOpen),
      states_(problem.n_variables()),
      is_on_cycle_(problem.n_variables(), 0) {
  std::vector<Occurrence<std::uint32_t>> pairs;
  pairs.reserve(links_.pairs.n_items());
  for (std::uint32_t p = 0; p < links_.pairs.size(); ++p)
    for (const VarId v : links_.pairs[p]) {
      pairs.push_back({v, p});
      ++pairs_[p].n_open;
      pairs_[p].open_xor ^= static_cast<std::uint32_t>(v);
    }
  pairs_of_ = by_variable(n_variables(), pairs);

  std::vector<Occurrence<Membership>> rings;
  rings.reserve(links_.rings.n_items());
  for (std::uint32_t r = 0; r < links_.rings.size(); ++r)
    for (const LinkedSpoke& s : links_.rings[r])
      rings.push_back({s.var, {r, s.pair_a, s.pair_b}});
  rings_of_ = by_variable(n_variables(), rings);

  fix(problem);
  add_initial_clauses(problem);
}

void Propagator::fix(const Problem& problem) {
  for (const Literal l : problem.fixed())
    if (is_open(l.var())) {
      assign(l, {});
    } else if (!holds(l)) {
      fail({});
      conflict_.literals.push_back(!l);
      return;
    }
  for (std::uint32_t p = 0; p < links_.pairs.size(); ++p)
    if (links_.pairs[p].size() == 1 && !propagate_pair(p)) return;
}

void Propagator::add_initial_clauses(const Problem& problem) {
  std::vector<Literal> clause;
  const auto add = [this, &clause](ConstraintId id) {
    return !normalize(clause) || add_clause(clause, Antecedent(id), 0);
  };
  for (std::uint32_t r = 0; r < problem.n_rings(); ++r) {
    if (problem.is_optional(r)) continue;
    clause.clear();
    for (const Spoke& s : problem.ring(r)) clause.emplace_back(s.var, true);
    if (!add({ConstraintKind::Ring, r})) return;
  }
  for (std::uint32_t c = 0; c < problem.n_clauses(); ++c) {
    clause.assign(problem.clause(c).begin(), problem.clause(c).end());
    if (!add({ConstraintKind::Clause, c})) return;
  }
}

void Propagator::assign(Literal l, Reason reason) {
  assert(is_open(l.var()));
  values_[l.code()] = kHolds;
  values_[(!l).code()] = kFails;
  states_[index(l.var())] = {n_levels(),
                             static_cast<std::uint32_t>(trail_.size()), reason};
  trail_.push_back(l);
}

void Propagator::backtrack(std::uint32_t level) {
  if (level >= n_levels()) return;
  const std::size_t n_kept = begin_of_level(level + 1);
  while (n_counted_ > n_kept) uncount(trail_[--n_counted_]);
  for (std::size_t i = n_kept; i < trail_.size(); ++i) {
    values_[trail_[i].code()] = kOpen;
    values_[(!trail_[i]).code()] = kOpen;
  }
  trail_.resize(n_kept);
  level_begin_.resize(level);
}

bool Propagator::propagate() {
  if (is_contradictory_) return false;
  while (n_counted_ < trail_.size()) {
    const Literal l = trail_[n_counted_++];
    ++n_propagated_;
    if (count(l) && !propagate_pairs(l.var())) return false;
    if (l.value() && !close_rings(l.var())) return false;
    if (!propagate_clauses(l)) return false;
  }
  return true;
}

// Returns whether some pair may now force a variable.
bool Propagator::count(Literal l) {
  const auto id = static_cast<std::uint32_t>(l.var());
  bool may_force = false;
  for (const std::uint32_t p : pairs_of_[id]) {
    PairCount& c = pairs_[p];
    --c.n_open;
    c.open_xor ^= id;
    if (l.value()) {
      ++c.n_true;
      c.true_xor ^= id;
    }
    may_force |= c.n_open == 1 || c.n_true == 2;
  }
  return may_force;
}

void Propagator::uncount(Literal l) {
  const auto id = static_cast<std::uint32_t>(l.var());
  for (const std::uint32_t p : pairs_of_[id]) {
    PairCount& c = pairs_[p];
    ++c.n_open;
    c.open_xor ^= id;
    if (l.value()) {
      --c.n_true;
      c.true_xor ^= id;
    }
  }
}

bool Propagator::fail(const Reason& reason) {
  conflict_.reason = reason;
  conflict_.literals.clear();
  is_contradictory_ = n_levels() == 0;
  return false;
}

bool Propagator::propagate_pairs(VarId var) {
  return std::ranges::all_of(pairs_of_[index(var)], [this](std::uint32_t p) {
    return propagate_pair(p);
  });
}

bool Propagator::propagate_pair(std::uint32_t p) {
  const PairCount& c = pairs_[p];
  if (c.n_true == 2) return c.n_open == 0 || clear_pair(p);
  if (c.n_open != 1) return true;

  const Literal last(VarId{c.open_xor}, c.n_true == 1);
  if (is_open(last.var())) assign(last, pair_reason(p));
  if (holds(last)) return true;
  fail(pair_reason(p));
  for (const VarId v : links_.pairs[p])
    conflict_.literals.push_back(holding_literal(v));
  return false;
}

// Two variables are counted as true: all others are false.
bool Propagator::clear_pair(std::uint32_t p) {
  for (const VarId v : links_.pairs[p]) {
    if (is_open(v)) {
      assign(Literal(v, false), pair_reason(p));
    } else if (holds(Literal(v, true)) && !is_counted(v)) {
      fail(pair_reason(p));
      for (const VarId w : links_.pairs[p])
        if (w == v || (holds(Literal(w, true)) && is_counted(w)))
          conflict_.literals.emplace_back(w, true);
      return false;
    }
  }
  return true;
}

const Propagator::Membership& Propagator::membership(VarId var,
                                                     std::uint32_t ring) const {
  return *std::ranges::lower_bound(rings_of_[index(var)], ring, {},
                                   &Membership::ring);
}

// The true spoke that follows `var` across `pair` on a ring; moves `pair` to
// its other end.
VarId Propagator::next_on_ring(std::uint32_t ring, VarId var,
                               std::uint32_t& pair) const {
  const VarId next{pairs_[pair].true_xor ^ static_cast<std::uint32_t>(var)};
  const Membership& m = membership(next, ring);
  pair ^= m.pair_a ^ m.pair_b;
  return next;
}

bool Propagator::closes_cycle(VarId var, const Membership& m) const {
  if (pairs_[m.pair_a].n_true != 2) return false;
  std::uint32_t pair = m.pair_b;
  VarId v = var;
  do {
    if (pairs_[pair].n_true != 2) return false;
    v = next_on_ring(m.ring, v, pair);
  } while (v != var);
  return true;
}

void Propagator::append_cycle(std::uint32_t ring, VarId on_cycle,
                              std::vector<Literal>& out) const {
  std::uint32_t pair = membership(on_cycle, ring).pair_b;
  VarId v = on_cycle;
  do {
    out.emplace_back(v, true);
    v = next_on_ring(ring, v, pair);
  } while (v != on_cycle);
}

bool Propagator::close_rings(VarId var) {
  for (const Membership& m : rings_of_[index(var)])
    if (closes_cycle(var, m) && !clear_ring(m.ring, var)) return false;
  return true;
}

// A cycle is closed: all other spokes are false.
bool Propagator::clear_ring(std::uint32_t ring, VarId on_cycle) {
  const Reason reason{Reason::Kind::Ring, ring, on_cycle};
  const std::span<const LinkedSpoke> spokes = links_.rings[ring];
  cycle_.clear();
  append_cycle(ring, on_cycle, cycle_);
  for (const Literal l : cycle_) is_on_cycle_[index(l.var())] = 1;
  const auto second =
      std::ranges::find_if(spokes, [this](const LinkedSpoke& s) {
        return holds(Literal(s.var, true)) && !is_on_cycle_[index(s.var)];
      });
  for (const Literal l : cycle_) is_on_cycle_[index(l.var())] = 0;

  if (second != spokes.end()) {
    fail(reason);
    conflict_.literals = cycle_;
    conflict_.literals.emplace_back(second->var, true);
    return false;
  }
  for (const LinkedSpoke& s : spokes)
    if (is_open(s.var)) assign(Literal(s.var, false), reason);
  return true;
}

bool Propagator::propagate_clauses(Literal holding) {
  std::vector<Watch>& list = clauses_.watches(!holding);
  auto kept = list.begin();
  auto watch = list.begin();
  Visit visited = Visit::Kept;
  while (watch != list.end() && visited != Visit::Failed) {
    visited = holds(watch->blocker) ? Visit::Kept : visit(*watch, !holding);
    if (visited != Visit::Moved) *kept++ = *watch;
    ++watch;
  }
  list.erase(kept, watch);
  return visited != Visit::Failed;
}

// A watched literal of a clause fails: watch another, or the last one holds.
Propagator::Visit Propagator::visit(Watch& watch, Literal failing) {
  const std::span<Literal> literals = clauses_.literals(watch.clause);
  if (literals[0] == failing) std::swap(literals[0], literals[1]);
  watch.blocker = literals[0];
  if (holds(literals[0])) return Visit::Kept;
  for (std::size_t k = 2; k < literals.size(); ++k) {
    if (holds(!literals[k])) continue;
    std::swap(literals[1], literals[k]);
    clauses_.watches(literals[1]).push_back(watch);
    return Visit::Moved;
  }
  if (!is_open(literals[0].var())) {
    fail_clause(watch.clause);
    return Visit::Failed;
  }
  assign(literals[0], clause_reason(watch.clause));
  return Visit::Kept;
}

bool Propagator::fail_clause(ClauseRef c) {
  fail(clause_reason(c));
  for (const Literal l : clauses_.literals(c)) conflict_.literals.push_back(!l);
  return false;
}

void Propagator::explain(Literal l, std::vector<Literal>& out) const {
  const Reason& r = states_[index(l.var())].reason;
  switch (r.kind) {
    case Reason::Kind::None:
      break;
    case Reason::Kind::Pair:
      explain_pair(l, out);
      break;
    case Reason::Kind::Ring:
      append_cycle(r.index, r.on_cycle, out);
      break;
    case Reason::Kind::Clause:
      for (const Literal other : clauses_.literals(ClauseRef{r.index}))
        if (other != l) out.push_back(!other);
      break;
  }
}

// Two that are true make all others false; else all others decided the last.
void Propagator::explain_pair(Literal l, std::vector<Literal>& out) const {
  const VarState& state = states_[index(l.var())];
  const std::span<const VarId> vars = links_.pairs[state.reason.index];
  const std::size_t begin = out.size();
  for (std::size_t i = 0; !l.value() && i < vars.size(); ++i)
    if (holds(Literal(vars[i], true)) &&
        states_[index(vars[i])].position < state.position) {
      out.emplace_back(vars[i], true);
      if (out.size() == begin + 2) return;
    }
  out.resize(begin);
  for (const VarId v : vars)
    if (v != l.var()) out.push_back(holding_literal(v));
}

Antecedent Propagator::origin(const Reason& reason) const {
  switch (reason.kind) {
    case Reason::Kind::Pair:
      return Antecedent(links_.pair_origin[reason.index]);
    case Reason::Kind::Ring:
      return Antecedent({ConstraintKind::Ring, reason.index});
    case Reason::Kind::Clause:
      return clauses_.origin(ClauseRef{reason.index});
    case Reason::Kind::None:
      break;
  }
  return Antecedent::nothing();
}

bool Propagator::add_clause(std::span<Literal> literals, Antecedent origin,
                            std::uint32_t glue) {
  std::size_t n_not_failing = 0;
  for (std::size_t k = 0; k < literals.size() && n_not_failing < 2; ++k)
    if (!holds(!literals[k])) std::swap(literals[n_not_failing++], literals[k]);
  const ClauseRef c = clauses_.add(literals, origin, glue);
  if (n_not_failing == 0) return fail_clause(c);
  if (n_not_failing == 1 && is_open(literals[0].var()))
    assign(literals[0], clause_reason(c));
  return true;
}

void Propagator::forget_clauses() {
  std::vector<bool> is_garbage(clauses_.size(), false);
  std::vector<bool> is_reason(clauses_.size(), false);
  for (const Literal l : trail_) {
    const Reason& r = states_[index(l.var())].reason;
    if (r.kind == Reason::Kind::Clause) is_reason[r.index] = true;
  }
  std::vector<ClauseRef> worst_first;
  for (std::uint32_t i = 0; i < clauses_.size(); ++i)
    if (clauses_.glue(ClauseRef{i}) > 2 && !is_reason[i])
      worst_first.push_back(ClauseRef{i});
  std::ranges::stable_sort(worst_first, std::ranges::greater{},
                           [this](ClauseRef c) { return clauses_.glue(c); });
  worst_first.resize(worst_first.size() / 2);
  for (const ClauseRef c : worst_first)
    is_garbage[static_cast<std::size_t>(c)] = true;

  const std::vector<ClauseRef> moved = clauses_.compact(is_garbage);
  for (const Literal l : trail_) {
    Reason& r = states_[index(l.var())].reason;
    if (r.kind == Reason::Kind::Clause)
      r.index = static_cast<std::uint32_t>(moved[r.index]);
  }
}

}  // namespace ilp
