/// @file
/// A 0/1 program over pairs, rings, clauses and linear constraints: which
/// triangles make a surface [Adamy02, Sec. 3.2], said without geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ilp/constraint.h"
#include "ilp/rows.h"

namespace ilp {

/// So no sum of a linear constraint overflows, with room to spare.
inline constexpr std::int64_t kMaxLinearSum = std::int64_t{1} << 61U;

/// Whether |bound| and the |coefficients| add up to at most kMaxLinearSum.
bool is_in_range(std::span<const Term> terms, std::int64_t bound);

inline constexpr std::size_t kMaxVariables = std::size_t{1} << 29U;

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

  /// The same with pairs of the problem as nodes: a and b are their numbers. A
  /// solver need not find out then which pair is where.
  /// @throws std::invalid_argument  unknown or repeated variable, unknown pair,
  ///   a == b, or a pair whose variables are not the spokes at it
  ConstraintId add_ring_of_pairs(std::span<const Spoke> spokes,
                                 bool optional = false);

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

  /// The sum of the terms is at most `bound`.
  /// @throws std::invalid_argument  unknown or repeated variable; the absolute
  ///   values of the numbers add up to more than kMaxLinearSum
  ConstraintId add_linear(std::span<const Term> terms, std::int64_t bound);

  /// @throws std::invalid_argument  unknown variable
  void fix(VarId var, bool value);

  std::size_t n_variables() const { return mark_.size(); }
  std::size_t n_pairs() const { return pairs_.size(); }
  std::size_t n_rings() const { return rings_.size(); }
  std::size_t n_sides() const { return sides_.size(); }
  std::size_t n_clauses() const { return clauses_.size(); }
  std::size_t n_linear() const { return linear_.size(); }
  std::span<const VarId> pair(std::size_t i) const { return pairs_[i]; }
  const Rows<VarId>& pairs() const { return pairs_; }
  std::span<const Spoke> ring(std::size_t i) const { return rings_[i]; }
  const Rows<Spoke>& rings() const { return rings_; }
  bool is_optional(std::size_t ring) const { return is_optional_[ring]; }
  /// Whether its nodes are pairs.
  bool is_of_pairs(std::size_t ring) const { return is_of_pairs_[ring]; }
  std::span<const Wall> sides(std::size_t i) const { return sides_[i]; }
  std::span<const Literal> clause(std::size_t i) const { return clauses_[i]; }
  std::span<const Term> linear(std::size_t i) const { return linear_[i]; }
  std::int64_t bound(std::size_t linear) const { return bounds_[linear]; }
  std::span<const Literal> fixed() const { return fixed_; }

 private:
  void check_spokes(std::span<const Spoke> spokes, std::size_t n_nodes);
  void check_pairs_of(std::span<const Spoke> spokes);
  ConstraintId append_ring(std::span<const Spoke> spokes, bool optional,
                           bool of_pairs);
  void check_known(VarId var) const;
  void check_distinct(VarId var);

  Rows<VarId> pairs_;
  Rows<Spoke> rings_;
  Rows<Wall> sides_;
  Rows<Literal> clauses_;
  Rows<Term> linear_;
  std::vector<std::int64_t> bounds_;
  std::vector<bool> is_optional_;
  std::vector<bool> is_of_pairs_;
  std::vector<Literal> fixed_;
  std::vector<std::uint32_t> mark_;  // last check that met the variable
  std::uint32_t n_checks_ = 0;
  std::vector<std::uint32_t> n_met_;  // spokes, by pair; scratch, 0 at rest
};

/// The first constraint that the model breaks, in words; empty if none.
/// Shares no code with the solver.
std::string first_violation(const Problem& problem, const Model& model);

}  // namespace ilp
