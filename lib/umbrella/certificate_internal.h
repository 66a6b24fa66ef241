/// @file
/// What the certificates of surfaces and curves have in common, and share with
/// nothing else.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace umbrella::certificate {

class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t k) {
    if (parent_[i] != parent_[k]) parent_[root(i)] = root(k);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

template <std::size_t kCorners>
void require_rows(
    std::span<const std::array<std::uint32_t, kCorners>> simplices,
    std::size_t n_vertices) {
  for (std::size_t i = 0; i < simplices.size(); ++i)
    for (const std::uint32_t row : simplices[i])
      if (row >= n_vertices)
        throw std::invalid_argument("simplex " + std::to_string(i) +
                                    " names vertex " + std::to_string(row) +
                                    " of " + std::to_string(n_vertices));
}

/// How many items equal an earlier one. Sorts them.
template <class Item>
std::size_t count_repeated(std::vector<Item>& items) {
  std::sort(items.begin(), items.end());
  std::size_t n = 0;
  for (std::size_t i = 1; i < items.size(); ++i)
    n += items[i] == items[i - 1] ? 1 : 0;
  return n;
}

}  // namespace umbrella::certificate
