#include "umbrella/criterion.h"

#include <algorithm>
#include <cstddef>

#include "umbrella/buckets_internal.h"

namespace umbrella {

void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  std::size_t n_lowest = 0;
  for (const RankedTriangle& t : triangles)
    n_lowest = std::max(n_lowest, index(t.corners[0]) + 1);
  bucket_sort(
      triangles, n_lowest,
      [](const RankedTriangle& t) { return index(t.corners[0]); },
      [](const RankedTriangle& a, const RankedTriangle& b) {
        return a.corners < b.corners;
      });
}

}  // namespace umbrella
