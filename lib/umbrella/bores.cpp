// A bore is opened by a program about both of its rims that may not close them,
// and has to take the faces about them if these have been lost.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/bores_internal.h"
#include "umbrella/flat_lids_internal.h"
#include "umbrella/forced_changes_internal.h"
#include "umbrella/length_unit_internal.h"
#include "umbrella/lidded_bores_internal.h"

namespace umbrella {
namespace {

using Edge = std::pair<VertexId, VertexId>;  // ascending

/// Whether it lies in one of the rims.
bool closes_end(const LocatedTriangle& t, const LiddedBore& bore) {
  return std::any_of(bore.ends.begin(), bore.ends.end(),
                     [&](const BoreEnd& end) {
                       return std::includes(end.rim.begin(), end.rim.end(),
                                            t.corners.begin(), t.corners.end());
                     });
}

/// A triangle, and the cosine of the angle at which an edge is seen from its
/// far corner.
struct Seen {
  double cosine;
  LocatedTriangle triangle;
};

/// Of triangles in a plane that share an edge, on one side of it: that whose
/// far corner sees it widest, so that the others lie out of its circle. Flat
/// cells have more than one. None if two see it the same.
std::optional<LocatedTriangle> widest(std::vector<Seen>& seen) {
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return a.cosine < b.cosine; });
  const auto is_same = [](double a, double b) {
    return b - a <= FlatLid::kTolerance * (1 - a);
  };
  if (seen.empty() ||
      (seen.size() > 1 && is_same(seen[0].cosine, seen[1].cosine)))
    return {};
  return seen[0].triangle;
}

class Opening {
 public:
  Opening(const delaunay::Triangulation3& triangulation,
          const ClosingOptions& options, WorkingSurface& surface,
          LocalEffort& effort)
      : points_(triangulation.points()),
        unit_(length_unit(triangulation)),
        surface_(surface),
        changes_(triangulation, options, surface, effort) {}

  bool open(const LiddedBore& bore);
  const RegionSolver& solver() const { return changes_.solver(); }

 private:
  using Triangles = std::vector<LocatedTriangle>;
  struct Rings {
    int least, most;
  };

  Point3 point(VertexId v) const { return unit_ * points_[index(v)]; }
  bool has_all(const Triangles& triangles) const;
  std::set<Edge> edges_round(const BoreEnd& end) const;
  Triangles face_about(const BoreEnd& end);
  Triangles faces_about(const LiddedBore& bore);
  bool is_in_face(VertexId v, const BoreEnd& end) const;
  bool open(const LiddedBore& bore, const Triangles& faces, Rings rings);
  bool attempt(const Region& region, const LiddedBore& bore,
               const Triangles& faces);

  std::span<const Point3> points_;
  const double unit_;
  WorkingSurface& surface_;
  ForcedChanges changes_;
};

bool Opening::has_all(const Triangles& triangles) const {
  return std::all_of(triangles.begin(), triangles.end(),
                     [this](const LocatedTriangle& t) {
                       return changes_.find(t).has_value();
                     });
}

/// Those between vertices of a rim that follow each other round it.
std::set<Edge> Opening::edges_round(const BoreEnd& end) const {
  const Point3 x = point(end.rim[0]) - end.center;
  const Point3 y = end.normal.cross(x);
  std::vector<std::pair<double, VertexId>> round;
  for (const VertexId v : end.rim) {
    const Point3 arm = point(v) - end.center;
    round.emplace_back(std::atan2(arm.dot(y), arm.dot(x)), v);
  }
  std::sort(round.begin(), round.end());
  std::set<Edge> result;
  VertexId last = round.back().second;
  for (const auto& [angle, v] : round)
    result.insert(std::minmax(std::exchange(last, v), v));
  return result;
}

/// The flat triangles about the end, at most one for each edge of the rim.
Opening::Triangles Opening::face_about(const BoreEnd& end) {
  std::map<Edge, std::vector<Seen>> found;
  for (const Edge& edge : edges_round(end)) found[edge];
  Region region;
  region.vertices = changes_.ringed(end.rim);
  for (const LocatedTriangle& t : changes_.candidates(region))
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = t.corners[(i + 1) % 3], b = t.corners[(i + 2) % 3];
      const auto at = found.find(std::minmax(a, b));
      if (at == found.end() || !is_in_face(t.corners[i], end)) continue;
      const Point3 far = point(t.corners[i]);
      const double cosine =
          (point(a) - far).normalized().dot((point(b) - far).normalized());
      at->second.push_back({cosine, t});
    }
  Triangles result;
  for (auto& [edge, seen] : found)
    if (const auto triangle = widest(seen)) result.push_back(*triangle);
  return result;
}

