#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/bores_internal.h"
#include "umbrella/flat_lids_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/surface.h"

namespace umbrella {
namespace {

/// Turns the normals of the lids outward.
void turn_outward(const delaunay::Triangulation3& triangulation,
                  const WorkingSurface& surface, std::vector<FlatLid>& lids) {
  std::vector<LocatedTriangle> triangles;
  std::vector<std::size_t> place(surface.n_indices());
  for (TriangleIndex t = 0; t < surface.n_indices(); ++t) {
    place[t] = triangles.size();
    if (surface.contains(t)) triangles.push_back(surface.triangle(t));
  }
  const OrientedSurface oriented = orient(triangulation.points(), triangles);
  for (FlatLid& lid : lids) {
    const auto& [a, b, c] = oriented.triangles[place[lid.triangles[0]]];
    const auto points = triangulation.points();
    const Point3 u = (points[b] - points[a]).stableNormalized();
    const Point3 v = (points[c] - points[a]).stableNormalized();
    const Point3 outward = u.cross(v);
    if (outward.dot(lid.normal) < 0) lid.normal = -lid.normal;
  }
}

/// How far the body goes on behind a until b, if they are two ends of a bore.
std::optional<double> depth(const FlatLid& a, const FlatLid& b) {
  constexpr double kSlack = FlatLid::kTolerance;
  const Point3 axis = b.center - a.center;
  const double along = -axis.dot(a.normal);
  const bool is_behind = along > 0 && a.normal.dot(b.normal) < 0;
  if (is_behind && a.normal.cross(b.normal).norm() <= kSlack &&
      axis.cross(a.normal).norm() <= kSlack * (a.radius + along))
    return along;
  return {};
}

/// Whether a lid is no wider than what lies between the points of its face.
bool is_narrow(const FlatLid& lid) {
  constexpr double kLeastRadius = 1.5;
  return lid.radius < kLeastRadius * lid.spacing;
}

/// Of two ends of a bore those that have to go, so that most corners of a rim
/// have a reason to be there. The ends of a bore with steps differ, and one may
/// be right; those of one without steps are the same, and judged together.
std::vector<const FlatLid*> unexplained(const FlatLid& a, const FlatLid& b) {
  if (std::abs(a.radius - b.radius) <= FlatLid::kTolerance * a.radius) {
    if (2 * (a.n_flat + b.n_flat) > a.rim.size() + b.rim.size())
      return {&a, &b};
    return {};
  }
  std::vector<const FlatLid*> result;
  for (const FlatLid* lid : {&a, &b})
    if (2 * lid->n_flat > lid->rim.size()) result.push_back(lid);
  return result;
}

/// A bore and what is in its way.
struct Bore {
  std::vector<VertexId> rims;  // ascending
  std::vector<const FlatLid*> lids;
};

/// Each lid with the nearest one behind it: first < second.
std::set<std::pair<std::size_t, std::size_t>> facing_pairs(
    std::span<const FlatLid> lids) {
  std::set<std::pair<std::size_t, std::size_t>> result;
  for (std::size_t i = 0; i < lids.size(); ++i) {
    std::optional<double> least;
    std::size_t nearest = i;
    for (std::size_t k = 0; k < lids.size(); ++k) {
      const auto along = depth(lids[i], lids[k]);
      if (!along || (least && *least <= *along)) continue;
      least = along;
      nearest = k;
    }
    if (least) result.insert(std::minmax(i, nearest));
  }
  return result;
}

std::vector<Bore> lidded_bores(std::span<const FlatLid> lids) {
  std::vector<Bore> result;
  for (const auto& [first, second] : facing_pairs(lids)) {
    const FlatLid &a = lids[first], &b = lids[second];
    Bore bore = {united(a.rim, b.rim), unexplained(a, b)};
    if (!bore.lids.empty()) result.push_back(std::move(bore));
  }
  return result;
}

class Opening {
 public:
  Opening(const delaunay::Triangulation3& triangulation,
          const ClosingOptions& options, WorkingSurface& surface)
      : options_(options),
        surface_(surface),
        is_open_(triangulation.points().size()),
        groups_(triangulation, {}, surface),
        solver_(triangulation, options, surface, is_open_, groups_),
        effort_(local_effort(options, triangulation.points().size(), 1)) {}

