/// @file
/// What pairs and rings force.
#pragma once

#include <cstdint>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/assignment.h"
#include "ilp/links.h"

namespace ilp {

/// All rules but one: that a ring has a true spoke at all is left to a clause.
class PairsAndRings {
 public:
  explicit PairsAndRings(const Problem& problem);

  /// Assigns what pairs of one variable force. @return false on a conflict
  bool start(Assignment& assignment, Conflict& conflict);

  /// Counts a literal that holds, once, and assigns what follows.
  /// @return false on a conflict
  bool propagate(Literal l, Assignment& assignment, Conflict& conflict);
  /// Takes back the counting, in reverse order.
  void undo(Literal l);

  /// Appends the literals that imply l by its reason, a pair or a ring.
  void explain(Literal l, const Assignment& assignment,
               std::vector<Literal>& out) const;
  Antecedent origin(const Reason& reason) const;

 private:
  // A set of variables by its size, times 2^32, plus the sum of their numbers.
  // With numbers below 2^29, size() is exact up to 2, and more beyond; the one
  // of a set of one is known, and so is the other of two.
  class VarSum {
   public:
    void add(VarId v) { sum_ += key(v); }
    void remove(VarId v) { sum_ -= key(v); }
    std::uint32_t size() const {
      return static_cast<std::uint32_t>(sum_ >> 32U);
    }
    /// @pre the set is {the result}, or {v, the result}
    VarId only() const { return VarId{static_cast<std::uint32_t>(sum_)}; }
    VarId other_than(VarId v) const {
      return VarId{static_cast<std::uint32_t>(sum_ - key(v))};
    }

   private:
    static constexpr std::uint64_t key(VarId v) {
      return (std::uint64_t{1} << 32U) + index(v);
    }
    std::uint64_t sum_ = 0;
  };
  // The variables of a pair that are not counted yet, and those that are
  // counted as true.
  struct PairCount {
    VarSum open;
    VarSum trues;
  };
  // A ring of a variable, and the ends of its spoke there.
  struct Membership {
    std::uint32_t ring;
    std::uint32_t pair_a;
    std::uint32_t pair_b;
  };

  bool count(Literal l);
  bool force_last(std::uint32_t p, Assignment& assignment,
                  Conflict& conflict) const;
  bool clear_pair(std::uint32_t p, Assignment& assignment,
                  Conflict& conflict) const;
  bool fail_pair(std::uint32_t p, const Assignment& assignment,
                 Conflict& conflict) const;
  bool has_mates(const Membership& m) const {
    return pairs_[m.pair_a].trues.size() == 2 &&
           pairs_[m.pair_b].trues.size() == 2;
  }
  /// Of the true spokes that close a cycle through `var`; 0: there is none.
  /// @pre it has mates on both sides
  std::size_t cycle_length(VarId var, const Membership& m) const;
  bool clear_ring(const Reason& reason, std::size_t length,
                  Assignment& assignment, Conflict& conflict);
  VarId spoke_off(std::span<const Literal> cycle, std::span<const Spoke> spokes,
                  const Assignment& assignment);
  void explain_pair(Literal l, const Assignment& assignment,
                    std::vector<Literal>& out) const;
  const Membership& membership(VarId var, std::uint32_t ring) const;
  VarId next_on_ring(std::uint32_t ring, VarId var, std::uint32_t& pair) const;
  void append_cycle(const Reason& reason, std::vector<Literal>& out) const;

  Links links_;
  std::vector<PairCount> pairs_;
  Rows<Membership> rings_of_;
  std::vector<std::uint8_t> is_on_cycle_;  // scratch, by variable; 0 at rest
};

}  // namespace ilp
