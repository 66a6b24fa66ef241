// A pair keeps the size and the sum of two sets of its variables, those that
// are open and those that are true, so that the last open variable, or the mate
// of a true one, is known without a search. A ring keeps nothing of its own:
// its nodes are pairs, so a walk from mate to mate along true spokes tells
// whether they close a cycle. A literal may hold before it is counted; what is
// forced depends on counted literals only, and explain() finds them again by
// their positions.

#include "ilp/pairs_rings.h"

#include <algorithm>

namespace ilp {
namespace {

Reason pair_reason(std::uint32_t p) { return {Reason::Kind::Pair, p, {}}; }

}  // namespace

PairsAndRings::PairsAndRings(const Problem& problem)
    : links_(link(problem)),
      pairs_(links_.pairs.size()),
      rings_of_(Rows<Membership>::inverted(
          problem.n_variables(), links_.rings,
          [](const Spoke& s) { return index(s.var); },
          [](std::uint32_t r, const Spoke& s) {
            return Membership{r, s.a, s.b};
          })),
      is_on_cycle_(problem.n_variables(), 0) {
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    VarSum open;
    for (const VarId v : links_.pairs[p]) open.add(v);
    pairs_[p].open = open;
  }
}

bool PairsAndRings::start(Assignment& assignment, Conflict& conflict) {
  for (std::uint32_t p = 0; p < pairs_.size(); ++p)
    if (pairs_[p].open.size() == 1 && !force_last(p, assignment, conflict))
      return false;
  return true;
}

bool PairsAndRings::propagate(Literal l, Assignment& assignment,
                              Conflict& conflict) {
  if (count(l))
    for (const std::uint32_t p : links_.pairs_of[index(l.var())]) {
      const PairCount& c = pairs_[p];
      if (c.trues.size() == 2) {
        if (l.value() && c.open.size() > 0 &&
            !clear_pair(p, assignment, conflict))
          return false;
      } else if (c.open.size() == 1 && !force_last(p, assignment, conflict)) {
        return false;
      }
    }
  if (!l.value()) return true;
  for (const Membership& m : rings_of_[index(l.var())]) {
    if (!has_mates(m)) continue;
    const std::size_t length = cycle_length(l.var(), m);
    if (length > 0 && !clear_ring({Reason::Kind::Ring, m.ring, l.var()}, length,
                                  assignment, conflict))
      return false;
  }
  return true;
}

// Returns whether some pair may force a variable now. One with two true
// variables has done so when the second was counted.
bool PairsAndRings::count(Literal l) {
  const VarId v = l.var();
  bool may_force = false;
  for (const std::uint32_t p : links_.pairs_of[index(v)]) {
    PairCount& c = pairs_[p];
    c.open.remove(v);
    if (l.value()) c.trues.add(v);
    may_force |= c.trues.size() == 2 ? l.value() : c.open.size() == 1;
  }
  return may_force;
}

void PairsAndRings::undo(Literal l) {
  const VarId v = l.var();
  for (const std::uint32_t p : links_.pairs_of[index(v)]) {
    pairs_[p].open.add(v);
    if (l.value()) pairs_[p].trues.remove(v);
  }
}

// One variable is not counted, and fewer than two are true.
bool PairsAndRings::force_last(std::uint32_t p, Assignment& assignment,
                               Conflict& conflict) const {
  const PairCount& c = pairs_[p];
  const Literal last(c.open.only(), c.trues.size() == 1);
  if (assignment.is_open(last.var())) assignment.assign(last, pair_reason(p));
  return assignment.holds(last) || fail_pair(p, assignment, conflict);
}

// Two variables are counted as true: all others are false. A third that holds
// cannot be counted yet, so it comes later in the trail than the two.
bool PairsAndRings::clear_pair(std::uint32_t p, Assignment& assignment,
                               Conflict& conflict) const {
  const std::span<const VarId> vars = links_.pairs[p];
  std::size_t n_true = 0;
  for (const VarId v : vars) n_true += assignment.is_true(v) ? 1 : 0;
  if (n_true > 2) return fail_pair(p, assignment, conflict);
  for (const VarId v : vars)
    if (assignment.is_open(v))
      assignment.assign(Literal(v, false), pair_reason(p));
  return true;
}

