#include "umbrella/curve.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "delaunay/spatial_sort.h"
#include "predicates/predicates.h"
#include "umbrella/curve_filter.h"
#include "umbrella/curve_links_internal.h"
#include "umbrella/stopwatch.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;

/// The links of vertices with exactly two edges; none at others.
CurveLinks two_regular_part(std::size_t n_vertices,
                            std::span<const Edge> edges) {
  constexpr auto kNone = CurveLinks::kNone;
  std::vector<std::array<VertexId, 2>> links(n_vertices, {kNone, kNone});
  std::vector<std::uint8_t> degree(n_vertices);
  const auto add = [&](VertexId v, VertexId w) {
    std::uint8_t& d = degree[index(v)];
    if (d < 2) links[index(v)][d] = w;
    if (d < 3) ++d;
  };
  for (const auto& [v, w] : edges) {
    add(v, w);
    add(w, v);
  }
  for (std::size_t v = 0; v < n_vertices; ++v)
    if (degree[v] != 2) links[v] = {kNone, kNone};
  return CurveLinks(std::move(links));
}

/// Goes along links from `start`, in one of the two senses, and marks what it
/// sees. Each vertex is to be asked for only while it is not seen.
/// @param curve  the vertices; empty if the links lead to an end
void walk(const CurveLinks& links, VertexId start, std::vector<bool>& seen,
          std::vector<VertexId>& curve) {
  curve.clear();
  VertexId previous = links[start][1];
  VertexId v = start;
  do {
    curve.push_back(v);
    seen[index(v)] = true;
    const VertexId next = links.beyond(v, previous);
    previous = std::exchange(v, next);
  } while (v != CurveLinks::kNone && links.is_full(v) && !seen[index(v)]);
  if (v != start) curve.clear();
}

bool is_left_of(const Point2& a, const Point2& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

/// Turns a simple closed curve counter-clockwise, by the turn at its leftmost
/// vertex; the first vertex stays.
void orient(const Triangulation2& t, std::vector<VertexId>& curve) {
  const auto leftmost =
      std::ranges::min_element(curve, [&](VertexId v, VertexId w) {
        return is_left_of(t.point(v), t.point(w));
      });
  const std::size_t i = static_cast<std::size_t>(leftmost - curve.begin());
  const std::size_t n = curve.size();
  const int turn = predicates::orient2d(t.point(curve[(i + n - 1) % n]).data(),
                                        t.point(curve[i]).data(),
                                        t.point(curve[(i + 1) % n]).data());
  if (turn < 0) std::reverse(curve.begin() + 1, curve.end());
}

double lambda_of(const Edge& edge, std::span<const DelaunayEdge> edges) {
  Edge ends = edge;
  std::ranges::sort(ends);
  return std::ranges::lower_bound(edges, ends, {}, &DelaunayEdge::ends)
      ->lambda_lower;
}

/// Edges in the order of as_oriented_curves().
class OrientedEdges {
 public:
  explicit OrientedEdges(const Triangulation2& t)
      : t_(t), on_curve_(t.points().size()) {}

  void add_closed_curves(const CurveLinks& links) {
    std::vector<bool> seen(links.n_vertices());
    std::vector<VertexId> curve;
    for (std::uint32_t i = 0; i < links.n_vertices(); ++i) {
      if (seen[i] || !links.is_full(VertexId{i})) continue;
      walk(links, VertexId{i}, seen, curve);
      if (curve.empty()) continue;
      orient(t_, curve);
      for (std::size_t k = 0; k < curve.size(); ++k) {
        edges_.push_back({curve[k], curve[k + 1 < curve.size() ? k + 1 : 0]});
        on_curve_[index(curve[k])] = true;
      }
    }
  }
  void add_rest(const Edge& edge) {
    if (!on_curve_[index(edge[0])]) edges_.push_back(edge);
  }
  std::vector<Edge> take() && { return std::move(edges_); }

 private:
  const Triangulation2& t_;
  std::vector<bool> on_curve_;
  std::vector<Edge> edges_;
};

/// Calls visit(edge) for all, by ascending ends.
template <class Visit>
void for_each_edge(const CurveLinks& links, const Visit& visit) {
  for (std::uint32_t i = 0; i < links.n_vertices(); ++i) {
    const VertexId v{i};
    Edge others = links[v];
    if (others[1] < others[0]) std::swap(others[0], others[1]);
    for (const VertexId w : others)
      if (v < w && w != CurveLinks::kNone) visit(Edge{v, w});
  }
}

std::vector<Edge> edges_of(const CurveLinks& links) {
  std::vector<Edge> edges;
  for_each_edge(links, [&](const Edge& edge) { edges.push_back(edge); });
  return edges;
}

/// As as_oriented_curves(), for a graph of at most two edges a vertex.
std::vector<Edge> oriented_curves(const Triangulation2& vertices,
                                  const CurveLinks& links) {
  OrientedEdges oriented(vertices);
  oriented.add_closed_curves(links);
  for_each_edge(links, [&](const Edge& edge) { oriented.add_rest(edge); });
  return std::move(oriented).take();
}

}  // namespace

