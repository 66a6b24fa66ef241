/// @file
/// The assignment of a search and what follows from it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/clause_store.h"
#include "ilp/links.h"
#include "ilp/problem.h"

namespace ilp {

/// What forced a literal.
struct Reason {
  enum class Kind : std::uint32_t { None, Pair, Ring, Clause };
  Kind kind = Kind::None;   ///< None: a decision, or fixed by the problem
  std::uint32_t index = 0;  ///< of the pair, the ring or the clause
  VarId on_cycle{};         ///< Ring: a spoke of the cycle that closed
};

/// Literals that hold and contradict each other, by one constraint.
struct Conflict {
  Reason reason;
  std::vector<Literal> literals;
};

class Propagator {
 public:
  /// Level 0 holds what the problem fixes; propagate() draws its conclusions.
  explicit Propagator(const Problem& problem);

  std::size_t n_variables() const { return states_.size(); }
  bool holds(Literal l) const { return values_[l.code()] == kHolds; }
  bool is_open(VarId v) const { return values_[2 * index(v)] == kOpen; }
  std::uint32_t level(VarId v) const { return states_[index(v)].level; }
  Reason reason(VarId v) const { return states_[index(v)].reason; }

  /// All literals that hold, in the order in which they came to do so.
  std::span<const Literal> trail() const { return trail_; }
  std::uint32_t n_levels() const {
    return static_cast<std::uint32_t>(level_begin_.size());
  }
  /// Size of the trail before level `level` >= 1 was opened.
  std::size_t begin_of_level(std::uint32_t level) const {
    return level_begin_[level - 1];
  }
  std::uint64_t n_propagated() const { return n_propagated_; }

  void open_level() {
    level_begin_.push_back(static_cast<std::uint32_t>(trail_.size()));
  }
  /// Makes an open literal hold.
  void assign(Literal l, Reason reason);
  /// Takes back all levels above `level`.
  void backtrack(std::uint32_t level);

  /// Assigns what follows. @return false on a conflict, kept in conflict()
  bool propagate();
  const Conflict& conflict() const { return conflict_; }

  /// Appends to `out` literals that came to hold before `l` did, and imply it
  /// by its reason; none for a decision.
  void explain(Literal l, std::vector<Literal>& out) const;
  /// The constraint or learned clause behind a reason.
  Antecedent origin(const Reason& reason) const;

  /// Adds a clause that the levels above 0 do not make false, and assigns the
  /// literal that it forces, if any, at the current level: backtrack first to
  /// where that belongs. May reorder the literals.
  /// @return false if level 0 makes it false: a conflict
  bool add_clause(std::span<Literal> literals, Antecedent origin,
                  std::uint32_t glue);
  const ClauseStore& clauses() const { return clauses_; }
  /// Removes the worse half of the clauses with glue above 2, but none that is
  /// a reason.
  void forget_clauses();

 private:
  static constexpr std::uint8_t kFails = 0, kHolds = 1, kOpen = 2;

  struct VarState {
    std::uint32_t level = 0;
    std::uint32_t position = 0;  // in the trail
    Reason reason;
  };
  // The variables of a pair that are not counted yet, and those that are
  // counted as true. One left in a set is the set's XOR.
  struct PairCount {
    std::uint32_t n_open = 0;
    std::uint32_t n_true = 0;
    std::uint32_t open_xor = 0;
    std::uint32_t true_xor = 0;
  };
  // A ring of a variable, and the ends of its spoke there.
  struct Membership {
    std::uint32_t ring;
    std::uint32_t pair_a;
    std::uint32_t pair_b;
  };

  enum class Visit { Kept, Moved, Failed };

  void fix(const Problem& problem);
  void add_initial_clauses(const Problem& problem);
  bool count(Literal l);
  void uncount(Literal l);
  bool fail(const Reason& reason);
  bool fail_clause(ClauseRef c);
  bool propagate_pairs(VarId var);
  bool propagate_pair(std::uint32_t p);
  bool clear_pair(std::uint32_t p);
  bool close_rings(VarId var);
  bool closes_cycle(VarId var, const Membership& m) const;
  bool clear_ring(std::uint32_t ring, VarId on_cycle);
  bool propagate_clauses(Literal holding);
  Visit visit(Watch& watch, Literal failing);
  void explain_pair(Literal l, std::vector<Literal>& out) const;
  const Membership& membership(VarId var, std::uint32_t ring) const;
  VarId next_on_ring(std::uint32_t ring, VarId var, std::uint32_t& pair) const;
  void append_cycle(std::uint32_t ring, VarId on_cycle,
                    std::vector<Literal>& out) const;
  bool is_counted(VarId v) const {
    return states_[index(v)].position < n_counted_;
  }
  Literal holding_literal(VarId v) const {
    return Literal(v, values_[2 * index(v)] == kHolds);
  }

  Links links_;
  std::vector<PairCount> pairs_;
  Rows<std::uint32_t> pairs_of_;
  Rows<Membership> rings_of_;
  ClauseStore clauses_;

  std::vector<std::uint8_t> values_;  // by literal
  std::vector<VarState> states_;
  std::vector<Literal> trail_;
  std::vector<std::uint32_t> level_begin_;
  std::size_t n_counted_ = 0;  // of the trail
  std::uint64_t n_propagated_ = 0;
  bool is_contradictory_ = false;  // at level 0
  Conflict conflict_;
  std::vector<Literal> cycle_;             // scratch
  std::vector<std::uint8_t> is_on_cycle_;  // scratch, by variable; 0 at rest
};

}  // namespace ilp
