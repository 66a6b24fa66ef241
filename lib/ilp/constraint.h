/// @file
/// The words of a 0/1 program: variables, literals, parts of constraints.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// `coefficient` times the value of `var`.
struct Term {
  VarId var;
  std::int64_t coefficient;
  friend constexpr bool operator==(const Term&, const Term&) = default;
};

/// A cycle of a ring's link graph: where it is true, all other spokes of the
/// ring are false.
struct Cycle {
  std::uint32_t ring;
  std::vector<VarId> spokes;
  friend bool operator==(const Cycle&, const Cycle&) = default;
  friend auto operator<=>(const Cycle&, const Cycle&) = default;
};

enum class ConstraintKind : std::uint8_t { Pair, Ring, Sides, Clause, Linear };

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

}  // namespace ilp
