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

/// What is known of a set of variables by adding them up.
struct VarSum {
  std::uint32_t n = 0;
  std::uint32_t bits = 0;  ///< the XOR of their numbers
  void add(VarId v) {
    ++n;
    bits ^= static_cast<std::uint32_t>(v);
  }
  friend bool operator==(VarSum, VarSum) = default;
};

struct Links {
  /// The problem's pairs, then those that a ring implies at a node whose
  /// variables no pair of the problem lists.
  Rows<VarId> pairs;
  /// What the problem calls the pair: itself, or the ring that implies it.
  std::vector<ConstraintId> pair_origin;
  std::vector<VarSum> sums;      ///< of each pair
  Rows<std::uint32_t> pairs_of;  ///< by variable, ascending
  Rows<LinkedSpoke> rings;
};

Links link(const Problem& problem);

}  // namespace ilp
