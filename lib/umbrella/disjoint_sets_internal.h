/// @file
/// Union-find over 0 .. n-1.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace umbrella {

/// The root of a set is its smallest member: results do not depend on the
/// order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  /// @param parent  of each member one in its set, itself or a smaller one
  explicit DisjointSets(std::vector<std::uint32_t> parent)
      : parent_(std::move(parent)) {}

  std::uint32_t root(std::size_t i) {
    auto r = static_cast<std::uint32_t>(i);
    while (parent_[r] != r) r = parent_[r] = parent_[parent_[r]];
    return r;
  }
  /// @return whether they were apart
  bool unite(std::size_t i, std::size_t k) {
    if (parent_[i] == parent_[k]) return false;
    const std::uint32_t a = root(i), b = root(k);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// A new member, in a set of its own.
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }
  /// Adds what is counted at each member to the count at its root.
  void add_at_roots(std::vector<std::uint32_t>& counts) {
    flatten();
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (const std::uint32_t r = parent_[i]; r != i) counts[r] += counts[i];
  }
  /// Until the next union root() takes one step.
  void flatten() {
    for (std::uint32_t& parent : parent_) parent = parent_[parent];
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace umbrella
