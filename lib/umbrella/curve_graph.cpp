#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "umbrella/curve_graph_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell2;
using delaunay::CellId;
using delaunay::Point2;
using delaunay::Side;
using delaunay::Triangulation2;
using delaunay::VertexId;

constexpr auto kUnknown = std::numeric_limits<std::uint32_t>::max();

}  // namespace

double sine(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 u = (a - p).stableNormalized();
  const Point2 v = (b - p).stableNormalized();
  return std::min(1.0, std::abs(u.x() * v.y() - u.y() * v.x()));
}

CurveGraph::CurveGraph(const Triangulation2& triangulation)
    : t_(triangulation),
      cell_of_(triangulation.points().size()),
      known_as_(triangulation.points().size(), kUnknown) {
  for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c)
    for (const VertexId v : t_.cell(CellId{c}).vertex)
      cell_of_[index(v)] = CellId{c};
}

std::vector<CurveGraph::Arc> CurveGraph::walk_around(VertexId v) const {
  std::vector<Arc> arcs;
  const CellId start = cell_of_[index(v)];
  CellId c = start;
  do {
    const Cell2& cell = t_.cell(c);
    const auto i = static_cast<unsigned>(std::ranges::find(cell.vertex, v) -
                                         cell.vertex.begin());
    const auto& [right, left] = delaunay::kSideCorners[i];
    const Side across = cell.neighbor[right];  // beyond the edge v, left
    const VertexId w = cell.vertex[left];
    if (w != delaunay::kInfinite) {
      double lambda = 1;
      for (const VertexId apex :
           {cell.vertex[right], t_.cell(across.cell()).vertex[across.index()]})
        lambda = apex == delaunay::kInfinite
                     ? 0
                     : std::min(lambda,
                                sine(t_.point(apex), t_.point(v), t_.point(w)));
      const Point2 e = t_.point(w) - t_.point(v);
      const double length = std::min(e.stableNorm(), 0x1p1000);
      arcs.push_back({w, length, lambda, length * (1 + lambda / 4)});
    }
    c = across.cell();
  } while (c != start);
  std::ranges::sort(arcs, {},
                    [](const Arc& arc) { return std::pair(arc.cost, arc.to); });
  return arcs;
}

std::span<const CurveGraph::Arc> CurveGraph::arcs(VertexId v) {
  std::uint32_t& place = known_as_[index(v)];
  if (place == kUnknown) {
    place = static_cast<std::uint32_t>(known_.size());
    known_.push_back(walk_around(v));
  }
  return known_[place];
}

const CurveGraph::Arc* CurveGraph::arc(VertexId v, VertexId w) {
  const auto at = arcs(v);
  const auto found = std::ranges::find(at, w, &Arc::to);
  return found == at.end() ? nullptr : &*found;
}

}  // namespace umbrella
