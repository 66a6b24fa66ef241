#include "ilp/antecedents.h"

#include <algorithm>

namespace ilp {

Antecedent Derivations::learn() {
  if (!is_complete_) return Antecedent::nothing();
  if (rows_.n_items() + pending_.size() > max_items_ ||
      rows_.size() > Antecedent::kMaxIndex) {
    is_complete_ = false;
    rows_ = {};
    pending_ = {};
    return Antecedent::nothing();
  }
  std::ranges::sort(pending_);
  pending_.erase(std::unique(pending_.begin(), pending_.end()), pending_.end());
  rows_.add(pending_);
  pending_.clear();
  return Antecedent::learned(static_cast<std::uint32_t>(rows_.size() - 1));
}

}  // namespace ilp
