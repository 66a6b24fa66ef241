/// @file
/// The Delaunay edges at single vertices, found when asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulation2.h"

namespace umbrella {

/// Of the angle under which p sees a b, rounded as its factors are.
double sine(const delaunay::Point2& p, const delaunay::Point2& a,
            const delaunay::Point2& b);

class CurveGraph {
 public:
  struct Arc {
    delaunay::VertexId to;
    double length;  ///< at most 2^1000, so that sums stay finite
    double lambda;  ///< lower bound
    /// length (1 + lambda / 4): what a curve pays for the edge, docs/curve.md
    /// "The cost of an edge".
    double cost;
  };

  explicit CurveGraph(const delaunay::Triangulation2& triangulation);

  const delaunay::Triangulation2& triangulation() const { return t_; }

  /// By ascending cost, then `to`. Spans stay valid.
  std::span<const Arc> arcs(delaunay::VertexId v);

  /// The arc from v to w; none if there is no such Delaunay edge.
  const Arc* arc(delaunay::VertexId v, delaunay::VertexId w);

 private:
  std::vector<Arc> walk_around(delaunay::VertexId v) const;

  const delaunay::Triangulation2& t_;
  std::vector<delaunay::CellId> cell_of_;  // some cell at each vertex
  std::vector<std::uint32_t> known_as_;    // place in known_, or kUnknown
  std::vector<std::vector<Arc>> known_;
};

}  // namespace umbrella
