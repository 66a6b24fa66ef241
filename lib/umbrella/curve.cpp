#include "umbrella/curve.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <utility>

#include "predicates/predicates.h"

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

/// Seconds since the last call.
class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now))
        .count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

std::vector<std::uint32_t> first_rows(const Triangulation2& t) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> row_of(t.points().size(), kNone);
  for (std::uint32_t row = 0; row < t.vertex_of_row().size(); ++row) {
    std::uint32_t& first = row_of[index(t.vertex_of_row()[row])];
    first = std::min(first, row);
  }
  return row_of;
}

double lambda_of(const Edge& edge, std::span<const DelaunayEdge> edges) {
  Edge ends = edge;
  std::ranges::sort(ends);
  return std::ranges::lower_bound(edges, ends, {}, &DelaunayEdge::ends)
      ->lambda_lower;
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

CurveReconstruction reconstruct_curve(std::span<const Point2> points,
                                      const CurveOptions& options) {
  CurveReconstruction result;
  Stopwatch stopwatch;
  const Triangulation2 t(points);
  result.seconds.delaunay = stopwatch.lap();
  const std::vector<DelaunayEdge> edges = delaunay_edges(t);
  result.seconds.lambda = stopwatch.lap();
  const CurveFilterResult filter = curve_filter(t.points().size(), edges);
  result.seconds.filter = stopwatch.lap();

  const std::vector<std::uint32_t> row_of = first_rows(t);
  std::vector<Edge> curve = filter.edges;
  if (options.close && t.dimension() == 2) {
    auto closed =
        close_curve(t.points().size(), edges, filter.agreed, options.closing);
    curve = std::move(closed.edges);
    result.closing = closed.report;
    for (const VertexId v : closed.open)
      result.open_rows.push_back(row_of[index(v)]);
    std::ranges::sort(result.open_rows);
  }
  for (const Edge& edge : as_oriented_curves(t, curve)) {
    result.edges.push_back({row_of[index(edge[0])], row_of[index(edge[1])]});
    result.lambda.push_back(lambda_of(edge, edges));
  }
  result.seconds.closing = stopwatch.lap();

  result.dimension = t.dimension();
  result.counts = {.points = points.size(),
                   .duplicates = points.size() - t.points().size(),
                   .delaunay_cells = t.n_finite_cells(),
                   .delaunay_edges = edges.size(),
                   .gabriel_edges = static_cast<std::size_t>(
                       std::ranges::count_if(edges, &DelaunayEdge::is_gabriel)),
                   .filter_edges = filter.edges.size(),
                   .filter_without_umbrella = filter.without_umbrella.size()};
  return result;
}

}  // namespace umbrella
