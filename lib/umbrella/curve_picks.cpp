#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "predicates/gabriel.h"
#include "umbrella/curve_picks_internal.h"

// Two passes over the cells, for cells lie in the order of their making, and
// what they point to is mostly far away. The first notes of each cell the side
// that it sees under an obtuse angle, if any, and its curvature; with these the
// second has to read the points of Gabriel edges alone, a third of all.

namespace umbrella {
namespace {

using delaunay::Cell2;
using delaunay::CellId;
using delaunay::Point2;
using delaunay::Side;
using delaunay::Triangulation2;
using delaunay::VertexId;

// The dot product u.v has at most four roundings, each below 2^-53 of the sum
// of its terms' sizes; below that, and where the terms may underflow, the exact
// predicate decides.
bool is_obtuse(const Point2& p, const Point2& a, const Point2& b) {
  constexpr double kError = 0x1p-50;
  constexpr double kNormal = 0x1p-900;
  const double x = (a.x() - p.x()) * (b.x() - p.x());
  const double y = (a.y() - p.y()) * (b.y() - p.y());
  const double dot = x + y;
  const double doubt = kError * (std::abs(x) + std::abs(y)) + kNormal;
  if (dot > doubt) return false;
  if (dot < -doubt) return true;
  return predicates::gabriel_edge(a.data(), b.data(), p.data()) < 0;
}

// Square of the sine of the angle under which p sees a b.
double sine2(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 u = (a - p).stableNormalized();
  const Point2 v = (b - p).stableNormalized();
  const double sine = u.x() * v.y() - u.y() * v.x();
  return std::min(1.0, sine * sine);
}

constexpr std::uint8_t kNoSide = 3;
constexpr double kUnknown = -1;

class Picker {
 public:
  explicit Picker(const Triangulation2& t)
      : t_(t),
        obtuse_side_(t.cells().size(), kNoSide),
        curvature2_(t.cells().size()) {
    constexpr auto kNone = CurveLinks::kNone;
    picked_.others.resize(t.points().size(), {kNone, kNone});
    picked_.lambda2.resize(t.points().size());
  }

  PickedEdges run() && {
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c) {
      prefetch_points(c);
      look_at(CellId{c});
    }
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c)
      pick_sides(CellId{c});
    return std::move(picked_);
  }

 private:
  void prefetch_points(std::size_t c) const {
    constexpr std::size_t kAhead = 12;
    if (c + kAhead >= t_.n_finite_cells()) return;
    for (const VertexId v : t_.cells()[c + kAhead].vertex)
      __builtin_prefetch(&t_.points()[index(v)]);
  }

  void look_at(CellId c) {
    const Cell2& cell = t_.cell(c);
    const std::array<Point2, 3> p = {t_.point(cell.vertex[0]),
                                     t_.point(cell.vertex[1]),
                                     t_.point(cell.vertex[2])};
    for (unsigned i = 0; i < 3; ++i) {
      const auto& [j, k] = delaunay::kSideCorners[i];
      if (!is_obtuse(p[i], p[j], p[k])) continue;
      obtuse_side_[index(c)] = static_cast<std::uint8_t>(i);
      break;  // there is one at most
    }
    curvature2_[index(c)] = curvature2(p);
  }

  // 1 / D^2 with the diameter of the circumcircle D = |u||v||w| / |u x v|. The
  // two shorter sides give the area: two long ones may be nearly parallel.
  static double curvature2(const std::array<Point2, 3>& p) {
    constexpr double kNormal = 0x1p-900;
    Point2 u = p[1] - p[0];
    Point2 v = p[2] - p[1];
    Point2 w = p[0] - p[2];
    double u2 = u.squaredNorm();
    double v2 = v.squaredNorm();
    double w2 = w.squaredNorm();
    const double all = u2 * v2 * w2;
    if (!(all > kNormal && all < 1 / kNormal)) return kUnknown;
    if (u2 > w2 && u2 > v2)
      std::swap(u, w);
    else if (v2 > w2)
      std::swap(v, w);
    const double area = u.x() * v.y() - u.y() * v.x();
    return area * area / all;
  }

  void pick_sides(CellId c) {
    const Cell2& cell = t_.cell(c);
    for (unsigned i = 0; i < 3; ++i) {
      const Side there = cell.neighbor[i];
      if (there.cell() < c || obtuse_side_[index(c)] == i ||
          obtuse_side_[index(there.cell())] == there.index())
        continue;
      const auto& k = delaunay::kSideCorners[i];
      pick(cell.vertex[k[0]], cell.vertex[k[1]], {Side(c, i), there});
    }
  }

  void pick(VertexId v, VertexId w, const std::array<Side, 2>& sides) {
    ++picked_.n_gabriel;
    const Point2& a = t_.point(v);
    const Point2& b = t_.point(w);
    const double length2 = (b - a).squaredNorm();
    double lambda2 = 1;
    for (const Side side : sides) {
      const double curvature2 = curvature2_[index(side.cell())];
      lambda2 =
          std::min(lambda2, curvature2 == kUnknown ? sine2(apex(side), a, b)
                                                   : length2 * curvature2);
    }
    offer(v, w, lambda2);
    offer(w, v, lambda2);
  }

  const Point2& apex(Side side) const {
    return t_.point(t_.cell(side.cell()).vertex[side.index()]);
  }

  /// Takes w among the picks of v if it is better than one of these.
  void offer(VertexId v, VertexId w, double lambda2) {
    auto& others = picked_.others[index(v)];
    auto& lambdas = picked_.lambda2[index(v)];
    const auto is_better = [&](unsigned i) {
      if (others[i] == CurveLinks::kNone) return true;
      if (lambda2 != lambdas[i]) return lambda2 < lambdas[i];
      return is_before(v, w, others[i]);
    };
    if (!is_better(1)) return;
    const unsigned place = is_better(0) ? 0 : 1;
    if (place == 0) {
      others[1] = others[0];
      lambdas[1] = lambdas[0];
    }
    others[place] = w;
    lambdas[place] = lambda2;
  }

  /// The order of edges v a and v b of the same lambda.
  bool is_before(VertexId v, VertexId a, VertexId b) const {
    const double a2 = (t_.point(a) - t_.point(v)).squaredNorm();
    const double b2 = (t_.point(b) - t_.point(v)).squaredNorm();
    const auto [a_low, a_high] = std::minmax(v, a);
    const auto [b_low, b_high] = std::minmax(v, b);
    return std::tie(a2, a_low, a_high) < std::tie(b2, b_low, b_high);
  }

  const Triangulation2& t_;
  std::vector<std::uint8_t> obtuse_side_;  // of a cell, or kNoSide
  std::vector<double> curvature2_;         // of a cell: 0 beyond the hull
  PickedEdges picked_;
};

}  // namespace

PickedEdges pick_edges(const Triangulation2& triangulation) {
  return Picker(triangulation).run();
}

CurveLinks agreed_links(const PickedEdges& picked) {
  constexpr auto kNone = CurveLinks::kNone;
  std::vector<std::array<VertexId, 2>> links(picked.others.size(),
                                             {kNone, kNone});
  for (std::uint32_t v = 0; v < links.size(); ++v) {
    // A vertex with a single Gabriel edge picks none.
    if (picked.others[v][1] == kNone) continue;
    for (const unsigned i : {0, 1}) {
      const VertexId w = picked.others[v][i];
      const auto& [one, other] = picked.others[index(w)];
      if (other != kNone && (one == VertexId{v} || other == VertexId{v}))
        links[v][i] = w;
    }
  }
  return CurveLinks(std::move(links));
}

}  // namespace umbrella
