/// @file
/// The triangles of a triangulation, one after another.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/ranges.h"

namespace umbrella {

/// Each triangle of the triangulation once, as the facet it is in the cell with
/// the smaller id.
std::vector<delaunay::Facet> facets(
    const delaunay::Triangulation3& triangulation);

/// Some of them at a time, at most kLargest, in memory that stays in the cache.
/// A triangle comes with the later of its cells within the hull: then the other
/// one, which was walked over not long ago, mostly still is in the cache too.
class FacetBlocks {
 public:
  explicit FacetBlocks(const delaunay::Triangulation3& triangulation)
      : FacetBlocks(triangulation, {0, triangulation.n_finite_cells()}) {}
  /// Those of some cells only.
  FacetBlocks(const delaunay::Triangulation3& triangulation, IndexRange cells)
      : triangulation_(&triangulation), cells_(cells) {}

  /// The next ones, which the caller may overwrite; none at the end. Valid
  /// until the next call.
  std::span<delaunay::Facet> next();

  static constexpr std::size_t kLargest = 256;

 private:
  static constexpr std::size_t kCells = kLargest / 4;

  const delaunay::Triangulation3* triangulation_;
  IndexRange cells_;  // that are left
  std::array<delaunay::Facet, kLargest> block_;
};

}  // namespace umbrella
