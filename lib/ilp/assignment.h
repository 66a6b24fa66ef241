/// @file
/// The values of the variables in a search, and why they have them.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

/// What forced a literal.
struct Reason {
  enum class Kind : std::uint32_t { None, Pair, Ring, Sides, Clause, Linear };
  Kind kind = Kind::None;   ///< None: a decision, or fixed by the problem
  std::uint32_t index = 0;  ///< of the pair, ring, wall, clause or row
  VarId on_cycle{};         ///< Ring: a spoke of the cycle that closed
};

/// Literals that hold and contradict each other, by one constraint.
struct Conflict {
  Reason reason;
  std::vector<Literal> literals;
};

class Assignment {
 public:
  explicit Assignment(std::size_t n_variables)
      : values_(2 * n_variables, kOpen), states_(n_variables) {
    trail_.reserve(n_variables);
  }

  std::size_t n_variables() const { return values_.size() / 2; }
  bool holds(Literal l) const { return values_[l.code()] == kHolds; }
  bool is_open(VarId v) const { return values_[2 * index(v)] == kOpen; }
  bool is_true(VarId v) const { return values_[2 * index(v)] == kHolds; }
  /// The literal of v that holds. @pre v is not open
  Literal literal(VarId v) const { return Literal(v, is_true(v)); }

  std::uint32_t level(VarId v) const { return states_[index(v)].level; }
  /// In the trail.
  std::uint32_t position(VarId v) const { return states_[index(v)].position; }
  const Reason& reason(VarId v) const { return states_[index(v)].reason; }
  void set_reason_index(VarId v, std::uint32_t i) {
    states_[index(v)].reason.index = i;
  }

  /// All literals that hold, in the order in which they came to do so.
  std::span<const Literal> trail() const { return trail_; }
  std::uint32_t n_levels() const {
    return static_cast<std::uint32_t>(level_begin_.size());
  }
  /// Size of the trail before level `level` >= 1 was opened.
  std::size_t begin_of_level(std::uint32_t level) const {
    return level_begin_[level - 1];
  }

  void open_level() {
    level_begin_.push_back(static_cast<std::uint32_t>(trail_.size()));
  }

  /// Makes an open literal hold.
  void assign(Literal l, const Reason& reason) {
    assert(is_open(l.var()));
    values_[l.code()] = kHolds;
    values_[(!l).code()] = kFails;
    states_[index(l.var())] = {
        n_levels(), static_cast<std::uint32_t>(trail_.size()), reason};
    trail_.push_back(l);
  }

  /// Opens the variables of all levels above `level` < n_levels() again.
  void backtrack(std::uint32_t level) {
    const std::size_t n_kept = begin_of_level(level + 1);
    for (const Literal l : trail().subspan(n_kept))
      values_[l.code()] = values_[(!l).code()] = kOpen;
    trail_.resize(n_kept);
    level_begin_.resize(level);
  }

 private:
  static constexpr std::uint8_t kFails = 0, kHolds = 1, kOpen = 2;
  struct State {
    std::uint32_t level = 0;
    std::uint32_t position = 0;
    Reason reason;
  };

  std::vector<std::uint8_t> values_;  // by literal
  std::vector<State> states_;
  std::vector<Literal> trail_;
  std::vector<std::uint32_t> level_begin_;
};

}  // namespace ilp
