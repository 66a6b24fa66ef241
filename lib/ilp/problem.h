/// @file
/// A 0/1 program over pairs, rings and clauses: which triangles make a surface
/// [Adamy02, Sec. 3.2], said without geometry.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ilp/rows.h"

namespace ilp {

enum class VarId : std::uint32_t {};

/// Row of `var` in a per-variable array.
constexpr std::size_t index(VarId var) { return static_cast<std::size_t>(var); }

/// "Variable `var()` has the value `value()`."
class Literal {
 public:
  Literal() = default;
  constexpr Literal(VarId var, bool value)
      : code_(2 * static_cast<std::uint32_t>(var) + (value ? 0U : 1U)) {}
  static constexpr Literal from_code(std::uint32_t code) {
    return Literal(VarId{code >> 1U}, (code & 1U) == 0);
  }
  constexpr VarId var() const { return VarId{code_ >> 1U}; }
  constexpr bool value() const { return (code_ & 1U) == 0; }
  /// Row in a per-literal array: 2 var, plus 1 if value() is false.
  constexpr std::uint32_t code() const { return code_; }
  constexpr Literal operator!() const { return from_code(code_ ^ 1U); }
  friend constexpr bool operator==(Literal, Literal) = default;
  friend constexpr auto operator<=>(Literal a, Literal b) {
    return a.code_ <=> b.code_;
  }

 private:
  std::uint32_t code_ = 0;
};

/// A variable as an edge of a ring's link graph, between the nodes a and b.
struct Spoke {
  VarId var;
  std::uint32_t a;
  std::uint32_t b;
};

/// A variable as a wall between the rooms a and b: true if they lie on
/// different sides; if inverted, true if they lie on the same side.
struct Wall {
  VarId var;
  std::uint32_t a;
  std::uint32_t b;
  bool inverted = false;
};

enum class ConstraintKind : std::uint8_t { Pair, Ring, Sides, Clause };

/// The index-th constraint of its kind, in the order of their addition.
struct ConstraintId {
  ConstraintKind kind;
  std::uint32_t index;
  friend constexpr bool operator==(const ConstraintId&,
                                   const ConstraintId&) = default;
  friend constexpr auto operator<=>(const ConstraintId& a,
                                    const ConstraintId& b) {
    const auto rank = [](const ConstraintId& id) {
      return std::uint64_t{static_cast<std::uint8_t>(id.kind)} << 32U |
             id.index;
    };
    return rank(a) <=> rank(b);
  }
};

/// The values of all variables.
using Model = std::vector<bool>;

/// The program as a plain value. At most 2^29 variables, and as many
/// constraints of each kind.
class Problem {
 public:
  VarId add_variable();
  /// @return the first of n new variables; the others follow it
  VarId add_variables(std::size_t n);

  /// None or exactly two of the variables are true [Adamy02, (3) and (4)].
  /// @throws std::invalid_argument  unknown or repeated variable
  ConstraintId add_pair(std::span<const VarId> vars);

  /// The true spokes form exactly one simple cycle of the link graph, or, if
  /// the ring is optional, none is true [Adamy02, (5) and (6)]. Two parallel
  /// spokes are a cycle.
  /// @param spokes  nodes below 2 spokes.size(), a != b; search is quickest if
  ///   each node's variables are those of some pair
  /// @throws std::invalid_argument  unknown or repeated variable, wrong node
  ConstraintId add_ring(std::span<const Spoke> spokes, bool optional = false);

  /// There is a way to put each room on one of two sides that agrees with all
  /// walls. A closed surface has it: it parts space into inside and outside.
  /// So where the variables are triangles between cells this says nothing new,
  /// but what search would find out slowly.
  /// @param walls  rooms below 2 walls.size()
  /// @throws std::invalid_argument  unknown or repeated variable, wrong room
  ConstraintId add_sides(std::span<const Wall> walls);

  /// At least one of the literals holds.
  /// @throws std::invalid_argument  unknown variable
  ConstraintId add_clause(std::span<const Literal> literals);

  /// @throws std::invalid_argument  unknown variable
  void fix(VarId var, bool value);

  std::size_t n_variables() const { return mark_.size(); }
  std::size_t n_pairs() const { return pairs_.size(); }
  std::size_t n_rings() const { return rings_.size(); }
  std::size_t n_sides() const { return sides_.size(); }
  std::size_t n_clauses() const { return clauses_.size(); }
  std::span<const VarId> pair(std::size_t i) const { return pairs_[i]; }
  std::span<const Spoke> ring(std::size_t i) const { return rings_[i]; }
  bool is_optional(std::size_t ring) const { return is_optional_[ring]; }
  std::span<const Wall> sides(std::size_t i) const { return sides_[i]; }
  std::span<const Literal> clause(std::size_t i) const { return clauses_[i]; }
  std::span<const Literal> fixed() const { return fixed_; }

 private:
  void check_known(VarId var) const;
  void check_distinct(VarId var);

  Rows<VarId> pairs_;
  Rows<Spoke> rings_;
  Rows<Wall> sides_;
  Rows<Literal> clauses_;
  std::vector<bool> is_optional_;
  std::vector<Literal> fixed_;
  std::vector<std::uint32_t> mark_;  // last check that met the variable
  std::uint32_t n_checks_ = 0;
};

/// The first constraint that the model breaks, in words; empty if none.
/// Shares no code with the solver.
std::string first_violation(const Problem& problem, const Model& model);

}  // namespace ilp
