// A polygon that is cut into triangles has an ear, a triangle with two sides on
// the rim. With corners on a circle and no wide gap an ear is very obtuse, as
// few triangles of a surface are. Across the longest side of an obtuse triangle
// of the lid lies one that is nearer to the centre; the last one holds it, and
// tells the circle well. From there the lid is collected.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "umbrella/flat_lids_internal.h"
#include "umbrella/length_unit_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

/// Of a triangle: its longest side is opposite corner `apex`, and the angle
/// there is gamma.
struct Widest {
  unsigned apex;
  double cosine;   // 2 |a| |b| cos(gamma), with sides a and b at the apex
  double squares;  // |a|^2 |b|^2

  bool is_obtuse() const { return cosine < 0; }
  /// Up to rounding.
  bool is_right() const { return cosine * cosine < 1e-4 * squares; }
};

class LidSearch {
 public:
  LidSearch(const delaunay::Triangulation3& triangulation,
            const WorkingSurface& surface)
      : points_(triangulation.points()),
        unit_(length_unit(triangulation)),
        surface_(surface),
        is_met_(surface.n_indices()),
        is_in_lid_(surface.n_indices()),
        is_on_rim_(surface.n_vertices()) {}

  std::vector<FlatLid> run();

 private:
  Point3 point(VertexId v) const { return unit_ * points_[index(v)]; }
  bool may_be_ear(TriangleIndex t) const;
  bool is_kite(TriangleIndex ear) const;
  Widest widest(TriangleIndex t) const;
  std::optional<TriangleIndex> across(TriangleIndex t, unsigned apex) const;
  std::optional<TriangleIndex> middle(TriangleIndex ear);
  void set_circle(TriangleIndex t, FlatLid& lid) const;
  void collect(TriangleIndex middle, FlatLid& lid);
  bool is_disc(const FlatLid& lid) const;
  bool is_flat_about(VertexId v, const FlatLid& lid) const;
  std::vector<VertexId> neighbors(const FlatLid& lid) const;
  void look_about(FlatLid& lid) const;

  std::span<const Point3> points_;
  const double unit_;  // a power of two; formulas here go up to degree 8
  const WorkingSurface& surface_;
  std::vector<std::uint8_t> is_met_;  // on the way to a middle
  std::vector<std::uint8_t> is_in_lid_;
  std::vector<bool> is_on_rim_;  // by vertex
};

/// Whether some angle has 135 degrees, but for rounding: with sides a and b at
/// it, c^2 >= a^2 + b^2 + sqrt(2) a b. This is all that most triangles are
/// asked.
bool LidSearch::may_be_ear(TriangleIndex t) const {
  const auto& [u, v, w] = surface_.corners(t);
  const double uv = (point(v) - point(u)).squaredNorm();
  const double vw = (point(w) - point(v)).squaredNorm();
  const double wu = (point(u) - point(w)).squaredNorm();
  const double cc = std::max(uv, std::max(vw, wu));
  const double others = uv + vw + wu - cc, excess = cc - others;
  const double aa = std::min(uv, std::min(vw, wu)), bb = others - aa;
  return excess * std::abs(excess) > 1.8 * aa * bb;  // one branch, not two
}

/// Whether the ear and the triangle at its longest side may lie in one circle:
/// opposite angles then add up to 180 degrees.
bool LidSearch::is_kite(TriangleIndex ear) const {
  constexpr double kSlack = 0.2;  // wide
  const Widest angle = widest(ear);
  const auto other = across(ear, angle.apex);
  if (!other) return false;
  const Triangle& corners = surface_.corners(ear);
  const VertexId a = corners[(angle.apex + 1) % 3];
  const VertexId b = corners[(angle.apex + 2) % 3];
  VertexId far = a;
  for (const VertexId v : surface_.corners(*other))
    if (v != a && v != b) far = v;
  const Point3 to_a = point(a) - point(far), to_b = point(b) - point(far);
  const double cosine = 2 * to_a.dot(to_b);
  const double squares = to_a.squaredNorm() * to_b.squaredNorm();
  const double one = cosine * cosine * angle.squares;
  const double opposite = angle.cosine * angle.cosine * squares;
  return cosine > 0 && std::abs(one - opposite) < kSlack * opposite;
}

Widest LidSearch::widest(TriangleIndex t) const {
  const auto& [a, b, c] = surface_.corners(t);
  const std::array<double, 3> opposite = {(point(c) - point(b)).squaredNorm(),
                                          (point(a) - point(c)).squaredNorm(),
                                          (point(b) - point(a)).squaredNorm()};
  const auto apex = static_cast<unsigned>(
      std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
  const double one = opposite[(apex + 1) % 3], other = opposite[(apex + 2) % 3];
  return {apex, one + other - opposite[apex], one * other};
}

/// The other triangle at the side opposite corner `apex`.
std::optional<TriangleIndex> LidSearch::across(TriangleIndex t,
                                               unsigned apex) const {
  const Triangle& corners = surface_.corners(t);
  const VertexId a = corners[(apex + 1) % 3], b = corners[(apex + 2) % 3];
  std::optional<TriangleIndex> result;
  surface_.for_each_at(a, [&](TriangleIndex s) {
    const Triangle& other = surface_.corners(s);
    if (s != t && std::find(other.begin(), other.end(), b) != other.end())
      result = s;
  });
  return result;
}

/// The triangle about the centre, if the ear is one of a lid; none if the way
/// there has been gone before.
std::optional<TriangleIndex> LidSearch::middle(TriangleIndex ear) {
  TriangleIndex t = ear;
  while (is_met_[t] == 0) {
    is_met_[t] = 1;
    const Widest angle = widest(t);
    if (!angle.is_obtuse() || angle.is_right()) return t;
    const auto next = across(t, angle.apex);
    if (!next) return {};
    t = *next;
  }
  return {};
}

void LidSearch::set_circle(TriangleIndex t, FlatLid& lid) const {
  const auto& [a, b, c] = surface_.corners(t);
  const Point3 u = point(b) - point(a), v = point(c) - point(a);
  const Point3 n = u.cross(v);
  const Point3 arm =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) /
      (2 * n.squaredNorm());
  lid.center = point(a) + arm;
  lid.radius = arm.norm();
  lid.normal = n.normalized();
}

