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
  const std::size_t n_finite = triangulation_->n_finite_cells();
  std::size_t n = 0;
  // A cell all of whose neighbours come after it gives none: the next may.
  while (n == 0 && cells_.size() > 0) {
    const std::size_t end = std::min(cells_.begin + kCells, cells_.end);
    for (; cells_.begin < end; ++cells_.begin) {
      const auto c = static_cast<std::uint32_t>(cells_.begin);
      const delaunay::Cell& cell = triangulation_->cell(delaunay::CellId{c});
      for (unsigned k = 0; k < 4; ++k) {
        const delaunay::Facet beyond = cell.neighbor[k];
        const std::size_t there = index(beyond.cell());
        // Written always and kept or not: which it is, no processor can guess.
        block_[n] = beyond;
        n += there < c ? 1 : 0;
        if (there >= n_finite) [[unlikely]]
          block_[n++] = delaunay::Facet(delaunay::CellId{c}, k);
      }
    }
  }
  for (const delaunay::Facet facet : std::span(block_).first(n))
    __builtin_prefetch(&triangulation_->cell(facet.cell()));
  return std::span(block_).first(n);
}

}  // namespace umbrella
