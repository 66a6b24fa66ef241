/// @file
/// What each learned clause was derived from: enough to name, for a refutation,
/// the constraints that it used.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

/// One thing that a derivation used: a constraint of the problem, a learned
/// clause, or the value of a variable at level 0.
class Antecedent {
 public:
  Antecedent() = default;
  explicit constexpr Antecedent(ConstraintId id)
      : Antecedent(static_cast<Kind>(id.kind), id.index) {}
  static constexpr Antecedent learned(std::uint32_t number) {
    return Antecedent(Kind::Learned, number);
  }
  static constexpr Antecedent value_of(VarId var) {
    return Antecedent(Kind::Value, static_cast<std::uint32_t>(var));
  }
  static constexpr Antecedent nothing() { return Antecedent(Kind::Nothing, 0); }

  constexpr bool is_constraint() const { return kind() < Kind::Learned; }
  constexpr bool is_learned() const { return kind() == Kind::Learned; }
  constexpr bool is_value() const { return kind() == Kind::Value; }
  constexpr ConstraintId constraint() const {
    return {static_cast<ConstraintKind>(kind()), index()};
  }
  /// Number of the learned clause, or of the variable.
  constexpr std::uint32_t index() const { return bits_ & kMaxIndex; }
  friend constexpr bool operator==(Antecedent, Antecedent) = default;
  friend constexpr auto operator<=>(Antecedent a, Antecedent b) {
    return a.bits_ <=> b.bits_;
  }

  static constexpr std::uint32_t kMaxIndex = (1U << 29U) - 1;

 private:
  enum class Kind : std::uint32_t { Learned = 5, Value = 6, Nothing = 7 };
  constexpr Antecedent(Kind kind, std::uint32_t index)
      : bits_(static_cast<std::uint32_t>(kind) << 29U | index) {}
  constexpr Kind kind() const { return static_cast<Kind>(bits_ >> 29U); }

  std::uint32_t bits_ = 0;
};

/// The derivation of every learned clause, in the order of learning. Kept
/// within a fixed size: past it, all derivations are given up.
class Derivations {
 public:
  /// @param max_items  bound on the memory, 4 bytes an item
  explicit Derivations(std::size_t max_items) : max_items_(max_items) {}

  /// Appends to the derivation of the next clause.
  void use(Antecedent a) {
    if (is_complete_) pending_.push_back(a);
  }
  /// Number of antecedents of the next clause so far; drop(n) returns to n.
  std::size_t n_used() const { return pending_.size(); }
  void drop(std::size_t n) { pending_.resize(n); }
  /// Ends the derivation. @return how later derivations call the clause
  Antecedent learn();

  /// False: too much was learned, and nothing is known.
  bool is_complete() const { return is_complete_; }
  std::span<const Antecedent> of(Antecedent learned) const {
    return rows_[learned.index()];
  }

 private:
  std::size_t max_items_;
  bool is_complete_ = true;
  std::vector<Antecedent> pending_;
  Rows<Antecedent> rows_;
};

}  // namespace ilp
