#include "ilp/decision_order.h"

#include <algorithm>
#include <cassert>

namespace ilp {

DecisionOrder::DecisionOrder(std::size_t n_variables)
    : order_(n_variables), rank_(n_variables) {
  for (std::uint32_t v = 0; v < n_variables; ++v) {
    order_[v] = VarId{v};
    rank_[v] = v;
  }
}

void DecisionOrder::set_priority(std::span<const VarId> first) {
  forget_activity();
  const auto n = static_cast<std::uint32_t>(order_.size());
  std::ranges::fill(rank_, n);
  std::uint32_t end = 0;
  for (const VarId v : first) {
    assert(rank_[index(v)] == n && "a variable twice in the order");
    rank_[index(v)] = end;
    order_[end++] = v;
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    if (rank_[v] != n) continue;
    rank_[v] = end;
    order_[end++] = VarId{v};
  }
  n_passed_ = 0;
}

void DecisionOrder::bump(VarId var) {
  constexpr double kTooLarge = 1e100;
  if (activity_.empty()) {
    activity_.resize(order_.size(), 0);
    place_.resize(order_.size(), kNotInHeap);
  }
  double& activity = activity_[index(var)];
  if (activity == 0) active_.push_back(var);
  activity += increment_;
  if (activity > kTooLarge) {
    for (const VarId v : active_) activity_[index(v)] /= kTooLarge;
    increment_ /= kTooLarge;
  }
  if (place_[index(var)] != kNotInHeap) sift_up(place_[index(var)]);
}

void DecisionOrder::forget_activity() {
  for (const VarId v : active_) activity_[index(v)] = 0;
  for (const VarId v : heap_) place_[index(v)] = kNotInHeap;
  active_.clear();
  heap_.clear();
  increment_ = 1;
}

bool DecisionOrder::precedes(VarId a, VarId b) const {
  const double x = activity_[index(a)], y = activity_[index(b)];
  return x != y ? x > y : rank_[index(a)] < rank_[index(b)];
}

void DecisionOrder::place(std::size_t i, VarId var) {
  heap_[i] = var;
  place_[index(var)] = static_cast<std::uint32_t>(i);
}

void DecisionOrder::push(VarId var) {
  heap_.push_back(var);
  sift_up(heap_.size() - 1);
}

VarId DecisionOrder::pop() {
  const VarId top = heap_.front();
  const VarId last = heap_.back();
  heap_.pop_back();
  place_[index(top)] = kNotInHeap;
  if (!heap_.empty()) {
    place(0, last);
    sift_down(0);
  }
  return top;
}

void DecisionOrder::sift_up(std::size_t i) {
  const VarId var = heap_[i];
  while (i > 0 && precedes(var, heap_[(i - 1) / 2])) {
    place(i, heap_[(i - 1) / 2]);
    i = (i - 1) / 2;
  }
  place(i, var);
}

void DecisionOrder::sift_down(std::size_t i) {
  const VarId var = heap_[i];
  for (std::size_t child = 2 * i + 1; child < heap_.size(); child = 2 * i + 1) {
    if (child + 1 < heap_.size() && precedes(heap_[child + 1], heap_[child]))
      ++child;
    if (!precedes(heap_[child], var)) break;
    place(i, heap_[child]);
    i = child;
  }
  place(i, var);
}

}  // namespace ilp
