#include "ilp/ring_watches.h"

#include <utility>

namespace ilp {

RingWatches::RingWatches(const Problem& problem) : pairs_(problem.n_rings()) {
  for (std::uint32_t r = 0; r < problem.n_rings(); ++r) {
    if (problem.is_optional(r)) continue;
    const std::span<const Spoke> spokes = problem.ring(r);
    if (spokes.size() < 2) {
      short_.push_back(r);
    } else {
      pairs_[r].a = spokes[0].var;
      pairs_[r].b = spokes[1].var;
    }
  }
}

bool RingWatches::start(const Rows<Spoke>& rings, Assignment& assignment,
                        Conflict& conflict) const {
  for (const std::uint32_t r : short_) {
    const Ring ring = {r, rings[r]};
    const VarId last = ring.spokes.empty() ? kNone : ring.spokes[0].var;
    if (!force(ring, last, assignment, conflict)) return false;
  }
  return true;
}

bool RingWatches::replace(const Ring& ring, VarId failing,
                          Assignment& assignment, Conflict& conflict) {
  Pair& pair = pairs_[ring.index];
  if (pair.a == failing) std::swap(pair.a, pair.b);
  if (assignment.is_true(pair.a)) return true;
  for (std::size_t n = ring.spokes.size(); n > 0; --n) {
    const VarId v = ring.spokes[pair.next].var;
    pair.next = pair.next + 1 < ring.spokes.size() ? pair.next + 1 : 0;
    if (v == pair.a || assignment.holds(Literal(v, false))) continue;
    pair.b = v;
    return true;
  }
  return force(ring, pair.a, assignment, conflict);
}

// All spokes but `last` are false.
bool RingWatches::force(const Ring& ring, VarId last, Assignment& assignment,
                        Conflict& conflict) {
  const Reason reason = {Reason::Kind::RingIsUsed, ring.index, {}};
  if (last != kNone && !assignment.holds(Literal(last, false))) {
    if (assignment.is_open(last))
      assignment.assign(Literal(last, true), reason);
    return true;
  }
  conflict = {reason, {}};
  for (const Spoke& s : ring.spokes)
    conflict.literals.emplace_back(s.var, false);
  return false;
}

void RingWatches::explain(Literal l, std::span<const Spoke> spokes,
                          std::vector<Literal>& out) {
  for (const Spoke& s : spokes)
    if (s.var != l.var()) out.emplace_back(s.var, false);
}

}  // namespace ilp