  bool open(const Bore& bore);
  const RegionSolver& solver() const { return solver_; }

 private:
  bool has_all(const FlatLid& lid) const;
  std::vector<VertexId> ringed(std::span<const VertexId> vertices);
  bool attempt(const Region& region,
               std::span<const LocatedTriangle> lid_triangles);

  const ClosingOptions& options_;
  WorkingSurface& surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  LocalEffort effort_;
};

bool Opening::has_all(const FlatLid& lid) const {
  return std::all_of(lid.triangles.begin(), lid.triangles.end(),
                     [this](TriangleIndex t) { return surface_.contains(t); });
}

/// With the vertices joined to these; what has been left out stays out, so that
/// the number of triangles tells that of handles.
std::vector<VertexId> Opening::ringed(std::span<const VertexId> vertices) {
  std::vector<VertexId> result = solver_.neighborhoods().ring(vertices);
  std::erase_if(result, [this](VertexId v) { return !surface_.is_used(v); });
  return result;
}

/// Tries the rims by themselves, then with one ring of Delaunay edges about
/// them, then with two.
bool Opening::open(const Bore& bore) {
  constexpr int kRings = 2;
  std::vector<LocatedTriangle> lid_triangles;
  for (const FlatLid* lid : bore.lids) {
    if (!has_all(*lid)) return false;
    for (const TriangleIndex t : lid->triangles)
      lid_triangles.push_back(surface_.triangle(t));
  }
  for (const FlatLid* lid : bore.lids)
    for (const TriangleIndex t : lid->triangles) surface_.remove(t);
  Region region;
  region.vertices = bore.rims;
  for (int ring = 0; ring <= kRings; ++ring) {
    if (effort_.all.is_spent() || solver_.is_over()) break;
    if (ring > 0) region.vertices = ringed(region.vertices);
    if (attempt(region, lid_triangles)) return true;
  }
  for (const FlatLid* lid : bore.lids)
    for (const TriangleIndex t : lid->triangles) surface_.put_back(t);
  return false;
}

/// Takes the surface that solves the program without the lids, if it has one
/// handle more than the one with them.
bool Opening::attempt(const Region& region,
                      std::span<const LocatedTriangle> lid_triangles) {
  std::vector<LocatedTriangle> candidates = solver_.candidates(region);
  std::erase_if(candidates, [&](const LocatedTriangle& t) {
    return std::any_of(
        lid_triangles.begin(), lid_triangles.end(),
        [&](const LocatedTriangle& l) { return l.corners == t.corners; });
  });
  const Attempt solved = effort_.all.lend(
      effort_.conflicts_of_each, options_.propagations, [&](Effort& lent) {
        return solver_.attempt({region, std::move(candidates)}, lent, {});
      });
  if (solved.outcome != Outcome::Solved ||
      solved.chosen.size() !=
          solved.freed.size() + lid_triangles.size() + kTrianglesOfHandle ||
      solver_.n_pieces_added(solved, effort_.all) != 0)
    return false;
  surface_.replace(solved.freed, solved.chosen);
  return true;
}

}  // namespace

OpenedBores open_bores(const delaunay::Triangulation3& triangulation,
                       const ClosingOptions& options, WorkingSurface& surface) {
  std::vector<FlatLid> lids = find_flat_lids(triangulation, surface);
  std::erase_if(lids, is_narrow);
  if (std::none_of(lids.begin(), lids.end(),
                   [](const FlatLid& lid) { return lid.n_flat > 0; }))
    return {};
  turn_outward(triangulation, surface, lids);
  Opening opening(triangulation, options, surface);
  OpenedBores result;
  for (const Bore& bore : lidded_bores(lids))
    result.count += opening.open(bore) ? 1 : 0;
  result.conflicts = opening.solver().conflicts();
  result.propagations = opening.solver().propagations();
  return result;
}

}  // namespace umbrella
