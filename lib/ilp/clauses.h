/// @file
/// What clauses force, by two watched literals [Moskewicz01].
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/assignment.h"
#include "ilp/clause_store.h"

namespace ilp {

class Clauses {
 public:
  explicit Clauses(std::size_t n_variables) : store_(n_variables) {}

  /// Makes room for so many clauses.
  void reserve(std::size_t n_clauses, std::size_t n_literals) {
    store_.reserve(n_clauses, n_literals);
  }

  /// Adds a clause that the levels above 0 do not make false, and assigns the
  /// literal that it forces, if any, at the current level: backtrack first to
  /// where that belongs. May reorder the literals.
  /// @param glue  the smaller, the more the clause is worth; 0: kept for ever
  /// @return false if level 0 makes it false: a conflict
  bool add(std::span<Literal> literals, Antecedent origin, std::uint32_t glue,
           Assignment& assignment, Conflict& conflict);

  /// Assigns what follows from a literal that holds.
  /// @return false on a conflict
  bool propagate(Literal l, Assignment& assignment, Conflict& conflict) {
    return store_.watches(!l).empty() || visit_all(!l, assignment, conflict);
  }

  /// Appends the literals that imply l by its reason, a clause.
  void explain(Literal l, const Assignment& assignment,
               std::vector<Literal>& out) const;
  Antecedent origin(const Reason& reason) const {
    return store_.origin(ClauseRef{reason.index});
  }

  /// Removes the worse half of the clauses with glue above 2, but none that is
  /// a reason.
  using OnForgotten = std::function<void(std::span<const Literal>)>;
  void forget(Assignment& assignment, const OnForgotten& on_forgotten);

 private:
  bool visit_all(Literal failing, Assignment& assignment, Conflict& conflict);
  enum class Visit { Kept, Moved, Failed };
  Visit visit(Watch& watch, Literal failing, Assignment& assignment,
              Conflict& conflict);
  bool fail(ClauseRef c, Conflict& conflict) const;

  ClauseStore store_;
};

}  // namespace ilp
