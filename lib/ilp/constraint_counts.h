/// @file
/// How many constraints of each kind there are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

class ConstraintCounts {
 public:
  explicit ConstraintCounts(const Problem& problem)
      : n_{problem.n_pairs(), problem.n_rings(), problem.n_sides(),
           problem.n_clauses(), problem.n_linear()} {}

  /// The id of one more.
  ConstraintId add(ConstraintKind kind) {
    return {kind,
            static_cast<std::uint32_t>(n_[static_cast<std::size_t>(kind)]++)};
  }

  /// All of them, ascending.
  std::vector<ConstraintId> ids() const {
    std::vector<ConstraintId> ids;
    for (std::size_t kind = 0; kind < n_.size(); ++kind)
      for (std::uint32_t i = 0; i < n_[kind]; ++i)
        ids.push_back({static_cast<ConstraintKind>(kind), i});
    return ids;
  }

 private:
  std::array<std::size_t, 5> n_;  // by kind
};

}  // namespace ilp
