/// @file
/// Checks the log of a search. Shares no code with the search: it propagates in
/// the plainest way, each constraint from scratch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

class ProofChecker {
 public:
  /// @param objective  the sum that `m` lines make smaller
  explicit ProofChecker(const Problem& problem,
                        std::span<const Term> objective = {});

  /// Reads a log to its end, or to the first line that is wrong.
  /// @return what is wrong, with the number of the line; empty if nothing is
  std::string first_flaw(std::istream& log);

  /// The lines so far leave no model (but those of the `m` lines).
  bool is_refuted() const { return is_refuted_; }
  /// The objective of the last `m` line.
  std::optional<std::int64_t> best() const { return best_; }
  /// Whether the clause follows by propagation from the lines so far.
  bool implies(std::span<const Literal> clause);

 private:
  struct Constraint {
    ConstraintKind kind;
    std::uint32_t row;  // in the problem, or in clauses_ or linear_
  };
  struct Linear {
    std::vector<Term> terms;
    std::int64_t bound;
  };

  // The constraint that is added next has the variable.
  void watch(VarId v) {
    constraints_of_[index(v)].push_back(constraints_.size());
  }
  void add_clause(std::vector<Literal> clause);
  void add_linear(Linear linear);
  void join(Linear linear);
  bool remove_clause(std::vector<Literal> clause);

  std::string read_line(std::istream& line);
  std::string read_model(std::span<const Literal> literals);
  std::string read_linear(std::istream& line);

  bool is_open(VarId v) const { return !value_[index(v)].has_value(); }
  bool is_true(VarId v) const { return value_[index(v)] == true; }
  bool holds(Literal l) const { return value_[index(l.var())] == l.value(); }
  bool set(VarId v, bool value);
  void settle();
  bool propagate();
  bool visit(const Constraint& constraint);
  bool visit_none_or_two(std::span<const VarId> vars);
  bool visit_ring(std::span<const Spoke> spokes, bool optional);
  bool visit_cycles(std::span<const Spoke> spokes);
  bool visit_clause(std::span<const Literal> clause);
  bool visit_linear(const Linear& linear);
  bool visit_sides(std::span<const Wall> walls);

  const Problem& problem_;
  std::vector<Constraint> constraints_;
  std::vector<std::vector<std::size_t>> constraints_of_;  // by variable
  std::vector<std::vector<Literal>> clauses_;
  std::map<std::vector<Literal>, std::vector<std::size_t>> number_of_clause_;
  std::vector<Linear> linear_;

  std::vector<std::optional<bool>> value_;
  std::vector<VarId> trail_;
  std::size_t n_followed_ = 0;
  bool is_refuted_ = false;

  std::vector<Term> objective_;
  std::optional<std::int64_t> best_;
};

}  // namespace ilp
