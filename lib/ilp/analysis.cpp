#include "ilp/analysis.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace ilp {

namespace {

// A conflict with a ring names the cycle, and last another spoke.
std::span<const Literal> cause(const Conflict& conflict) {
  const std::span<const Literal> literals = conflict.literals;
  return literals.first(literals.size() - 1);
}

Cycle cycle_of(const Reason& ring, std::span<const Literal> literals) {
  Cycle cycle{ring.index, {}};
  for (const Literal l : literals) cycle.spokes.push_back(l.var());
  std::ranges::sort(cycle.spokes);
  return cycle;
}

}  // namespace

void add_cycles_of_level_0(const Propagator& propagator,
                           const Conflict& conflict, std::set<Cycle>& cycles) {
  const Assignment& assignment = propagator.assignment();
  std::vector<Literal> explanation;
  for (const Literal l : assignment.trail()) {
    const Reason& reason = assignment.reason(l.var());
    if (assignment.level(l.var()) > 0) break;
    if (reason.kind != Reason::Kind::Ring) continue;
    explanation.clear();
    propagator.explain(l, explanation);
    cycles.insert(cycle_of(reason, explanation));
  }
  if (conflict.reason.kind == Reason::Kind::Ring)
    cycles.insert(cycle_of(conflict.reason, cause(conflict)));
}

const Lesson& Analyzer::analyze(const Propagator& propagator,
                                const Conflict& conflict,
                                Derivations& derivations) {
  propagator_ = &propagator;
  derivations_ = &derivations;
  lesson_.literals.clear();
  lesson_.touched.clear();

  find_first_uip(conflict);
  lesson_.touched = seen_;
  minimize();
  find_glue();

  for (const auto* marked : {&seen_, &not_implied_})
    for (const VarId v : *marked) mark_[index(v)] = Mark::None;
  seen_.clear();
  not_implied_.clear();
  return lesson_;
}

// Resolves backwards along the trail until one literal of the conflict's level
// is left: that one comes first in the clause.
void Analyzer::find_first_uip(const Conflict& conflict) {
  conflict_level_ = 0;
  for (const Literal l : conflict.literals)
    conflict_level_ = std::max(conflict_level_, assignment().level(l.var()));
  assert(conflict_level_ > 0);

  n_unresolved_ = 0;
  lesson_.literals.emplace_back();
  derivations_->use(propagator_->origin(conflict.reason));
  note_cycle(conflict.reason, cause(conflict));
  see(conflict.literals);
  auto l = assignment().trail().end();
  for (;;) {
    do {
      --l;
    } while (!is_seen(l->var()) ||
             assignment().level(l->var()) != conflict_level_);
    if (--n_unresolved_ == 0) break;
    derivations_->use(propagator_->origin(assignment().reason(l->var())));
    explanation_.clear();
    propagator_->explain(*l, explanation_);
    note_cycle(assignment().reason(l->var()), explanation_);
    see(explanation_);
  }
  lesson_.literals.front() = !*l;
}

void Analyzer::note_cycle(const Reason& reason,
                          std::span<const Literal> literals) {
  if (cycles_ != nullptr && reason.kind == Reason::Kind::Ring)
    cycles_->insert(cycle_of(reason, literals));
}

void Analyzer::see(std::span<const Literal> literals) {
  for (const Literal l : literals) {
    if (is_seen(l.var())) continue;
    mark_[index(l.var())] = Mark::Seen;
    seen_.push_back(l.var());
    const std::uint32_t level = assignment().level(l.var());
    if (level == 0) {
      derivations_->use(Antecedent::value_of(l.var()));
    } else if (level == conflict_level_) {
      ++n_unresolved_;
    } else {
      lesson_.literals.push_back(!l);
    }
  }
}

// Drops the literals that the others imply.
void Analyzer::minimize() {
  levels_.clear();
  for (const Literal l : lesson_.literals)
    levels_.push_back(assignment().level(l.var()));
  for (const std::uint32_t level : levels_) has_literal_[level] = 1;
  std::erase_if(lesson_.literals,
                [this, first = lesson_.literals.front()](Literal l) {
                  return l != first && is_implied_by_rest(!l);
                });
}

