/// @file
/// Lists without repetition.
#pragma once

#include <algorithm>
#include <functional>

namespace umbrella {

/// Sorts items, and keeps one of those that are equal.
template <class Items, class Before = std::less<>>
void sort_unique(Items& items, Before before = {}) {
  std::sort(items.begin(), items.end(), before);
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace umbrella
