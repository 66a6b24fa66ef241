/// @file
/// What a conflict teaches, and which constraints a refutation used.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/problem.h"
#include "ilp/propagate.h"
#include "ilp/solver.h"

namespace ilp {

/// A clause that follows from the constraints, and fails at present. Its first
/// literal is the only one of the highest level.
struct Lesson {
  std::vector<Literal> literals;
  std::uint32_t glue = 0;      ///< number of levels among its literals
  std::vector<VarId> touched;  ///< variables met on the way
};

/// First unique implication point [Marques99], clause minimised
/// [Soerensson09]. Its working memory is kept from call to call.
class Analyzer {
 public:
  explicit Analyzer(std::size_t n_variables)
      : mark_(n_variables, Mark::None), has_literal_(n_variables + 1, 0) {}

  /// @param conflict     not all of whose literals hold at level 0
  /// @param derivations  gets the antecedents of the lesson
  const Lesson& analyze(const Propagator& propagator, const Conflict& conflict,
                        Derivations& derivations);

  /// Puts the cycles of rings that lessons rest on there; none: nowhere.
  void set_cycles(std::set<Cycle>* cycles) { cycles_ = cycles; }

 private:
  /// Seen: resolved, in the clause, or implied by it.
  enum class Mark : std::uint8_t { None, Seen, NotImplied };

  const Assignment& assignment() const { return propagator_->assignment(); }
  bool is_seen(VarId v) const { return mark_[index(v)] == Mark::Seen; }
  void find_first_uip(const Conflict& conflict);
  void note_cycle(const Reason& reason, std::span<const Literal> literals);
  void see(std::span<const Literal> literals);
  void minimize();
  bool is_implied_by_rest(Literal l);
  bool expand(Literal l);
  void find_glue();

  const Propagator* propagator_ = nullptr;
  Derivations* derivations_ = nullptr;
  std::set<Cycle>* cycles_ = nullptr;
  Lesson lesson_;
  std::uint32_t conflict_level_ = 0;
  std::size_t n_unresolved_ = 0;  // seen literals of the conflict's level
  std::vector<Mark> mark_;        // by variable; none between calls
  std::vector<VarId> seen_, not_implied_;
  std::vector<Literal> explanation_;
  std::vector<Literal> stack_;
  std::vector<std::uint32_t> levels_;  // of the clause before it is minimised
  std::vector<std::uint8_t> has_literal_;  // by level; 0 between calls
};

/// The cycles of rings that gave values at level 0, or the conflict there.
void add_cycles_of_level_0(const Propagator& propagator,
                           const Conflict& conflict, std::set<Cycle>& cycles);

/// The constraints that together give the conflict, and the decisions of the
/// levels above 0, which are called assumptions.
/// @pre derivations.is_complete(); else constraints are missing
Core find_core(const Propagator& propagator, const Derivations& derivations,
               const Conflict& conflict);

}  // namespace ilp
