#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "predicates/gabriel.h"
#include "umbrella/curve_graph_internal.h"
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

constexpr std::uint8_t kNoSide = 3;
constexpr double kUnknown = -1;
constexpr double kNothing = 2;  // more than any square of a sine

double cross(const Point2& u, const Point2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

class Triangle {
 public:
  explicit Triangle(const std::array<Point2, 3>& points)
      : p_(points),
        u_(points[1] - points[0]),
        v_(points[2] - points[1]),
        w_(points[0] - points[2]),
        u2_(u_.squaredNorm()),
        v2_(v_.squaredNorm()),
        w2_(w_.squaredNorm()) {}

  // A dot product has at most four roundings, each below 2^-53 of the sum of
  // its terms' sizes, which is at most that of the squares; below that, and
  // where the terms may underflow, the exact predicate decides.
  std::uint8_t obtuse_side() const {
    constexpr double kError = 0x1p-50;
    const std::array<double, 3> dot = {-u_.dot(w_), -u_.dot(v_), -v_.dot(w_)};
    const double least = std::min({dot[0], dot[1], dot[2]});
    const double doubt = kError * (u2_ + v2_ + w2_) + kNormal;
    if (!(std::abs(least) > doubt)) return exact_obtuse_side();
    if (least > 0) return kNoSide;
    return static_cast<std::uint8_t>(least == dot[0]   ? 0
                                     : least == dot[1] ? 1
                                                       : 2);
  }

  // 1 / D^2 with the diameter of the circumcircle D = |u||v||w| / |u x v|. The
  // two shorter sides give the area: two long ones may be nearly parallel.
  double curvature2() const {
    const double all = u2_ * v2_ * w2_;
    if (!(all > kNormal && all < 1 / kNormal)) return kUnknown;
    const bool u_is_longest = u2_ > w2_ && u2_ > v2_;
    const double area = u_is_longest ? cross(v_, w_)
                        : v2_ > w2_  ? cross(u_, w_)
                                     : cross(u_, v_);
    return area * area / all;
  }

 private:
  static constexpr double kNormal = 0x1p-900;

  std::uint8_t exact_obtuse_side() const {
    for (std::uint8_t i = 0; i < 3; ++i) {
      const auto& [j, k] = delaunay::kSideCorners[i];
      if (predicates::gabriel_edge(p_[j].data(), p_[k].data(), p_[i].data()) <
          0)
        return i;  // there is one at most
    }
    return kNoSide;
  }

  const std::array<Point2, 3>& p_;
  Point2 u_, v_, w_;
  double u2_, v2_, w2_;
};

class Picker {
 public:
  explicit Picker(const Triangulation2& t)
      : t_(t),
        obtuse_side_(t.cells().size(), kNoSide),
        curvature2_(t.cells().size()) {
    constexpr auto kNone = CurveLinks::kNone;
    picked_.others.resize(t.points().size(), {kNone, kNone});
    picked_.lambda2.resize(t.points().size(), {kNothing, kNothing});
  }

  PickedEdges run() && {
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); ++c) {
      prefetch_points(c);
      look_at(CellId{c});
    }
    for (std::uint32_t c = 0; c < t_.n_finite_cells(); c += kBlock)
      pick_sides(c);
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
    const std::array<Point2, 3> points = {t_.point(cell.vertex[0]),
                                          t_.point(cell.vertex[1]),
                                          t_.point(cell.vertex[2])};
    const Triangle triangle(points);
    obtuse_side_[index(c)] = triangle.obtuse_side();
    curvature2_[index(c)] = triangle.curvature2();
  }

  static constexpr std::uint32_t kBlock = 256;

  /// Picks among the sides of so many cells. They are found first and without
  /// a branch, for which sides are Gabriel edges no processor can guess.
  void pick_sides(std::uint32_t first) {
    const auto n_cells = static_cast<std::uint32_t>(t_.n_finite_cells());
    std::array<Side, 3 * kBlock> found;
    std::size_t n_found = 0;
    for (std::uint32_t c = first; c < std::min(first + kBlock, n_cells); ++c) {
      for (unsigned i = 0; i < 3; ++i) {
        const Side there = t_.cell(CellId{c}).neighbor[i];
        const auto is_seen_obtuse =
            static_cast<unsigned>(obtuse_side_[c] == i) |
            static_cast<unsigned>(obtuse_side_[index(there.cell())] ==
                                  there.index());
        found[n_found] = Side(CellId{c}, i);
        n_found += static_cast<unsigned>(there.cell() >= CellId{c}) &
                   (is_seen_obtuse ^ 1U);
      }
    }
    for (const Side side : std::span(found).first(n_found)) pick(side);
  }

  void pick(Side here) {
    ++picked_.n_gabriel;
    const Cell2& cell = t_.cell(here.cell());
    const auto& [left, right] = delaunay::kSideCorners[here.index()];
    const VertexId v = cell.vertex[left];
    const VertexId w = cell.vertex[right];
    const Point2& a = t_.point(v);
    const Point2& b = t_.point(w);
    const double length2 = (b - a).squaredNorm();
    double lambda2 = 1;
    for (const Side side : {here, cell.neighbor[here.index()]}) {
      const double curvature2 = curvature2_[index(side.cell())];
      if (curvature2 == kUnknown) {
        const double lambda = sine(apex(side), a, b);
        lambda2 = std::min(lambda2, lambda * lambda);
      } else {
        lambda2 = std::min(lambda2, length2 * curvature2);
      }
    }
    offer(v, w, lambda2);
    offer(w, v, lambda2);
  }

  const Point2& apex(Side side) const {
    return t_.point(t_.cell(side.cell()).vertex[side.index()]);
  }

  /// Takes w among the picks of v if it is better than one of these.
  void offer(VertexId v, VertexId w, double lambda2) {
    auto& [first, second] = picked_.others[index(v)];
    auto& [least, next] = picked_.lambda2[index(v)];
    bool is_first = lambda2 < least;
    bool is_second = lambda2 < next;
    if (lambda2 == least) is_first = is_before(v, w, first);
    if (lambda2 == next) is_second = is_before(v, w, second);
    second = is_first ? first : is_second ? w : second;
    next = is_first ? least : is_second ? lambda2 : next;
    first = is_first ? w : first;
    least = is_first ? lambda2 : least;
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