// The conflict is three that are true, or all if only one is.
bool PairsAndRings::fail_pair(std::uint32_t p, const Assignment& assignment,
                              Conflict& conflict) const {
  conflict = {pair_reason(p), {}};
  for (const VarId v : links_.pairs[p])
    if (pairs_[p].trues.size() < 2 || assignment.is_true(v))
      conflict.literals.push_back(assignment.literal(v));
  return false;
}

const PairsAndRings::Membership& PairsAndRings::membership(
    VarId var, std::uint32_t ring) const {
  const Membership* m = rings_of_[index(var)].data();
  while (m->ring != ring) ++m;
  return *m;
}

// The true spoke that follows `var` across `pair` on a ring; moves `pair` to
// its other end.
VarId PairsAndRings::next_on_ring(std::uint32_t ring, VarId var,
                                  std::uint32_t& pair) const {
  const VarId next = pairs_[pair].trues.other_than(var);
  const Membership& m = membership(next, ring);
  pair ^= m.pair_a ^ m.pair_b;
  return next;
}

std::size_t PairsAndRings::cycle_length(VarId var, const Membership& m) const {
  std::size_t length = 0;
  std::uint32_t pair = m.pair_b;
  VarId v = var;
  do {
    v = next_on_ring(m.ring, v, pair);
    ++length;
  } while (v != var && pairs_[pair].trues.size() == 2);
  return v == var ? length : 0;
}

void PairsAndRings::append_cycle(const Reason& reason,
                                 std::vector<Literal>& out) const {
  std::uint32_t pair = membership(reason.on_cycle, reason.index).pair_b;
  VarId v = reason.on_cycle;
  do {
    out.emplace_back(v, true);
    v = next_on_ring(reason.index, v, pair);
  } while (v != reason.on_cycle);
}

// A cycle is closed: all other spokes are false.
bool PairsAndRings::clear_ring(const Reason& reason, std::size_t length,
                               Assignment& assignment, Conflict& conflict) {
  const std::span<const Spoke> spokes = links_.rings[reason.index];
  std::size_t n_true = 0;
  for (const Spoke& s : spokes) n_true += assignment.is_true(s.var) ? 1 : 0;
  if (n_true > length) {
    conflict = {reason, {}};
    append_cycle(reason, conflict.literals);
    conflict.literals.emplace_back(
        spoke_off(conflict.literals, spokes, assignment), true);
    return false;
  }
  for (const Spoke& s : spokes)
    if (assignment.is_open(s.var))
      assignment.assign(Literal(s.var, false), reason);
  return true;
}

// The first true spoke that is not on the cycle.
VarId PairsAndRings::spoke_off(std::span<const Literal> cycle,
                               std::span<const Spoke> spokes,
                               const Assignment& assignment) {
  for (const Literal l : cycle) is_on_cycle_[index(l.var())] = 1;
  const auto found = std::ranges::find_if(spokes, [&](const Spoke& s) {
    return assignment.is_true(s.var) && is_on_cycle_[index(s.var)] == 0;
  });
  for (const Literal l : cycle) is_on_cycle_[index(l.var())] = 0;
  return found->var;
}

void PairsAndRings::explain(Literal l, const Assignment& assignment,
                            std::vector<Literal>& out) const {
  const Reason& reason = assignment.reason(l.var());
  if (reason.kind == Reason::Kind::Ring) {
    append_cycle(reason, out);
  } else {
    explain_pair(l, assignment, out);
  }
}

// Two that are true make all others false; else all others decided the last.
void PairsAndRings::explain_pair(Literal l, const Assignment& assignment,
                                 std::vector<Literal>& out) const {
  const std::span<const VarId> vars =
      links_.pairs[assignment.reason(l.var()).index];
  const std::uint32_t position = assignment.position(l.var());
  const std::size_t begin = out.size();
  for (std::size_t i = 0; !l.value() && i < vars.size(); ++i)
    if (assignment.is_true(vars[i]) &&
        assignment.position(vars[i]) < position) {
      out.emplace_back(vars[i], true);
      if (out.size() == begin + 2) return;
    }
  out.resize(begin);
  for (const VarId v : vars)
    if (v != l.var()) out.push_back(assignment.literal(v));
}

Antecedent PairsAndRings::origin(const Reason& reason) const {
  return reason.kind == Reason::Kind::Ring
             ? Antecedent({ConstraintKind::Ring, reason.index})
             : Antecedent(links_.origin(reason.index));
}

}  // namespace ilp
