/// @file
/// Clauses in flat arrays, and the two watched literals of each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/problem.h"

namespace ilp {

/// Position of a clause in its store; compact() changes it.
enum class ClauseRef : std::uint32_t {};

/// Sorts the literals and drops repeated ones.
/// @return false if one is the opposite of another: the clause always holds
bool normalize(std::vector<Literal>& clause);

/// A clause to be visited when its watched literal turns false, unless
/// `blocker`, another of its literals, holds.
struct Watch {
  ClauseRef clause;
  Literal blocker;
};

class ClauseStore {
 public:
  explicit ClauseStore(std::size_t n_variables) : lists_(2 * n_variables) {}

  void reserve(std::size_t n_clauses, std::size_t n_literals);

  /// Watches the first two literals, if there are two.
  /// @param glue  the smaller, the more the clause is worth; 0: kept for ever
  ClauseRef add(std::span<const Literal> literals, Antecedent origin,
                std::uint32_t glue);

  std::size_t size() const { return clauses_.size(); }
  std::span<Literal> literals(ClauseRef c) {
    return {literals_.data() + row(c).begin, row(c).size};
  }
  std::span<const Literal> literals(ClauseRef c) const {
    return {literals_.data() + row(c).begin, row(c).size};
  }
  Antecedent origin(ClauseRef c) const { return row(c).origin; }
  std::uint32_t glue(ClauseRef c) const { return row(c).glue; }

  /// Clauses to visit when `literal` turns false; good until the next watch().
  std::span<Watch> watches(Literal literal) {
    const List& list = lists_[literal.code()];
    return {watches_.data() + list.begin, list.size};
  }
  /// Appends to the watches of a literal.
  void watch(Literal literal, const Watch& w) {
    List& list = lists_[literal.code()];
    if (list.size == list.capacity) make_room(list);
    watches_[list.begin + list.size++] = w;
  }
  /// Drops those from the n-th on.
  void keep_watches(Literal literal, std::size_t n) {
    lists_[literal.code()].size = static_cast<std::uint32_t>(n);
  }

  /// Removes the clauses c with is_garbage[c]; the others keep their order.
  /// @return the new reference of each old one; that of a removed clause means
  ///   nothing
  std::vector<ClauseRef> compact(const std::vector<bool>& is_garbage);

 private:
  struct Clause {
    std::uint32_t begin;
    std::uint32_t size;
    Antecedent origin;
    std::uint32_t glue;
  };
  // A stretch of watches_; where it has to grow, it moves to the end.
  struct List {
    std::size_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
  };
  void make_room(List& list);
  void compact_watches(const std::vector<bool>& is_garbage,
                       std::span<const ClauseRef> moved);

  const Clause& row(ClauseRef c) const {
    return clauses_[static_cast<std::size_t>(c)];
  }

  std::vector<Clause> clauses_;
  std::vector<Literal> literals_;
  std::vector<List> lists_;  // by literal
  std::vector<Watch> watches_;
};

}  // namespace ilp
