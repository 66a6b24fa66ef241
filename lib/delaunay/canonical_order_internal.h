/// @file
/// The corners of a cell in an order that depends on the points alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "delaunay/triangulation3.h"

namespace delaunay {

using Corners = std::array<VertexId, 4>;

inline Corners ascending(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

inline bool is_even_permutation(const Corners& corners) {
  unsigned inversions = 0;
  for (unsigned k = 0; k < 4; ++k)
    for (unsigned i = 0; i < k; ++i)
      inversions += corners[i] > corners[k] ? 1U : 0U;
  return inversions % 2 == 0;
}

/// Ascending, but for the first two where the orientation wants it.
inline Corners in_canonical_order(const Corners& corners) {
  Corners result = ascending(corners);
  if (!is_even_permutation(corners)) std::swap(result[0], result[1]);
  return result;
}

inline unsigned position(const Corners& corners, VertexId v) {
  return static_cast<unsigned>(std::find(corners.begin(), corners.end(), v) -
                               corners.begin());
}

}  // namespace delaunay
