/// @file
/// Some triangles of a triangulation in the order of their corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/lazy_vector.h"
#include "umbrella/circumspheres.h"
#include "umbrella/ranges.h"

namespace umbrella {

using FacetList = std::vector<FacetPoints>;

/// Facets are sorted by their lowest corners; the rest of the order is made
/// where they are asked for, a few vertices at a time.
class FacetsByCorners {
 public:
  /// @param n_vertices  all corners are below it
  /// @param facets  distinct, in any order
  FacetsByCorners(std::size_t n_vertices, FacetList facets);

  /// The facets of some lowest corners, a block of them at a time.
  class Walk {
   public:
    Walk(const FacetsByCorners& all, IndexRange lowest)
        : all_(&all), lowest_(lowest) {}

    /// The next ones, by ascending corners; none at the end. Valid until the
    /// next call.
    std::span<const FacetPoints> next();

   private:
    void append(std::size_t lowest);

    /// One of those at the same lowest corner.
    struct Keyed {
      std::uint64_t key;  // the other corners
      std::uint32_t position;
    };
    void sort_keyed();

    const FacetsByCorners* all_;
    IndexRange lowest_;  // that are left
    std::vector<FacetPoints> block_;
    std::vector<Keyed> keyed_, scratch_;
  };

  /// How many have one of these lowest corners.
  std::size_t count(IndexRange lowest) const {
    return first_[lowest.end] - first_[lowest.begin];
  }

 private:
  FacetList facets_;
  std::vector<std::uint32_t> first_;  // of a lowest corner
  delaunay::UnsetVector<std::uint32_t> by_lowest_;
};

}  // namespace umbrella
