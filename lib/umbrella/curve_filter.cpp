#include "umbrella/curve_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include "predicates/gabriel.h"

namespace umbrella {
namespace {

using delaunay::Cell2;
using delaunay::CellId;
using delaunay::Point2;
using delaunay::Side;
using delaunay::Triangulation2;
using delaunay::VertexId;

/// A real number as the unevaluated sum of two doubles.
struct Split {
  double high;
  double low;
};

// Exact [Knuth97, 4.2.2]: high is the rounded difference, low its error.
Split difference(double a, double b) {
  const double high = a - b;
  const double b_part = a - high;
  const double a_part = high + b_part;
  return {high, (a - a_part) + (b_part - b)};
}

/// q - p, times the power of two that brings its larger coordinate to [1, 2).
struct Direction {
  Split x, y;

  Direction(const Point2& p, const Point2& q) {
    // Next to the largest double, for the differences must not overflow.
    const double largest =
        std::max(p.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>());
    const double unit = largest < 0x1p1022 ? 1 : 0.5;
    x = difference(unit * q.x(), unit * p.x());
    y = difference(unit * q.y(), unit * p.y());
    const int exponent =
        -std::ilogb(std::max(std::abs(x.high), std::abs(y.high)));
    for (double* part : {&x.high, &x.low, &y.high, &y.low})
      *part = std::ldexp(*part, exponent);
  }
  double norm() const { return std::sqrt(x.high * x.high + y.high * y.high); }
};

// ab - cd to about twice the working precision of its two products: the error
// of each is known exactly by fma, and low times low is below 2^-104.
double determinant(const Split& a, const Split& b, const Split& c,
                   const Split& d) {
  const double ab = a.high * b.high;
  const double cd = c.high * d.high;
  const double ab_error = std::fma(a.high, b.high, -ab);
  const double cd_error = std::fma(c.high, d.high, -cd);
  const Split leading = difference(ab, cd);
  return leading.high + (leading.low + (ab_error - cd_error) +
                         ((a.high * b.low + a.low * b.high) -
                          (c.high * d.low + c.low * d.high)));
}

/// Sine of the angle at p between q and r.
double sine(const Point2& p, const Point2& q, const Point2& r) {
  const Direction u(p, q);
  const Direction v(p, r);
  const double area = std::abs(determinant(u.x, v.y, u.y, v.x));
  return std::min(1.0, area / (u.norm() * v.norm()));
}

/// Both ends of an edge and the corner opposite on one side.
struct HalfEdge {
  Edge ends;
  VertexId apex;
};

HalfEdge half_edge(const Triangulation2& t, Side side) {
  const Cell2& cell = t.cell(side.cell());
  const auto& k = delaunay::kSideCorners[side.index()];
  const auto [low, high] = std::minmax(cell.vertex[k[0]], cell.vertex[k[1]]);
  return {{low, high}, cell.vertex[side.index()]};
}

DelaunayEdge measured(const Triangulation2& t, const Edge& ends,
                      const std::array<VertexId, 2>& apexes) {
  const Point2& a = t.point(ends[0]);
  const Point2& b = t.point(ends[1]);
  DelaunayEdge edge{ends, 1, std::hypot(b.x() - a.x(), b.y() - a.y()), true};
  for (const VertexId apex : apexes) {
    if (apex == delaunay::kInfinite) {
      edge.lambda_lower = 0;
      continue;
    }
    // A point in the diametral disc has an obtuse angle there, and the corner
    // on its side one at least as large: the two corners decide for all.
    const Point2& p = t.point(apex);
    edge.lambda_lower = std::min(edge.lambda_lower, sine(p, a, b));
    edge.is_gabriel = edge.is_gabriel && predicates::gabriel_edge(
                                             a.data(), b.data(), p.data()) >= 0;
  }
  return edge;
}

}  // namespace

bool ranks_before(const DelaunayEdge& a, const DelaunayEdge& b) {
  return std::tie(a.lambda_lower, a.length, a.ends) <
         std::tie(b.lambda_lower, b.length, b.ends);
}

std::vector<DelaunayEdge> delaunay_edges(const Triangulation2& triangulation) {
  std::vector<DelaunayEdge> edges;
  for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c) {
    for (unsigned i = 0; i < 3; ++i) {
      const Side here(CellId{c}, i);
      const Side there = triangulation.cell(CellId{c}).neighbor[i];
      if (there.cell() < CellId{c}) continue;
      const auto [ends, apex] = half_edge(triangulation, here);
      edges.push_back(measured(triangulation, ends,
                               {apex, half_edge(triangulation, there).apex}));
    }
  }
  std::ranges::sort(edges, {}, &DelaunayEdge::ends);
  return edges;
}

CurveFilterResult curve_filter(std::size_t n_vertices,
                               std::span<const DelaunayEdge> edges) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::array<std::size_t, 2>> picked(n_vertices, {kNone, kNone});
  const auto better = [&](std::size_t e, std::size_t f) {
    return f == kNone || ranks_before(edges[e], edges[f]);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!edges[e].is_gabriel) continue;
    for (const VertexId v : edges[e].ends) {
      auto& [first, second] = picked[index(v)];
      if (better(e, first))
        second = std::exchange(first, e);
      else if (better(e, second))
        second = e;
    }
  }

  CurveFilterResult result;
  std::vector<unsigned> votes(edges.size());
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    if (picked[v][1] == kNone)
      result.without_umbrella.push_back(VertexId{v});
    else
      for (const std::size_t e : picked[v]) ++votes[e];
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (votes[e] > 0) result.edges.push_back(edges[e].ends);
    if (votes[e] > 1) result.agreed.push_back(edges[e].ends);
  }
  std::ranges::sort(result.edges);
  std::ranges::sort(result.agreed);
  return result;
}

}  // namespace umbrella
