/// @file
/// A problem with every node of every link graph named by a pair constraint,
/// so that one set of counters serves pairs and rings.
#pragma once

#include <vector>

#include "ilp/problem.h"
#include "ilp/rows.h"

namespace ilp {

struct Links {
  /// The problem's pairs, then those that a ring implies at a node whose
  /// variables no pair of the problem lists.
  Rows<VarId> pairs;
  std::vector<std::uint32_t> implied_by;  ///< rings, of the latter pairs
  Rows<std::uint32_t> pairs_of;           ///< by variable, ascending
  /// With pairs as nodes: the spokes of one are exactly its variables.
  Rows<Spoke> rings;

  /// What the problem calls the pair: itself, or the ring that implies it.
  ConstraintId origin(std::uint32_t pair) const {
    const auto n_own =
        static_cast<std::uint32_t>(pairs.size() - implied_by.size());
    if (pair < n_own) return {ConstraintKind::Pair, pair};
    return {ConstraintKind::Ring, implied_by[pair - n_own]};
  }
};

Links link(const Problem& problem);

}  // namespace ilp
