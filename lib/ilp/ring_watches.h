/// @file
/// That a required ring has a true spoke, by two watched spokes of each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ilp/assignment.h"
#include "ilp/problem.h"

namespace ilp {

/// A clause for each ring, but kept without a copy of its literals and without
/// lists: what turns false asks its few rings whether they watch it.
class RingWatches {
 public:
  explicit RingWatches(const Problem& problem);

  /// Assigns the spoke of each ring of one. @return false on a conflict: a ring
  /// of none, or whose one spoke is false
  bool start(const Rows<Spoke>& rings, Assignment& assignment,
             Conflict& conflict) const;

  bool watches(std::uint32_t ring, VarId spoke) const {
    return pairs_[ring].a == spoke || pairs_[ring].b == spoke;
  }

  struct Ring {
    std::uint32_t index;
    std::span<const Spoke> spokes;
  };
  /// Watches another spoke in place of one that is false, or assigns the last.
  /// @return false on a conflict
  bool replace(const Ring& ring, VarId failing, Assignment& assignment,
               Conflict& conflict);

  /// Appends the literals that imply l, the last spoke of the ring.
  static void explain(Literal l, std::span<const Spoke> spokes,
                      std::vector<Literal>& out);

 private:
  static constexpr VarId kNone{0xffff'ffffU};
  struct Pair {
    VarId a = kNone;  // of an optional ring, or one of one spoke: none
    VarId b = kNone;
    std::uint32_t next = 0;  // spoke to look at
  };

  static bool force(const Ring& ring, VarId last, Assignment& assignment,
                    Conflict& conflict);

  std::vector<Pair> pairs_;           // by ring
  std::vector<std::uint32_t> short_;  // required rings of less than two spokes
};

}  // namespace ilp
