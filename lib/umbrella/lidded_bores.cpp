// Each flat lid is put together with the nearest end behind it. Most often that
// is another lid. Where the body has been entered through the other end, a face
// with a circle cut out of it is left there, a mouth. It takes a look at all
// points to find one, so that is done for lids that have no reason to be there.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "umbrella/flat_lids_internal.h"
#include "umbrella/length_unit_internal.h"
#include "umbrella/lidded_bores_internal.h"
#include "umbrella/region_internal.h"
#include "umbrella/surface.h"

namespace umbrella {
namespace {

constexpr double kSlack = FlatLid::kTolerance;

/// How far the body goes on behind a until b, if they are two ends of a bore.
std::optional<double> depth(const FlatLid& a, const FlatLid& b) {
  const Point3 axis = b.center - a.center;
  const double along = -axis.dot(a.normal);
  const bool is_behind = along > 0 && a.normal.dot(b.normal) < 0;
  if (is_behind && a.normal.cross(b.normal).norm() <= kSlack &&
      axis.cross(a.normal).norm() <= kSlack * (a.radius + along))
    return along;
  return {};
}

/// The nearest lid behind this one.
std::optional<std::size_t> nearest_behind(std::span<const FlatLid> lids,
                                          std::size_t i) {
  std::optional<double> least;
  std::size_t nearest = i;
  for (std::size_t k = 0; k < lids.size(); ++k) {
    const auto along = depth(lids[i], lids[k]);
    if (!along || (least && *least <= *along)) continue;
    least = along;
    nearest = k;
  }
  if (!least) return {};
  return nearest;
}

/// Whether a lid is no wider than what lies between the points of its face.
bool is_narrow(const FlatLid& lid) {
  constexpr double kLeastRadius = 1.5;
  return lid.radius < kLeastRadius * lid.spacing;
}

bool is_explained(const FlatLid& lid) {
  return 2 * lid.n_flat <= lid.rim.size();
}

/// Whether a part of the rim is no edge of the shape with the lid.
bool is_half_open(const FlatLid& lid) {
  return 4 * lid.n_flat >= lid.rim.size();
}

bool are_of_one_size(const FlatLid& a, const FlatLid& b) {
  return std::abs(a.radius - b.radius) <= kSlack * a.radius;
}

/// Of two ends of a bore those that have to go, so that most corners of a rim
/// have a reason to be there. The ends of a bore with steps differ, and one may
/// be right; those of one without steps are the same, and judged together.
std::vector<const FlatLid*> unexplained(const FlatLid& a, const FlatLid& b) {
  if (are_of_one_size(a, b)) {
    if (2 * (a.n_flat + b.n_flat) > a.rim.size() + b.rim.size())
      return {&a, &b};
    return {};
  }
  std::vector<const FlatLid*> result;
  for (const FlatLid* lid : {&a, &b})
    if (!is_explained(*lid)) result.push_back(lid);
  return result;
}

class BoreSearch {
 public:
  BoreSearch(const delaunay::Triangulation3& triangulation,
             const WorkingSurface& surface, Effort& effort)
      : points_(triangulation.points()),
        unit_(length_unit(triangulation)),
        surface_(surface),
        effort_(effort) {}

  std::vector<LiddedBore> run(std::vector<FlatLid> lids);

 private:
  using Ring = std::vector<std::pair<double, VertexId>>;  // along, ascending

  Point3 point(VertexId v) const { return unit_ * points_[index(v)]; }
  void set_outward();
  Point3 outward(TriangleIndex t) const;
  Ring on_cylinder(const FlatLid& lid, const Point3& way) const;
  bool is_mouth(std::span<const Ring::value_type> ring,
                const BoreEnd& end) const;
  bool has_face_about(VertexId v, const BoreEnd& end) const;
  std::optional<BoreEnd> mouth(const FlatLid& lid, const Point3& way);
  void add_lid(const FlatLid& lid, LiddedBore& bore) const;
  LiddedBore between(const FlatLid& a, const FlatLid& b) const;
  std::optional<LiddedBore> to_mouth(const FlatLid& lid);

