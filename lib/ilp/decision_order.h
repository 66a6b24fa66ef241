/// @file
/// Which variable a search decides next.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ilp/problem.h"

namespace ilp {

/// Variables that took part in recent conflicts come first, by activity
/// [Moskewicz01]; the others by a fixed order.
class DecisionOrder {
 public:
  explicit DecisionOrder(std::size_t n_variables);

  /// The fixed order: these variables, then all others by number. Forgets all
  /// activity.
  void set_priority(std::span<const VarId> first);

  /// Makes `var` more active than any that was not bumped lately.
  void bump(VarId var);
  /// Makes later bumps count for more.
  void decay() { increment_ /= 0.95; }
  /// Returns to the fixed order.
  void forget_activity();

  /// To be called for every variable that opens again.
  void reopen(VarId var) {
    n_passed_ = std::min<std::size_t>(n_passed_, rank_[index(var)]);
    if (is_active(var) && place_[index(var)] == kNotInHeap) push(var);
  }

  struct Choice {
    VarId var;
    bool is_in_order;  ///< no open variable has any activity
  };
  /// The first open variable; the number of variables if none is.
  template <class IsOpen>
  Choice next(IsOpen is_open) {
    while (!heap_.empty()) {
      const VarId var = pop();
      if (is_open(var)) return {var, false};
    }
    const auto n = static_cast<std::uint32_t>(order_.size());
    for (; n_passed_ < n; ++n_passed_)
      if (is_open(order_[n_passed_])) return {order_[n_passed_], true};
    return {VarId{n}, true};
  }

 private:
  static constexpr std::uint32_t kNotInHeap = 0xffff'ffffU;

  bool is_active(VarId var) const {
    return !active_.empty() && activity_[index(var)] > 0;
  }
  bool precedes(VarId a, VarId b) const;
  void place(std::size_t i, VarId var);
  void push(VarId var);
  VarId pop();
  void sift_up(std::size_t i);
  void sift_down(std::size_t i);

  std::vector<VarId> order_;
  std::vector<std::uint32_t> rank_;  // in order_
  std::size_t n_passed_ = 0;         // of order_: not open

  std::vector<VarId> heap_;  // every open variable with activity, and others
  // By variable; empty before the first bump.
  std::vector<std::uint32_t> place_;  // in the heap
  std::vector<double> activity_;
  std::vector<VarId> active_;
  double increment_ = 1;
};

}  // namespace ilp
