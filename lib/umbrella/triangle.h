/// @file
/// Triangles named by their corners, and the order in which the stages take
/// them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/ids.h"
#include "delaunay/triangulation3.h"

namespace umbrella {

using delaunay::index;
using delaunay::Point3;
using delaunay::VertexId;

/// Position in a list of triangles.
using TriangleIndex = std::uint32_t;

/// Corners in ascending order.
using Triangle = std::array<VertexId, 3>;

/// Of a facet, ascending.
inline Triangle corners(const delaunay::Triangulation3& triangulation,
                        delaunay::Facet facet) {
  const auto& vertex = triangulation.cell(facet.cell()).vertex;
  const auto& [i, j, k] = delaunay::kFacetCorners[facet.index()];
  const VertexId a = vertex[i], b = vertex[j], c = vertex[k];
  const VertexId low = std::min(a, b), high = std::max(a, b);
  return {std::min(low, c), std::max(low, std::min(high, c)),
          std::max(high, c)};
}

/// Place of a triangle in the order of a criterion: smaller is better, by
/// `primary`, then by `secondary`. No NaN.
struct Rank {
  double primary = 0;
  double secondary = 0;

  friend bool operator==(const Rank&, const Rank&) = default;
  friend bool operator<(const Rank& a, const Rank& b) {
    return a.primary != b.primary ? a.primary < b.primary
                                  : a.secondary < b.secondary;
  }
};

/// A Delaunay triangle, and the facet it is in the cell with the smaller id.
struct LocatedTriangle {
  Triangle corners;
  delaunay::Facet facet;
};

/// The order of triangles by ascending corners.
inline bool by_corners(const LocatedTriangle& a, const LocatedTriangle& b) {
  return a.corners < b.corners;
}

struct RankedTriangle {
  Triangle corners;
  delaunay::Facet facet;  ///< as in LocatedTriangle
  Rank rank;
  /// Square of the lower bound of the lambda-interval; negative if nobody has
  /// measured it.
  double squared_lambda = -1;
};

/// The order of triangles as their ranks are given: rank, then corners. See
/// RankOrder for the exact one.
inline bool ranks_before(const RankedTriangle& a, const RankedTriangle& b) {
  if (a.rank != b.rank) return a.rank < b.rank;
  return a.corners < b.corners;
}

}  // namespace umbrella
