/// @file
/// What linear constraints force.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/assignment.h"
#include "ilp/problem.h"

namespace ilp {

/// Constraints sum a_i x_i <= b. They may join, and their bounds shrink, while
/// the search is at level 0.
class Linears {
 public:
  explicit Linears(const Problem& problem);

  /// Adds a constraint; its number follows those of the problem. What it forces
  /// now is for settle().
  /// @param counted  the literals that count() has seen
  void add(std::span<const Term> terms, std::int64_t bound,
           std::span<const Literal> counted);
  /// @param bound  at most the present one
  void tighten(std::uint32_t row, std::int64_t bound);

  /// Assigns what one row or all rows force. @return false on a conflict
  bool settle(std::uint32_t row, Assignment& assignment, Conflict& conflict);
  bool start(Assignment& assignment, Conflict& conflict);

  /// Counts a literal that holds, once.
  void count(Literal l) {
    if (!rows_.empty()) take(l);
  }
  /// Assigns what follows from a literal that is counted.
  /// @return false on a conflict
  bool propagate(Literal l, Assignment& assignment, Conflict& conflict) {
    return rows_.empty() || settle_rows_of(l, assignment, conflict);
  }
  /// Takes back the counting.
  void undo(Literal l) {
    if (!rows_.empty()) give_back(l);
  }
  /// To be called when variables open again.
  void reopen() { ++n_reopened_; }

  /// Appends the literals that imply l by its reason, a linear constraint.
  void explain(Literal l, const Assignment& assignment,
               std::vector<Literal>& out) const;

  std::uint32_t size() const {
    return static_cast<std::uint32_t>(rows_.size());
  }

 private:
  // A row says: the weights of the literals that hold are at most the bound.
  struct WeightedLiteral {
    Literal literal;
    std::int64_t weight;  // positive
  };
  struct Row {
    std::vector<WeightedLiteral> terms;  // heaviest first
    std::int64_t bound = 0;
    std::int64_t offset = 0;  // by which the bound as given was less
    std::int64_t slack = 0;   // the bound less the weights counted
    // The terms before `first` were not open after the n-th reopening.
    std::size_t first = 0;
    std::uint64_t n_reopened = 0;
  };
  struct Occurrence {
    std::uint32_t row;
    std::int64_t weight;
  };

  void take(Literal l);
  void give_back(Literal l);
  bool settle_rows_of(Literal l, Assignment& assignment, Conflict& conflict);
  std::uint32_t add_row(std::span<const Term> terms, std::int64_t bound);
  struct Until {
    std::uint32_t position;  // in the trail
    std::int64_t limit;      // of weight
  };
  static void append_heaviest(const Row& row, const Assignment& assignment,
                              Until until, std::vector<Literal>& out);
  static Row normal_form(std::span<const Term> terms, std::int64_t bound);

  std::size_t n_variables_;
  std::vector<Row> rows_;
  std::vector<std::vector<Occurrence>> rows_of_;  // by literal, once needed
  std::uint64_t n_reopened_ = 0;
};

}  // namespace ilp
