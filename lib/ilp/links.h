/// @file
/// A problem with every node of every link graph named by a pair constraint,
/// so that one set of counters serves pairs and rings.
#pragma once

#include <vector>

#include "ilp/problem.h"
#include "ilp/rows.h"

namespace ilp {

/// A spoke whose ends are pairs. The spokes of one node are exactly the
/// variables of its pair.
struct LinkedSpoke {
  VarId var;
  std::uint32_t pair_a;
  std::uint32_t pair_b;
};

struct Links {
  /// The problem's pairs, then those that a ring implies at a node whose
  /// variables no pair of the problem lists.
  Rows<VarId> pairs;
  /// What the problem calls the pair: itself, or the ring that implies it.
  std::vector<ConstraintId> pair_origin;
  Rows<LinkedSpoke> rings;
};

Links link(const Problem& problem);

}  // namespace ilp
