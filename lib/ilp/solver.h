/// @file
/// Conflict-driven search for a solution of a 0/1 program.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

enum class Status {
  Feasible,    ///< there is a model
  Optimal,     ///< there is a model, and no better one
  Infeasible,  ///< there is none
  Limit        ///< not known within the limits
};

/// How long a call may take. Counts give the same result on every run.
struct Limits {
  std::uint64_t conflicts = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t propagations = std::numeric_limits<std::uint64_t>::max();
  double seconds = std::numeric_limits<double>::infinity();
  /// The call ends soon after this becomes true; may be set by any thread or
  /// by a signal handler, and must outlive the call.
  const std::atomic<bool>* stop = nullptr;
};

/// Totals since the solver was made.
struct Statistics {
  std::uint64_t conflicts = 0;
  std::uint64_t decisions = 0;
  std::uint64_t propagations = 0;  ///< literals assigned and followed up
  std::uint64_t restarts = 0;
};

/// Why there is no model: with the problem's fixed values, these constraints
/// and assumptions contradict each other. Few, not always fewest.
struct Core {
  std::vector<ConstraintId> constraints;  ///< ascending
  std::vector<Literal> assumptions;       ///< ascending
};

enum class Branching {
  Static,   ///< always by priority: the first model is the least (improve.h)
  Adaptive  ///< variables of recent conflicts first
};

class ProofLog;

class Solver {
 public:
  explicit Solver(const Problem& problem);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Variables to decide first, each once; the others follow by number. A
  /// decision sets its variable false, unless prefer() says otherwise.
  void set_priority(std::span<const VarId> order);
  void set_branching(Branching branching);

  /// Adaptive decisions set the variable so; without a word, false.
  /// @throws std::invalid_argument  unknown variable
  void prefer(std::span<const Literal> values);

  /// Adds a constraint for all later calls.
  /// @return its id: clauses are counted on from those of the problem
  /// @throws std::invalid_argument  unknown variable
  ConstraintId add_clause(std::span<const Literal> literals);

  /// Likewise; the terms as for Problem::add_linear().
  ConstraintId add_linear(std::span<const Term> terms, std::int64_t bound);

  /// From now on models must have a smaller sum than the last one found.
  /// @return the linear constraint that says so; a call with the same terms as
  ///   the call before tightens it
  /// @throws std::invalid_argument  as Problem::add_linear()
  /// @pre the last solve() or solve_assumed() returned Feasible
  ConstraintId require_better(std::span<const Term> sum);

  /// Looks for a model in which the assumptions hold. What was learned serves
  /// later calls; those whose assumptions begin alike are the quickest.
  /// @return Feasible, Infeasible or Limit
  /// @throws std::invalid_argument  unknown variable
  Status solve(std::span<const Literal> assumptions = {},
               const Limits& limits = {});

  /// One assumption more after those of the last call.
  /// @throws std::invalid_argument  unknown variable
  void assume(Literal l);
  /// Takes the last one back. @pre there is one
  void retract();
  /// Like solve(), under these. What was assumed in the last call as well costs
  /// nothing, however much it is, unless that met a limit, or a linear
  /// constraint or a priority came since.
  Status solve_assumed(const Limits& limits = {});

  /// The last model found; all false before.
  const Model& model() const;

  /// @pre the last solve() or solve_assumed() returned Infeasible. After some
  ///   3 10^7 steps of derivation the solver forgets them, and then names all
  ///   constraints.
  Core core() const;

  Statistics statistics() const;

  /// From now on keeps the cycles of rings that learned clauses rest on.
  void keep_cycles();
  /// Those, and the ones behind what holds without any decision: the cuts (6)
  /// of [Adamy02] that the search has needed so far. Each once, ascending.
  std::vector<Cycle> cycles() const;

  /// Writes what is derived from now on; none: stops that. A log from the first
  /// solve() on lets a ProofChecker follow every Infeasible.
  /// @param log  must outlive its use
  void set_log(ProofLog* log);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace ilp