/// In the plane of the end, off its circle.
bool Opening::is_in_face(VertexId v, const BoreEnd& end) const {
  constexpr double kSlack = FlatLid::kTolerance;
  const Point3 arm = point(v) - end.center;
  return arm.norm() > (1 + kSlack) * end.radius &&
         std::abs(arm.dot(end.normal)) <= kSlack * arm.norm();
}

/// Tries the region of the rims with so many rings of Delaunay edges about
/// them.
///
/// @param faces  to be taken, whatever else is
bool Opening::open(const LiddedBore& bore, const Triangles& faces,
                   Rings rings) {
  Region region;
  region.vertices = bore.rims;
  for (int ring = 0; ring <= rings.most; ++ring) {
    if (!changes_.may_go_on()) break;
    if (ring > 0) region.vertices = changes_.ringed(region.vertices);
    if (ring >= rings.least && attempt(region, bore, faces)) return true;
  }
  return false;
}

/// First with the faces about both ends, parts of which may have been lost: the
/// face at a rim is what says that it is the end of a bore and not of a shaft.
bool Opening::open(const LiddedBore& bore) {
  constexpr Rings kPlain = {0, 2}, kWithFaces = {1, 4};
  if (!has_all(bore.lids)) return false;
  if (bore.ends.size() == 2) {
    const Triangles faces = faces_about(bore);
    if (!faces.empty() && open(bore, faces, kWithFaces)) return true;
  }
  return !bore.is_half_open && open(bore, {}, kPlain);
}

/// None if a half of a rim is without, or any of it where the bore is half
/// open: a bore has its face all round.
Opening::Triangles Opening::faces_about(const LiddedBore& bore) {
  Triangles result;
  for (const BoreEnd& end : bore.ends) {
    const Triangles face = face_about(end);
    const std::size_t n_edges = end.rim.size();
    if (bore.is_half_open ? face.size() < n_edges : 2 * face.size() <= n_edges)
      return {};
    result.insert(result.end(), face.begin(), face.end());
  }
  std::sort(result.begin(), result.end(), by_corners);
  return result;
}

/// Takes the surface that solves the program without the lids, if it has one
/// handle more than the one with them.
bool Opening::attempt(const Region& region, const LiddedBore& bore,
                      const Triangles& faces) {
  const Attempt solved = changes_.solution(
      region, {.going = bore.lids, .coming = faces},
      [&](const LocatedTriangle& t) { return closes_end(t, bore); });
  if (solved.outcome != Outcome::Solved ||
      solved.chosen.size() != solved.freed.size() + kTrianglesOfHandle ||
      changes_.n_pieces_added(solved) != 0)
    return false;
  surface_.replace(solved.freed, solved.chosen);
  return true;
}

}  // namespace

OpenedBores open_bores(const delaunay::Triangulation3& triangulation,
                       const ClosingOptions& options, WorkingSurface& surface) {
  LocalEffort effort = local_effort(options, triangulation.points().size(), 1);
  const std::uint64_t most_propagations = effort.all.propagations;
  OpenedBores result;
  std::optional<Opening> opening;
  // What an open bore has brought back may show more of them.
  for (bool goes_on = true; goes_on && !effort.all.is_spent();) {
    const std::vector<LiddedBore> bores =
        find_lidded_bores(triangulation, surface, effort.all);
    goes_on = false;
    for (const LiddedBore& bore : bores) {
      if (!opening) opening.emplace(triangulation, options, surface, effort);
      if (!opening->open(bore)) continue;
      ++result.count;
      goes_on = true;
    }
    if (goes_on) effort.all.charge(0, surface.n_indices());
  }
  if (opening) result.spent = opening->solver().spent();
  result.spent.propagations = most_propagations - effort.all.propagations;
  return result;
}

}  // namespace umbrella