bool Analyzer::is_implied_by_rest(Literal l) {
  const std::size_t n_seen = seen_.size();
  const std::size_t n_used = derivations_->n_used();
  stack_.assign(1, l);
  Literal top = l;
  bool is_implied = true;
  while (is_implied && !stack_.empty()) {
    top = stack_.back();
    stack_.pop_back();
    is_implied = expand(top);
  }
  if (is_implied) return true;
  for (std::size_t i = n_seen; i < seen_.size(); ++i)
    mark_[index(seen_[i])] = Mark::None;
  seen_.resize(n_seen);
  derivations_->drop(n_used);
  if (top != l) {
    mark_[index(top.var())] = Mark::NotImplied;
    not_implied_.push_back(top.var());
  }
  return false;
}

// Puts what implies l on the stack, unless it is known to follow from the
// clause. False if l is a decision, or owes to a level that the clause lacks
// and so must owe to another decision, or to what is known to do so.
bool Analyzer::expand(Literal l) {
  const Reason reason = assignment().reason(l.var());
  if (reason.kind == Reason::Kind::None) return false;
  derivations_->use(propagator_->origin(reason));
  explanation_.clear();
  propagator_->explain(l, explanation_);
  note_cycle(reason, explanation_);
  for (const Literal e : explanation_) {
    if (is_seen(e.var())) continue;
    if (mark_[index(e.var())] == Mark::NotImplied) return false;
    const std::uint32_t level = assignment().level(e.var());
    if (level == 0) {
      derivations_->use(Antecedent::value_of(e.var()));
    } else if (has_literal_[level] != 0) {
      stack_.push_back(e);
    } else {
      return false;
    }
    mark_[index(e.var())] = Mark::Seen;
    seen_.push_back(e.var());
  }
  return true;
}

// The number of levels in the clause. Forgets those of minimize().
void Analyzer::find_glue() {
  lesson_.glue = 0;
  for (const std::uint32_t level : levels_) has_literal_[level] = 0;
  for (const Literal l : lesson_.literals) {
    std::uint8_t& is_counted = has_literal_[assignment().level(l.var())];
    lesson_.glue += is_counted == 0 ? 1 : 0;
    is_counted = 1;
  }
  for (const std::uint32_t level : levels_) has_literal_[level] = 0;
}

namespace {

// Walks back from a conflict to constraints and decisions, each thing once.
class CoreFinder {
 public:
  CoreFinder(const Propagator& propagator, const Derivations& derivations)
      : propagator_(propagator),
        derivations_(derivations),
        is_seen_(propagator.assignment().n_variables(), false) {}

  Core run(const Conflict& conflict) {
    meet(propagator_.origin(conflict.reason));
    for (const Literal l : conflict.literals) meet(l);
    while (!literals_.empty() || !learned_.empty()) {
      if (learned_.empty()) {
        expand_literal();
      } else {
        expand_learned();
      }
    }
    core_.constraints.assign(constraints_.begin(), constraints_.end());
    return std::move(core_);
  }

 private:
  void meet(Literal l) {
    if (is_seen_[index(l.var())]) return;
    is_seen_[index(l.var())] = true;
    literals_.push_back(l);
  }

  void meet(Antecedent a) {
    if (a.is_constraint()) {
      constraints_.insert(a.constraint());
    } else if (a.is_value()) {
      const VarId v{a.index()};
      meet(Literal(v, propagator_.assignment().holds(Literal(v, true))));
    } else if (a.is_learned() && derivations_.is_complete() &&
               seen_learned_.insert(a.index()).second) {
      learned_.push_back(a);
    }
  }

  void expand_literal() {
    const Literal l = literals_.back();
    literals_.pop_back();
    const Reason reason = propagator_.assignment().reason(l.var());
    if (reason.kind == Reason::Kind::None) {
      if (propagator_.assignment().level(l.var()) > 0)
        core_.assumptions.push_back(l);
      return;
    }
    meet(propagator_.origin(reason));
    explanation_.clear();
    propagator_.explain(l, explanation_);
    for (const Literal e : explanation_) meet(e);
  }

  void expand_learned() {
    const Antecedent learned = learned_.back();
    learned_.pop_back();
    for (const Antecedent a : derivations_.of(learned)) meet(a);
  }

  const Propagator& propagator_;
  const Derivations& derivations_;
  Core core_;
  std::set<ConstraintId> constraints_;
  std::set<std::uint32_t> seen_learned_;
  std::vector<bool> is_seen_;
  std::vector<Literal> literals_;
  std::vector<Antecedent> learned_;
  std::vector<Literal> explanation_;
};

}  // namespace

Core find_core(const Propagator& propagator, const Derivations& derivations,
               const Conflict& conflict) {
  return CoreFinder(propagator, derivations).run(conflict);
}

}  // namespace ilp
