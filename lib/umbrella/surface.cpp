#include "umbrella/surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "umbrella/circumradius_internal.h"
#include "umbrella/closed_sweep_internal.h"
#include "umbrella/incidence_internal.h"

namespace umbrella {
namespace {

/// 3 t + i: the side of triangle t opposite its corner i. With ascending
/// corners sides 0 and 2 run up along their edge, side 1 runs down.
using Side = std::uint32_t;

constexpr bool runs_up(Side s) { return s % 3 != 1; }

/// Which sides lie on one edge: each knows the next, and the last the first.
class Edges {
 public:
  Edges(std::size_t n_vertices, std::span<const LocatedTriangle> triangles)
      : next_(3 * triangles.size()) {
    std::iota(next_.begin(), next_.end(), Side{0});
    std::vector<std::uint32_t> first;  // of the edges up from a vertex
    const std::vector<Upward> upward = by_low_end(n_vertices, triangles, first);
    // At a low end, the last side met towards each high one. A side met first
    // is put after itself, for whether it is, no processor can guess.
    struct Met {
      std::uint32_t low;
      Side side;
    };
    constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<Met> met(n_vertices, {kNone, 0});
    for (std::uint32_t low = 0; low < n_vertices; ++low)
      for (std::uint32_t i = first[low]; i < first[low + 1]; ++i) {
        const auto [high, side] = upward[i];
        Met& last = met[index(high)];
        const Side before = last.low == low ? last.side : side;
        next_[side] = next_[before];
        next_[before] = side;
        last = {low, side};
      }
  }

  /// Calls visit(Side) for each other side on the same edge. @return how many
  template <class Visit>
  std::size_t for_each_partner(Side side, Visit visit) const {
    std::size_t n = 0;
    for (Side other = next_[side]; other != side; other = next_[other], ++n)
      visit(other);
    return n;
  }

 private:
  struct Upward {
    VertexId high;
    Side side;
  };

  /// @param first  where those of a vertex begin, and the end
  static std::vector<Upward> by_low_end(
      std::size_t n_vertices, std::span<const LocatedTriangle> triangles,
      std::vector<std::uint32_t>& first) {
    first.assign(n_vertices + 1, 0);
    for (const auto& [corners, facet] : triangles) {
      first[index(corners[0])] += 2;
      first[index(corners[1])] += 1;
    }
    for (std::uint32_t v = 0, sum = 0; v <= n_vertices; ++v)
      first[v] = sum += first[v];
    std::vector<Upward> result(3 * triangles.size());
    for (auto t = static_cast<TriangleIndex>(triangles.size()); t-- > 0;) {
      const auto& [a, b, c] = triangles[t].corners;
      result[--first[index(a)]] = {b, 3 * t + 2};
      result[--first[index(a)]] = {c, 3 * t + 1};
      result[--first[index(b)]] = {c, 3 * t};
    }
    return result;
  }

  std::vector<Side> next_;
};

double signed_volume(std::span<const Point3> points, const Triangle& t,
                     const Point3& origin, double scale) {
  const auto corner = [&](unsigned i) {
    return scaled_difference(points[index(t[i])], origin, scale);
  };
  return dot(corner(0), cross(corner(1), corner(2)));
}

OrientedTriangle directed(const Triangle& t, bool is_turned) {
  const auto a = static_cast<std::uint32_t>(t[0]);
  const auto b = static_cast<std::uint32_t>(t[1]);
  const auto c = static_cast<std::uint32_t>(t[2]);
  // Masked, not jumped to: whether it is turned, no processor can guess.
  const std::uint32_t change =
      (b ^ c) & (0U - static_cast<std::uint32_t>(is_turned));
  return {a, b ^ change, c ^ change};
}

/// A walk from triangle to triangle, of any set of them.
class Orientation {
 public:
  Orientation(std::span<const Point3> points,
              std::span<const LocatedTriangle> triangles)
      : points_(points),
        triangles_(triangles),
        edges_(points.size(), triangles),
        turned_(triangles.size(), kNotReached),
        scale_(power_of_two_scale(points)) {}

