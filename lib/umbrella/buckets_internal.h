/// @file
/// Sorting by a first key that spreads the items well.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace umbrella {

/// Most buckets hold few items, for which std::sort has too many preparations.
template <class Item, class Before>
void sort_bucket(std::span<Item> items, Before before) {
  constexpr std::size_t kFew = 16;
  if (items.size() > kFew) return std::sort(items.begin(), items.end(), before);
  for (std::size_t i = 1; i < items.size(); ++i) {
    if (!before(items[i], items[i - 1])) continue;
    const Item item = items[i];
    std::size_t k = i;
    for (; k > 0 && before(item, items[k - 1]); --k) items[k] = items[k - 1];
    items[k] = item;
  }
}

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
    sort_bucket(std::span(sorted).subspan(first[b], first[b + 1] - first[b]),
                before);
  items = std::move(sorted);
}

}  // namespace umbrella
