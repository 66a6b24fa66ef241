/// @file
/// All that follows from an assignment, by all kinds of constraints.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/assignment.h"
#include "ilp/clauses.h"
#include "ilp/linear.h"
#include "ilp/pairs_rings.h"
#include "ilp/problem.h"
#include "ilp/sides.h"

namespace ilp {

class Propagator {
 public:
  /// Level 0 holds what the problem fixes; propagate() draws its conclusions.
  explicit Propagator(const Problem& problem);

  const Assignment& assignment() const { return assignment_; }
  void open_level() { assignment_.open_level(); }
  /// Makes an open literal hold by decision.
  void decide(Literal l) { assignment_.assign(l, {}); }
  /// Makes an open literal hold by a clause that forces it.
  void imply(Literal l, const Reason& clause) { assignment_.assign(l, clause); }
  /// Takes back all levels above `level`.
  void backtrack(std::uint32_t level);

  /// Assigns what follows. @return false on a conflict, kept in conflict()
  bool propagate();
  const Conflict& conflict() const { return conflict_; }
  std::uint64_t n_propagated() const { return n_propagated_; }

  /// Appends to `out` literals that came to hold before `l` did, and imply it
  /// by its reason; none for a decision.
  void explain(Literal l, std::vector<Literal>& out) const;
  /// The constraint or learned clause behind a reason.
  Antecedent origin(const Reason& reason) const;

  /// As Clauses::add(); a conflict shows in the next propagate().
  void add_clause(std::span<Literal> literals, Antecedent origin,
                  std::uint32_t glue);
  /// As Linears::add() and tighten(), at level 0; a conflict shows likewise.
  void add_linear(std::span<const Term> terms, std::int64_t bound);
  void tighten(std::uint32_t linear, std::int64_t bound);
  /// As Clauses::forget().
  void forget_clauses(const Clauses::OnForgotten& on_forgotten) {
    clauses_.forget(assignment_, on_forgotten);
  }

 private:
  bool fix(const Problem& problem);
  void add_initial_clauses(const Problem& problem);
  bool propagate(Literal l);
  void settle(std::uint32_t linear);

  Assignment assignment_;
  PairsAndRings pairs_and_rings_;
  Sides sides_;
  Clauses clauses_;
  Linears linears_;
  std::size_t n_followed_ = 0;  // of the trail
  std::uint64_t n_propagated_ = 0;
  bool is_contradictory_ = false;  // at level 0
  Conflict conflict_;
};

}  // namespace ilp
