#include "umbrella/plane_complexes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "predicates/gabriel.h"
#include "umbrella/empty_balls_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Point2;
using delaunay::Side;
using delaunay::Triangulation2;
using delaunay::VertexId;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An edge of a triangulation, with the answers that EmptyBalls asks for; see
/// DelaunayTriangle. Lengths are in units of 1 / scale.
class PlaneEdge {
 public:
  PlaneEdge(const Triangulation2& t, Side side, double scale)
      : ends_(ends_of(t, side)) {
    const Point2 a = scale * t.point(ends_[0]), b = scale * t.point(ends_[1]);
    r2_ = (b - a).squaredNorm() / 4;
    const Side opposite = t.cell(side.cell()).neighbor[side.index()];
    for (std::size_t i = 0; i < 2; ++i) {
      const Side from = i == 0 ? side : opposite;
      const VertexId apex = t.cell(from.cell()).vertex[from.index()];
      beyond_hull_[i] = apex == delaunay::kInfinite;
      own_side_[i] = beyond_hull_[i] ||
                     predicates::gabriel_edge(t.point(ends_[0]).data(),
                                              t.point(ends_[1]).data(),
                                              t.point(apex).data()) >= 0;
      lambda2_[i] =
          beyond_hull_[i] ? 0 : squared_sine(scale * t.point(apex), a, b);
    }
  }

  const Edge& ends() const { return ends_; }
  std::array<bool, 2> centers_on_own_side() const { return own_side_; }
  std::array<bool, 2> beyond_hull() const { return beyond_hull_; }
  std::array<double, 2> squared_lambdas() const { return lambda2_; }
  std::array<double, 2> exact_squared_lambdas() const { return lambda2_; }
  std::array<double, 2> squared_cell_radii() const {
    return {radius(0), radius(1)};
  }
  std::array<double, 2> exact_squared_cell_radii() const {
    return squared_cell_radii();
  }
  double squared_circumradius() const { return r2_; }
  double exact_squared_circumradius() const { return r2_; }

 private:
  static Edge ends_of(const Triangulation2& t, Side side) {
    const auto& vertex = t.cell(side.cell()).vertex;
    const auto& [i, k] = delaunay::kSideCorners[side.index()];
    return {std::min(vertex[i], vertex[k]), std::max(vertex[i], vertex[k])};
  }

  /// Of the angle at p in the triangle p a b.
  static double squared_sine(const Point2& p, const Point2& a,
                             const Point2& b) {
    const Point2 u = (a - p).stableNormalized();
    const Point2 v = (b - p).stableNormalized();
    const double sine = u.x() * v.y() - u.y() * v.x();
    return std::min(sine * sine, 1.0);
  }

  double radius(std::size_t i) const {
    return lambda2_[i] > 0 ? r2_ / lambda2_[i] : kInfinity;
  }

  Edge ends_;
  double r2_ = 0;
  std::array<bool, 2> own_side_{}, beyond_hull_{};
  std::array<double, 2> lambda2_{};
};

using Balls = EmptyBalls<PlaneEdge>;

/// Brings the largest coordinate to about 1.
double scale_of(const Triangulation2& triangulation) {
  double largest = 0;
  for (const Point2& p : triangulation.points())
    largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  return largest > 0
             ? std::ldexp(1, -std::clamp(std::ilogb(largest), -1000, 1000))
             : 1;
}

/// Calls `use` with each edge, once.
template <class Use>
void each_edge(const Triangulation2& t, Use use) {
  const double scale = scale_of(t);
  for (std::uint32_t c = 0; c < t.n_finite_cells(); ++c)
    for (unsigned i = 0; i < 3; ++i)
      if (CellId{c} < t.cell(CellId{c}).neighbor[i].cell())
        use(PlaneEdge(t, Side(CellId{c}, i), scale));
}

template <class Predicate>
std::vector<Edge> edges_where(const Triangulation2& t, Predicate holds) {
  std::vector<Edge> result;
  each_edge(t, [&](const PlaneEdge& edge) {
    if (holds(Balls(edge))) result.push_back(edge.ends());
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::vector<Edge> lambda_complex(const Triangulation2& triangulation,
                                 double lower, double upper) {
  assert(0 <= lower && lower <= upper && upper <= 1);
  return edges_where(triangulation, [&](const Balls& discs) {
    return discs.hold_lambdas(lower * lower, upper * upper);
  });
}

std::vector<Edge> gabriel_complex(const Triangulation2& triangulation) {
  return edges_where(triangulation, [](const Balls& discs) {
    return discs.smallest_is_empty();
  });
}

std::vector<Edge> beta_skeleton(const Triangulation2& triangulation,
                                double beta) {
  assert(beta >= 1);
  return edges_where(triangulation, [&](const Balls& discs) {
    return discs.hold_both(1 / (beta * beta));
  });
}

std::vector<Edge> gamma_graph(const Triangulation2& triangulation, double c0,
                              double c1) {
  assert(-1 <= c0 && c0 <= c1 && c1 <= 1);
  return edges_where(triangulation, [&](const Balls& discs) {
    return discs.hold_gammas(c0, c1);
  });
}

std::vector<Edge> alpha_shape(const Triangulation2& triangulation,
                              double alpha) {
  assert(alpha >= 0);
  const double scaled = alpha * scale_of(triangulation);
  return edges_where(triangulation, [&](const Balls& discs) {
    return discs.hold_radius(scaled * scaled);
  });
}

std::optional<double> smallest_alpha(const Triangulation2& triangulation) {
  if (triangulation.dimension() < 2) return std::nullopt;
  std::vector<double> least(triangulation.points().size(), kInfinity);
  each_edge(triangulation, [&](const PlaneEdge& edge) {
    const double r2 = Balls(edge).smallest_radius();
    for (const VertexId v : edge.ends())
      least[index(v)] = std::min(least[index(v)], r2);
  });
  return root_from_above(*std::max_element(least.begin(), least.end())) /
         scale_of(triangulation);
}

}  // namespace umbrella
