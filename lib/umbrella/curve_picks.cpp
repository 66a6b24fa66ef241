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
        curvature2_(t.cells().size()),
        picks_(t.points().size()) {}

  PickedEdges run() && {
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c) {
      prefetch_points(c);
      look_at(CellId{c});
    }
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c)
      pick_sides(CellId{c});
    return {std::move(picks_), n_gabriel_};
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
    ++n_gabriel_;
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
    offer(v, {w, lambda2, length2});
    offer(w, {v, lambda2, length2});
  }

  const Point2& apex(Side side) const {
    return t_.point(t_.cell(side.cell()).vertex[side.index()]);
  }

  void offer(VertexId v, const CurvePick& pick) {
    auto& [first, second] = picks_[index(v)];
    if (is_before(v, pick, first))
      second = std::exchange(first, pick);
    else if (is_before(v, pick, second))
      second = pick;
  }

  static bool is_before(VertexId v, const CurvePick& a, const CurvePick& b) {
    if (b.other == CurveLinks::kNone) return true;
    if (a.lambda2 != b.lambda2) return a.lambda2 < b.lambda2;
    const auto [a0, a1] = std::minmax(v, a.other);
    const auto [b0, b1] = std::minmax(v, b.other);
    return std::tie(a.length2, a0, a1) < std::tie(b.length2, b0, b1);
  }

  const Triangulation2& t_;
  std::vector<std::uint8_t> obtuse_side_;  // of a cell, or kNoSide
  std::vector<double> curvature2_;         // of a cell: 0 beyond the hull
  CurvePicks picks_;
  std::size_t n_gabriel_ = 0;
};

bool has_picked(const std::array<CurvePick, 2>& picks, VertexId v) {
  // A vertex with a single Gabriel edge picks none.
  return picks[1].other != CurveLinks::kNone &&
         (picks[0].other == v || picks[1].other == v);
}

}  // namespace

PickedEdges pick_edges(const Triangulation2& triangulation) {
  return Picker(triangulation).run();
}

CurveLinks agreed_links(const CurvePicks& picks) {
  CurveLinks links(picks.size());
  for (std::uint32_t i = 0; i < picks.size(); ++i) {
    const VertexId v{i};
    for (const CurvePick& pick : picks[i])
      if (pick.other != CurveLinks::kNone && v < pick.other &&
          has_picked(picks[i], pick.other) &&
          has_picked(picks[index(pick.other)], v))
        links.add(v, pick.other);
  }
  return links;
}

}  // namespace umbrella
