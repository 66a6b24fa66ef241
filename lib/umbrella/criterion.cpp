#include "umbrella/criterion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace umbrella {
namespace {

/// A triangle among those with the same lowest corner.
struct Keyed {
  std::uint64_t key;  // the other corners
  std::uint32_t position;

  friend bool operator<(const Keyed& a, const Keyed& b) {
    return a.key < b.key;
  }
};

/// Keys are distinct. Puts each of a few where as many go before it as have
/// smaller keys: more comparisons than sorting takes, but no jump to guess.
void sort_keys(std::vector<Keyed>& items, std::vector<Keyed>& scratch) {
  constexpr std::size_t kFew = 24;
  if (items.size() > kFew) return std::sort(items.begin(), items.end());
  scratch.resize(items.size());
  for (const Keyed& item : items) {
    std::size_t n_before = 0;
    for (const Keyed& other : items) n_before += other < item ? 1 : 0;
    scratch[n_before] = item;
  }
  items.swap(scratch);
}

}  // namespace

void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  std::size_t n_lowest = 0;
  for (const RankedTriangle& t : triangles)
    n_lowest = std::max(n_lowest, index(t.corners[0]) + 1);
  std::vector<std::uint32_t> first(n_lowest + 1);
  for (const RankedTriangle& t : triangles) ++first[index(t.corners[0])];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> by_lowest(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    by_lowest[--first[index(triangles[i].corners[0])]] = i;

  std::vector<RankedTriangle> sorted;
  sorted.reserve(triangles.size());
  std::vector<Keyed> items, scratch;
  for (std::size_t v = 0; v < n_lowest; ++v) {
    items.clear();
    for (std::uint32_t k = first[v]; k < first[v + 1]; ++k) {
      const Triangle& t = triangles[by_lowest[k]].corners;
      items.push_back(
          {std::uint64_t{index(t[1])} << 32U | index(t[2]), by_lowest[k]});
    }
    sort_keys(items, scratch);
    for (const Keyed& item : items) sorted.push_back(triangles[item.position]);
  }
  triangles = std::move(sorted);
}

}  // namespace umbrella
