#include "umbrella/facets.h"

#include <algorithm>
#include <cstdint>

namespace umbrella {

std::vector<delaunay::Facet> facets(
    const delaunay::Triangulation3& triangulation) {
  std::vector<delaunay::Facet> result;
  FacetBlocks blocks(triangulation);
  for (auto block = blocks.next(); !block.empty(); block = blocks.next())
    result.insert(result.end(), block.begin(), block.end());
  return result;
}

std::span<delaunay::Facet> FacetBlocks::next() {
  std::size_t n = 0;
  // A cell all of whose neighbours come before it gives none: the next may.
  while (n == 0 && cells_.size() > 0) {
    const std::size_t end = std::min(cells_.begin + kCells, cells_.end);
    for (; cells_.begin < end; ++cells_.begin) {
      const delaunay::CellId c{static_cast<std::uint32_t>(cells_.begin)};
      for (unsigned k = 0; k < 4; ++k) {
        const delaunay::CellId beyond =
            triangulation_->cell(c).neighbor[k].cell();
        __builtin_prefetch(&triangulation_->cell(beyond));
        // Written always and kept or not: which it is, no processor can guess.
        block_[n] = delaunay::Facet(c, k);
        n += c < beyond ? 1 : 0;
      }
    }
  }
  return std::span(block_).first(n);
}

}  // namespace umbrella