  OrientedSurface run() {
    OrientedSurface result;
    result.is_closed = !triangles_.empty();
    for (TriangleIndex t = 0; t < triangles_.size(); ++t) {
      if (turned_[t] != kNotReached) continue;
      ++result.n_components;
      spread(t, result.is_closed);
    }
    result.triangles.reserve(triangles_.size());
    for (TriangleIndex t = 0; t < triangles_.size(); ++t)
      result.triangles.push_back(
          directed(triangles_[t].corners, turned_[t] == 1));
    return result;
  }

 private:
  static constexpr std::uint8_t kNotReached = 2;

  /// Orients the component of `start`.
  void spread(TriangleIndex start, bool& is_closed) {
    const Point3& origin = points_[index(triangles_[start].corners[0])];
    double volume = 0;
    component_ = {start};
    turned_[start] = 0;
    for (std::size_t next = 0; next < component_.size(); ++next) {
      const TriangleIndex t = component_[next];
      const double part =
          signed_volume(points_, triangles_[t].corners, origin, scale_);
      volume += turned_[t] == 1 ? -part : part;
      for (std::uint32_t i = 0; i < 3; ++i)
        is_closed = carry_over(3 * t + i) && is_closed;
    }
    if (volume >= 0) return;
    for (const TriangleIndex t : component_) turned_[t] ^= 1U;
  }

  /// Takes the orientation over an edge. @return whether the edge has two
  ///   triangles with opposite sense
  bool carry_over(Side side) {
    bool agrees = true;
    const bool up = runs_up(side) != (turned_[side / 3] == 1);
    const std::size_t n = edges_.for_each_partner(side, [&](Side partner) {
      std::uint8_t& turned = turned_[partner / 3];
      const std::uint8_t wanted = runs_up(partner) == up ? 1 : 0;
      if (turned == kNotReached) {
        turned = wanted;
        component_.push_back(partner / 3);
      }
      agrees = agrees && turned == wanted;
    });
    return agrees && n == 1;
  }

  std::span<const Point3> points_;
  std::span<const LocatedTriangle> triangles_;
  Edges edges_;
  std::vector<std::uint8_t> turned_;  // 1: against its ascending corners
  double scale_;
  std::vector<TriangleIndex> component_;
};

/// Six times the part of a triangle in the volume below a closed surface: what
/// lies between it and the plane x = 0 of the origin.
double part_of_volume(std::span<const Point3> points, const OrientedTriangle& t,
                      const Point3& origin, double scale) {
  const Point3& a = points[t[0]];
  const Point3& b = points[t[1]];
  const Point3& c = points[t[2]];
  const auto from = [scale](const Point3& p, const Point3& q, int i) {
    return scale * q[i] - scale * p[i];
  };
  const double area =
      from(a, b, 1) * from(a, c, 2) - from(a, b, 2) * from(a, c, 1);
  return area * (from(origin, a, 0) + from(origin, b, 0) + from(origin, c, 0));
}

/// Of a component.
struct Volume {
  const Point3* origin = nullptr;  // its own, so that little cancels
  double six_times = 0;
};

OrientedSurface turned_outward(std::span<const Point3> points,
                               std::span<const LocatedTriangle> triangles,
                               const TurnedTriangles& turned) {
  OrientedSurface result;
  result.is_closed = !triangles.empty();
  result.n_components = turned.n_components();
  result.triangles.reserve(triangles.size());
  const double scale = power_of_two_scale(points);
  std::vector<Volume> volumes(turned.n_components());
  for (TriangleIndex t = 0; t < triangles.size(); ++t) {
    auto& [origin, six_times] = volumes[turned.component(t)];
    if (origin == nullptr) origin = &points[index(triangles[t].corners[0])];
    result.triangles.push_back(
        directed(triangles[t].corners, turned.is_turned(t)));
    six_times += part_of_volume(points, result.triangles[t], *origin, scale);
  }
  const auto is_inside_out = [](const Volume& v) { return v.six_times < 0; };
  if (std::none_of(volumes.begin(), volumes.end(), is_inside_out))
    return result;
  for (TriangleIndex t = 0; t < triangles.size(); ++t)
    if (is_inside_out(volumes[turned.component(t)]))
      std::swap(result.triangles[t][1], result.triangles[t][2]);
  return result;
}

}  // namespace

OrientedSurface orient(std::span<const Point3> points,
                       std::span<const LocatedTriangle> triangles) {
  if (const auto turned = sweep_closed(points.size(), triangles))
    return turned_outward(points, triangles, *turned);
  return Orientation(points, triangles).run();
}

}  // namespace umbrella
