#include "umbrella/curve.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "delaunay/spatial_sort.h"
#include "predicates/predicates.h"
#include "umbrella/curve_filter.h"
#include "umbrella/stopwatch.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;

/// The edges of a graph at each vertex, as far as that is two.
class TwoRegularPart {
 public:
  TwoRegularPart(std::size_t n_vertices, std::span<const Edge> edges)
      : degree_(n_vertices), mates_(n_vertices) {
    for (const auto& [v, w] : edges) {
      add(v, w);
      add(w, v);
    }
  }

  bool has_two(VertexId v) const { return degree_[index(v)] == 2; }

  /// The vertices of the closed curve through `start`, in one of the two
  /// senses; empty if there is none. Those seen are not to be asked for again.
  std::vector<VertexId> curve_through(VertexId start,
                                      std::vector<bool>& seen) const {
    std::vector<VertexId> curve;
    VertexId previous = start;
    VertexId v = start;
    do {
      curve.push_back(v);
      seen[index(v)] = true;
      const auto& [one, other] = mates_[index(v)];
      const VertexId next = one == previous ? other : one;
      previous = std::exchange(v, next);
    } while (has_two(v) && !seen[index(v)]);
    if (v != start) curve.clear();
    return curve;
  }

 private:
  void add(VertexId v, VertexId w) {
    unsigned& degree = degree_[index(v)];
    if (degree < 2) mates_[index(v)][degree] = w;
    ++degree;
  }

  std::vector<unsigned> degree_;
  std::vector<std::array<VertexId, 2>> mates_;
};

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

/// Edges between vertices of at most two, ascending.
std::vector<Edge> edges_of(const CurveAutoResult& curves) {
  std::vector<Edge> edges;
  edges.reserve(curves.links.size());
  for (std::uint32_t v = 0; v < curves.links.size(); ++v) {
    Edge others = curves.links[v];
    if (others[1] < others[0]) std::swap(others[0], others[1]);
    for (const VertexId w : others)
      if (VertexId{v} < w && w != delaunay::kInfinite)
        edges.push_back({VertexId{v}, w});
  }
  return edges;
}

double lambda_of(const Edge& edge, const CurveAutoResult& curves) {
  const std::size_t v = index(edge[0]);
  return curves.lambda[v][curves.links[v][0] == edge[1] ? 0 : 1];
}

}  // namespace

std::vector<Edge> as_oriented_curves(const Triangulation2& vertices,
                                     std::span<const Edge> edges) {
  const std::size_t n = vertices.points().size();
  const TwoRegularPart part(n, edges);
  std::vector<Edge> oriented;
  std::vector<bool> seen(n);
  std::vector<bool> on_curve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (seen[i] || !part.has_two(VertexId{i})) continue;
    std::vector<VertexId> curve = part.curve_through(VertexId{i}, seen);
    if (curve.empty()) continue;
    orient(vertices, curve);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      oriented.push_back({curve[k], curve[(k + 1) % curve.size()]});
      on_curve[index(curve[k])] = true;
    }
  }
  std::ranges::copy_if(edges, std::back_inserter(oriented),
                       [&](const Edge& e) { return !on_curve[index(e[0])]; });
  return oriented;
}

namespace {

/// Spacings that no edge exceeds in earnest: curves do not end.
constexpr double kNoGap = 1e9;

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
    const CurveAutoResult curves = auto_curves(t_, options);
    count(curves.report);
    result_.descent = curves.report;
    write(edges_of(curves),
          [&](const Edge& e) { return lambda_of(e, curves); });
  }

  void make_tour() {
    const CurveAutoResult start =
        auto_curves(t_, {.gap = kNoGap, .join_all = true});
    count(start.report);
    const std::vector<DelaunayEdge> edges = delaunay_edges(t_);
    TourResult tour = tour_from(edges, edges_of(start));
    std::vector<Edge> curve;
    for (const std::uint32_t e : tour.edges) curve.push_back(edges[e].ends);
    tour.edges.clear();
    result_.tour = tour;
    if (curve.empty()) curve = edges_of(start);
    write(curve, [&](const Edge& e) { return lambda_of(e, edges); });
  }

  TourResult tour_from(std::span<const DelaunayEdge> edges,
                       const std::vector<Edge>& start) const {
    std::vector<TourEdge> all;
    all.reserve(edges.size());
    for (const DelaunayEdge& edge : edges) {
      const auto& [v, w] = edge.ends;
      all.push_back(
          {{static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(w)},
           edge.length});
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(start.size());
    for (const Edge& ends : start)
      indices.push_back(static_cast<std::uint32_t>(
          std::ranges::lower_bound(edges, ends, {}, &DelaunayEdge::ends) -
          edges.begin()));
    if (!is_one_curve(start)) indices.clear();
    return shortest_tour(t_.points().size(), all, indices, options_.tour);
  }

  bool is_one_curve(const std::vector<Edge>& edges) const {
    const TwoRegularPart part(t_.points().size(), edges);
    std::vector<bool> seen(t_.points().size());
    return part.has_two(VertexId{0}) &&
           part.curve_through(VertexId{0}, seen).size() == seen.size();
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
    write(filter.edges, [&](const Edge& e) { return lambda_of(e, edges); });
  }

  void count(const CurveAutoReport& report) {
    result_.counts.gabriel_edges = report.gabriel_edges;
    result_.counts.filter_edges = report.filter_edges;
    result_.counts.filter_without_umbrella = report.without_umbrella;
  }

  template <class Lambda>
  void write(const std::vector<Edge>& edges, const Lambda& lambda) {
    result_.edges.reserve(edges.size());
    result_.lambda.reserve(edges.size());
    std::vector<std::uint8_t> degree(t_.points().size());
    for (const Edge& edge : as_oriented_curves(t_, edges)) {
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
  return Run(points, options).go();
}

}  // namespace umbrella