std::vector<Edge> as_oriented_curves(const Triangulation2& vertices,
                                     std::span<const Edge> edges) {
  OrientedEdges oriented(vertices);
  oriented.add_closed_curves(two_regular_part(vertices.points().size(), edges));
  for (const Edge& edge : edges) oriented.add_rest(edge);
  return std::move(oriented).take();
}

namespace {

/// Spacings that no edge exceeds in earnest: curves do not end.
constexpr double kNoGap = 1e9;

/// The exponent of the largest coordinate, if products of distances may leave
/// the range of doubles and all coordinates can be divided by that power of two
/// without rounding; else 0.
int far_exponent(std::span<const Point2> points) {
  constexpr int kNear = 256;
  double largest = 0;
  for (const Point2& p : points)
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  if (largest == 0 || !std::isfinite(largest)) return 0;
  const int exponent = std::ilogb(largest);
  if (std::abs(exponent) < kNear) return 0;
  const auto is_exact = [exponent](double x) {
    return std::ldexp(std::ldexp(x, -exponent), exponent) == x;
  };
  const bool are_exact = std::ranges::all_of(points, [&](const Point2& p) {
    return is_exact(p.x()) && is_exact(p.y());
  });
  return are_exact ? exponent : 0;
}

/// One run of the pipeline.
class Run {
 public:
  Run(std::span<const Point2> points, const CurveOptions& options)
      : options_(options), t_(points) {
    result_.seconds.delaunay = stopwatch_.lap();
    result_.dimension = t_.dimension();
    // A side of a cell is seen from two, at the hull from one finite one.
    const std::size_t n_hull = t_.cells().size() - t_.n_finite_cells();
    result_.counts = {.points = points.size(),
                      .duplicates = points.size() - t_.points().size(),
                      .delaunay_cells = t_.n_finite_cells(),
                      .delaunay_edges = (3 * t_.n_finite_cells() + n_hull) / 2};
    row_of_ = delaunay::first_rows(t_.points().size(), t_.vertex_of_row());
  }

  CurveReconstruction go() && {
    if (t_.dimension() == 2) {
      switch (options_.mode) {
        case CurveMode::Auto:
        case CurveMode::Open:
          descend();
          break;
        case CurveMode::Tour:
          make_tour();
          break;
        case CurveMode::Paper:
        case CurveMode::Closed:
        case CurveMode::Mutual:
          filter();
          break;
      }
    }
    result_.seconds.closing += stopwatch_.lap();
    return std::move(result_);
  }

 private:
  void descend() {
    constexpr double kOpenGap = 4;
    CurveAutoOptions options;
    if (options_.mode == CurveMode::Open) options.gap = kOpenGap;
    CurveAutoResult curves = auto_curves(t_, options);
    count(curves.report);
    result_.descent = curves.report;
    const CurveLinks links(std::move(curves.links));
    write(oriented_curves(t_, links), [&](const Edge& e) {
      return curves.lambda[index(e[0])][links[e[0]][0] == e[1] ? 0 : 1];
    });
  }