  std::span<const Point3> points_;
  const double unit_;
  const WorkingSurface& surface_;
  Effort& effort_;
  std::vector<OrientedTriangle> oriented_;  // by triangle
};

/// Turns all triangles so that their normals point out of the body.
void BoreSearch::set_outward() {
  std::vector<LocatedTriangle> triangles;
  std::vector<TriangleIndex> indices;
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t)
    if (surface_.contains(t)) {
      triangles.push_back(surface_.triangle(t));
      indices.push_back(t);
    }
  const OrientedSurface turned = orient(points_, triangles);
  oriented_.resize(surface_.n_indices());
  for (std::size_t i = 0; i < indices.size(); ++i)
    oriented_[indices[i]] = turned.triangles[i];
}

/// Not of unit length.
Point3 BoreSearch::outward(TriangleIndex t) const {
  const auto& [a, b, c] = oriented_[t];
  const Point3 u = (points_[b] - points_[a]).stableNormalized();
  const Point3 v = (points_[c] - points_[a]).stableNormalized();
  return u.cross(v);
}

/// The points on one side of a lid that are as far from its axis as its rim.
BoreSearch::Ring BoreSearch::on_cylinder(const FlatLid& lid,
                                         const Point3& way) const {
  const double slack = kSlack * lid.radius;
  Ring result;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const VertexId v{static_cast<std::uint32_t>(i)};
    const Point3 arm = point(v) - lid.center;
    const double along = way.dot(arm);
    const double radius = (arm - along * way).norm();
    if (along > slack && std::abs(radius - lid.radius) <= slack &&
        surface_.is_used(v))
      result.emplace_back(along, v);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Whether a triangle at v lies in the face about an end, outward as that.
bool BoreSearch::has_face_about(VertexId v, const BoreEnd& end) const {
  bool result = false;
  surface_.for_each_at(v, [&](TriangleIndex t) {
    double farthest = 0;
    bool is_flat = true;
    for (const VertexId w : surface_.corners(t)) {
      const Point3 arm = point(w) - end.center;
      is_flat &= std::abs(end.normal.dot(arm)) <= kSlack * arm.norm();
      farthest = std::max(farthest, arm.norm());
    }
    result |= is_flat && farthest > (1 + kSlack) * end.radius &&
              outward(t).dot(end.normal) > 0;
  });
  return result;
}

bool BoreSearch::is_mouth(std::span<const Ring::value_type> ring,
                          const BoreEnd& end) const {
  std::vector<Point3> arms;
  for (const auto& [along, v] : ring) arms.push_back(point(v) - end.center);
  if (!is_closed_round(arms, end.normal)) return false;
  const auto n_about = std::count_if(
      ring.begin(), ring.end(),
      [&](const auto& item) { return has_face_about(item.second, end); });
  return 2 * static_cast<std::size_t>(n_about) > ring.size();
}

/// The nearest one on one side of a lid; its face looks away from that.
std::optional<BoreEnd> BoreSearch::mouth(const FlatLid& lid,
                                         const Point3& way) {
  if (effort_.is_spent()) return {};
  effort_.charge(0, points_.size());
  const Ring all = on_cylinder(lid, way);
  for (auto first = all.begin(); first != all.end();) {
    const double most = first->first + 2 * kSlack * lid.radius;
    const auto last = std::find_if(
        first, all.end(), [&](const auto& item) { return item.first > most; });
    const Point3 center = lid.center + first->first * way;
    BoreEnd end = {{}, center, way, lid.radius};
    if (is_mouth({first, last}, end)) {
      for (; first != last; ++first) end.rim.push_back(first->second);
      std::sort(end.rim.begin(), end.rim.end());
      return end;
    }
    first = last;
  }
  return {};
}

void BoreSearch::add_lid(const FlatLid& lid, LiddedBore& bore) const {
  for (const TriangleIndex t : lid.triangles)
    bore.lids.push_back(surface_.triangle(t));
  bore.ends.push_back({lid.rim, lid.center, lid.normal, lid.radius});
}

/// The ends of a bore that both have a lid.
LiddedBore BoreSearch::between(const FlatLid& a, const FlatLid& b) const {
  LiddedBore result;
  std::vector<const FlatLid*> lids = unexplained(a, b);
  if (lids.empty() && are_of_one_size(a, b) && is_half_open(a) &&
      is_half_open(b)) {
    lids = {&a, &b};
    result.is_half_open = true;
  }
  result.rims = united(a.rim, b.rim);
  for (const FlatLid* lid : lids) add_lid(*lid, result);
  return result;
}

/// From a lid that is alone to the mouth at the other end.
std::optional<LiddedBore> BoreSearch::to_mouth(const FlatLid& lid) {
  LiddedBore result;
  auto other = mouth(lid, -lid.normal);
  if (!other) {
    other = mouth(lid, lid.normal);
    result.is_half_open = true;
  }
  if (!other) return {};
  result.rims = united(lid.rim, other->rim);
  add_lid(lid, result);
  result.ends.push_back(*other);
  return result;
}

std::vector<LiddedBore> BoreSearch::run(std::vector<FlatLid> lids) {
  std::erase_if(lids, is_narrow);
  if (std::none_of(lids.begin(), lids.end(),
                   [](const FlatLid& lid) { return lid.n_flat > 0; }))
    return {};
  set_outward();
  for (FlatLid& lid : lids)
    if (outward(lid.triangles[0]).dot(lid.normal) < 0) lid.normal = -lid.normal;
  std::set<std::pair<std::size_t, std::size_t>> pairs;  // first < second
  std::vector<bool> is_alone(lids.size(), true);
  for (std::size_t i = 0; i < lids.size(); ++i)
    if (const auto other = nearest_behind(lids, i)) {
      pairs.insert(std::minmax(i, *other));
      is_alone[i] = is_alone[*other] = false;
    }
  std::vector<LiddedBore> result;
  result.reserve(pairs.size());
  for (const auto& [first, second] : pairs)
    result.push_back(between(lids[first], lids[second]));
  for (std::size_t i = 0; i < lids.size(); ++i) {
    if (!is_alone[i] || is_explained(lids[i])) continue;
    if (auto bore = to_mouth(lids[i])) result.push_back(std::move(*bore));
  }
  std::erase_if(result,
                [](const LiddedBore& bore) { return bore.lids.empty(); });
  return result;
}

}  // namespace

std::vector<LiddedBore> find_lidded_bores(
    const delaunay::Triangulation3& triangulation,
    const WorkingSurface& surface, Effort& effort) {
  const auto run = [&](Effort& lent) {
    return BoreSearch(triangulation, surface, lent)
        .run(find_flat_lids(triangulation, surface));
  };
  return effort.lend(0, effort.propagations / 2,
                     run);  // the rest is to open them
}

}  // namespace umbrella
