#include "umbrella/criterion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "umbrella/buckets_internal.h"

namespace umbrella {

void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  // In a bucket the lowest corners are equal.
  const auto others = [](const RankedTriangle& t) {
    return std::uint64_t{static_cast<std::uint32_t>(t.corners[1])} << 32U |
           static_cast<std::uint32_t>(t.corners[2]);
  };
  std::size_t n_lowest = 0;
  for (const RankedTriangle& t : triangles)
    n_lowest = std::max(n_lowest, index(t.corners[0]) + 1);
  bucket_sort(
      triangles, n_lowest,
      [](const RankedTriangle& t) { return index(t.corners[0]); },
      [&](const RankedTriangle& a, const RankedTriangle& b) {
        return others(a) < others(b);
      });
}

}  // namespace umbrella