void LidSearch::collect(TriangleIndex middle, FlatLid& lid) {
  const double slack = FlatLid::kTolerance * lid.radius;
  const auto is_on_circle = [&](VertexId v) {
    const Point3 arm = point(v) - lid.center;
    return std::abs(lid.normal.dot(arm)) <= slack &&
           std::abs(arm.norm() - lid.radius) <= slack;
  };
  lid.triangles = {middle};
  is_in_lid_[middle] = 1;
  for (std::size_t i = 0; i < lid.triangles.size(); ++i) {
    const TriangleIndex t = lid.triangles[i];
    for (unsigned apex = 0; apex < 3; ++apex) {
      const auto next = across(t, apex);
      if (!next || is_in_lid_[*next] != 0) continue;
      const Triangle& corners = surface_.corners(*next);
      if (!std::all_of(corners.begin(), corners.end(), is_on_circle)) continue;
      is_in_lid_[*next] = 1;
      lid.triangles.push_back(*next);
    }
  }
  for (const TriangleIndex t : lid.triangles)
    for (const VertexId v : surface_.corners(t)) lid.rim.push_back(v);
  sort_unique(lid.rim);
}

bool LidSearch::is_disc(const FlatLid& lid) const {
  if (lid.triangles.size() + 2 != lid.rim.size()) return false;
  std::vector<Point3> arms;
  for (const VertexId v : lid.rim) arms.push_back(point(v) - lid.center);
  return is_closed_round(arms, lid.normal);
}

/// Whether all triangles at v lie in the plane, seen from the centre.
bool LidSearch::is_flat_about(VertexId v, const FlatLid& lid) const {
  bool is_flat = true;
  surface_.for_each_at(v, [&](TriangleIndex t) {
    for (const VertexId w : surface_.corners(t)) {
      const Point3 arm = point(w) - lid.center;
      is_flat &=
          std::abs(lid.normal.dot(arm)) <= FlatLid::kTolerance * arm.norm();
    }
  });
  return is_flat;
}

/// Vertices joined to the rim that are on no rim; ascending.
std::vector<VertexId> LidSearch::neighbors(const FlatLid& lid) const {
  std::vector<VertexId> result;
  for (const VertexId v : lid.rim)
    surface_.for_each_at(v, [&](TriangleIndex t) {
      for (const VertexId w : surface_.corners(t))
        if (!is_on_rim_[index(w)]) result.push_back(w);
    });
  sort_unique(result);
  return result;
}

/// At the face that the lid is part of.
void LidSearch::look_about(FlatLid& lid) const {
  for (const VertexId v : lid.rim) lid.n_flat += is_flat_about(v, lid) ? 1 : 0;
  double sum = 0;
  std::size_t n = 0;
  const std::vector<VertexId> about = neighbors(lid);
  for (const VertexId v : about) {
    if (!is_flat_about(v, lid)) continue;
    sum += (point(v) - lid.center).norm() - lid.radius;
    ++n;
  }
  if (2 * n > about.size()) lid.spacing = sum / static_cast<double>(n);
}

std::vector<FlatLid> LidSearch::run() {
  std::vector<FlatLid> result;
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t) {
    if (!may_be_ear(t) || !surface_.contains(t) || is_met_[t] != 0 ||
        !is_kite(t))
      continue;
    const auto about_center = middle(t);
    if (!about_center || is_in_lid_[*about_center] != 0) continue;
    FlatLid lid;
    set_circle(*about_center, lid);
    collect(*about_center, lid);
    if (!is_disc(lid)) continue;
    for (const VertexId v : lid.rim) is_on_rim_[index(v)] = true;
    result.push_back(std::move(lid));
  }
  for (FlatLid& lid : result) look_about(lid);
  return result;
}

}  // namespace

bool is_closed_round(std::span<const Point3> arms, const Point3& axis) {
  if (arms.size() < 8) return false;
  const Point3 x = (arms[0] - axis.dot(arms[0]) * axis).normalized();
  const Point3 y = axis.cross(x);
  std::vector<double> angle;
  for (const Point3& arm : arms)
    angle.push_back(std::atan2(arm.dot(y), arm.dot(x)));
  std::sort(angle.begin(), angle.end());
  double widest = angle.front() + 2 * std::numbers::pi - angle.back();
  for (std::size_t i = 1; i < angle.size(); ++i)
    widest = std::max(widest, angle[i] - angle[i - 1]);
  return widest < (1 + FlatLid::kTolerance) * std::numbers::pi / 4;
}

std::vector<FlatLid> find_flat_lids(
    const delaunay::Triangulation3& triangulation,
    const WorkingSurface& surface) {
  return LidSearch(triangulation, surface).run();
}

}  // namespace umbrella
