/// @file
/// Sorting by a first key that spreads the items well.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace umbrella {

/// Sorts by bucket(item), below n_buckets, then by `before`: in linear time if
/// no bucket holds many items, in the time of std::sort at worst.
///
/// @pre items of a lower bucket go before those of a higher one anyway
template <class Item, class Bucket, class Before>
void bucket_sort(std::vector<Item>& items, std::size_t n_buckets, Bucket bucket,
                 Before before) {
  std::vector<std::uint32_t> first(n_buckets + 1);
  for (const Item& item : items) ++first[bucket(item)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[--first[bucket(item)]] = item;
  for (std::size_t b = 0; b < n_buckets; ++b)
    if (first[b + 1] - first[b] > 1)
      std::sort(sorted.begin() + first[b], sorted.begin() + first[b + 1],
                before);
  items = std::move(sorted);
}

}  // namespace umbrella