  void make_tour() {
    CurveAutoResult curves = auto_curves(t_, {.gap = kNoGap, .join_all = true});
    count(curves.report);
    const CurveLinks start(std::move(curves.links));
    const std::vector<DelaunayEdge> edges = delaunay_edges(t_);
    TourResult tour = tour_from(edges, start);
    std::vector<Edge> curve;
    for (const std::uint32_t e : tour.edges) curve.push_back(edges[e].ends);
    tour.edges.clear();
    result_.tour = tour;
    if (curve.empty()) curve = edges_of(start);
    write(as_oriented_curves(t_, curve),
          [&](const Edge& e) { return lambda_of(e, edges); });
  }

  TourResult tour_from(std::span<const DelaunayEdge> edges,
                       const CurveLinks& start) const {
    std::vector<TourEdge> all;
    all.reserve(edges.size());
    for (const DelaunayEdge& edge : edges) {
      const auto& [v, w] = edge.ends;
      all.push_back(
          {{static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(w)},
           edge.length});
    }
    std::vector<std::uint32_t> indices;
    if (start.closed_curve_through(VertexId{0}).size() == start.n_vertices()) {
      for_each_edge(start, [&](const Edge& ends) {
        indices.push_back(static_cast<std::uint32_t>(
            std::ranges::lower_bound(edges, ends, {}, &DelaunayEdge::ends) -
            edges.begin()));
      });
    }
    return shortest_tour(t_.points().size(), all, indices, options_.tour);
  }

  void filter() {
    const std::vector<DelaunayEdge> edges = delaunay_edges(t_);
    result_.seconds.lambda = stopwatch_.lap();
    const std::size_t n = t_.points().size();
    CurveFilterResult filter = curve_filter(n, edges);
    result_.seconds.filter = stopwatch_.lap();
    result_.counts.gabriel_edges = static_cast<std::size_t>(
        std::ranges::count_if(edges, &DelaunayEdge::is_gabriel));
    result_.counts.filter_edges = filter.edges.size();
    result_.counts.filter_without_umbrella = filter.without_umbrella.size();
    if (options_.mode == CurveMode::Closed) {
      auto closed = close_curve(n, edges, filter.agreed, options_.closing);
      result_.closing = closed.report;
      filter.edges = std::move(closed.edges);
    } else if (options_.mode == CurveMode::Mutual) {
      filter.edges = std::move(filter.agreed);
    }
    write(as_oriented_curves(t_, filter.edges),
          [&](const Edge& e) { return lambda_of(e, edges); });
  }

  void count(const CurveAutoReport& report) {
    result_.counts.gabriel_edges = report.gabriel_edges;
    result_.counts.filter_edges = report.filter_edges;
    result_.counts.filter_without_umbrella = report.without_umbrella;
  }

  template <class Lambda>
  void write(const std::vector<Edge>& oriented, const Lambda& lambda) {
    result_.edges.reserve(oriented.size());
    result_.lambda.reserve(oriented.size());
    std::vector<std::uint8_t> degree(t_.points().size());
    for (const Edge& edge : oriented) {
      result_.edges.push_back(
          {row_of_[index(edge[0])], row_of_[index(edge[1])]});
      result_.lambda.push_back(lambda(edge));
      for (const VertexId v : edge)
        if (degree[index(v)] < 2) ++degree[index(v)];
    }
    for (std::size_t v = 0; v < degree.size(); ++v)
      if (degree[v] < 2) result_.open_rows.push_back(row_of_[v]);
    std::ranges::sort(result_.open_rows);
  }

  CurveOptions options_;
  Stopwatch stopwatch_;
  Triangulation2 t_;
  std::vector<std::uint32_t> row_of_;
  CurveReconstruction result_;
};

}  // namespace

CurveReconstruction reconstruct_curve(std::span<const Point2> points,
                                      const CurveOptions& options) {
  const int exponent = far_exponent(points);
  if (exponent == 0) return Run(points, options).go();
  std::vector<Point2> near_one(points.begin(), points.end());
  for (Point2& p : near_one)
    p = {std::ldexp(p.x(), -exponent), std::ldexp(p.y(), -exponent)};
  CurveReconstruction result = Run(near_one, options).go();
  if (result.tour) {
    result.tour->length = std::ldexp(result.tour->length, exponent);
    result.tour->bound = std::ldexp(result.tour->bound, exponent);
  }
  return result;
}

}  // namespace umbrella
