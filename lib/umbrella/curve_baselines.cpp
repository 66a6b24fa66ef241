#include "umbrella/curve_baselines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "umbrella/curve_graph_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell2;
using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;

void make_distinct(std::vector<Edge>& edges) {
  for (Edge& edge : edges) std::ranges::sort(edge);
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

/// Edges of each vertex to its nearest neighbour q, and to the nearest r with
/// fits(v, q, r).
template <class Fits>
std::vector<Edge> nearest_two(const Triangulation2& samples, const Fits& fits) {
  std::vector<Edge> edges;
  if (samples.dimension() < 2) return edges;
  CurveGraph graph(samples);
  for (std::uint32_t i = 0; i < samples.points().size(); ++i) {
    const VertexId v{i};
    const Point2& p = samples.point(v);
    std::vector<CurveGraph::Arc> arcs(graph.arcs(v).begin(),
                                      graph.arcs(v).end());
    std::ranges::sort(arcs, {}, [](const CurveGraph::Arc& arc) {
      return std::pair(arc.length, arc.to);
    });
    edges.push_back({v, arcs.front().to});
    const Point2& q = samples.point(arcs.front().to);
    const auto second = std::ranges::find_if(
        std::span(arcs).subspan(1), [&](const CurveGraph::Arc& arc) {
          return fits(p, q, samples.point(arc.to));
        });
    if (second != std::span(arcs).end()) edges.push_back({v, second->to});
  }
  make_distinct(edges);
  return edges;
}

/// Centre of the circle through three points; none if it leaves the doubles.
std::optional<Point2> circumcenter(const Point2& a, const Point2& b,
                                   const Point2& c) {
  const Point2 u = b - a;
  const Point2 v = c - a;
  const double d = 2 * (u.x() * v.y() - u.y() * v.x());
  const Point2 center =
      a + Point2(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                 u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
              d;
  if (!center.allFinite()) return std::nullopt;
  return center;
}

}  // namespace

std::vector<Edge> crust(const Triangulation2& samples) {
  std::vector<Point2> all(samples.points().begin(), samples.points().end());
  const std::size_t n = all.size();
  for (std::uint32_t c = 0; c < samples.n_finite_cells(); ++c) {
    const Cell2& cell = samples.cell(delaunay::CellId{c});
    const auto center = circumcenter(samples.point(cell.vertex[0]),
                                     samples.point(cell.vertex[1]),
                                     samples.point(cell.vertex[2]));
    if (center) all.push_back(*center);
  }
  const Triangulation2 both(all);
  std::vector<VertexId> sample_of(both.points().size(), delaunay::kInfinite);
  for (std::uint32_t row = 0; row < n; ++row)
    sample_of[index(both.vertex_of_row()[row])] = VertexId{row};

  std::vector<Edge> edges;
  for (std::uint32_t c = 0; c < both.n_finite_cells(); ++c) {
    const Cell2& cell = both.cell(delaunay::CellId{c});
    for (const auto& [i, j] : delaunay::kSideCorners) {
      const VertexId v = sample_of[index(cell.vertex[i])];
      const VertexId w = sample_of[index(cell.vertex[j])];
      if (v != delaunay::kInfinite && w != delaunay::kInfinite)
        edges.push_back({v, w});
    }
  }
  make_distinct(edges);
  return edges;
}

std::vector<Edge> nn_crust(const Triangulation2& samples) {
  return nearest_two(samples,
                     [](const Point2& p, const Point2& q, const Point2& r) {
                       return (q - p).dot(r - p) < 0;
                     });
}

std::vector<Edge> hnn_crust(const Triangulation2& samples) {
  return nearest_two(samples,
                     [](const Point2& p, const Point2& q, const Point2& r) {
                       return 2 * (q - p).dot(r - p) < (q - p).squaredNorm();
                     });
}

}  // namespace umbrella
