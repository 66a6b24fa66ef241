// Large flat triangles of a thin body lose against the walls of a void. A face
// that is plain from its outline is put in by force, and the rest solved again.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "umbrella/flat_faces_internal.h"
#include "umbrella/forced_changes_internal.h"
#include "umbrella/length_unit_internal.h"
#include "umbrella/lost_faces_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

class Regaining {
 public:
  Regaining(const delaunay::Triangulation3& triangulation,
            const ClosingOptions& options, WorkingSurface& surface)
      : triangulation_(triangulation),
        unit_(length_unit(triangulation)),
        surface_(surface),
        effort_(local_effort(options, triangulation.points().size(), 1)),
        changes_(triangulation, options, surface, effort_) {}

  bool regain(const FlatFace& face);
  bool is_over() const { return !changes_.may_go_on(); }
  const RegionSolver& solver() const { return changes_.solver(); }

 private:
  Point3 point(VertexId v) const { return unit_ * triangulation_.point(v); }
  bool is_lost(const FlatFace& face) const;
  bool is_section(const FlatFace& face) const;
  Point3 area_vector(const Triangle& t) const {
    const Point3 a = point(t[0]);
    return (point(t[1]) - a).cross(point(t[2]) - a) / 2;
  }
  bool attempt(const Region& region, const FlatFace& face);

  const delaunay::Triangulation3& triangulation_;
  const double unit_;
  WorkingSurface& surface_;
  LocalEffort effort_;  // for all faces
  ForcedChanges changes_;
};

/// Whether less than half of it is on the surface.
bool Regaining::is_lost(const FlatFace& face) const {
  const auto is_corner = [&](VertexId v) {
    return std::binary_search(face.vertices.begin(), face.vertices.end(), v);
  };
  double covered = 0;
  for (const VertexId v : face.vertices)
    surface_.for_each_at(v, [&](TriangleIndex t) {
      const auto& [a, b, c] = surface_.corners(t);
      if (a != v || !is_corner(b) || !is_corner(c)) return;
      covered += area_vector(surface_.corners(t)).norm();
    });
  return covered < face.area / 2;
}

/// Whether the surface goes from one side of the plane to the other at more
/// than half of the outline: then it is that of a body which goes on.
bool Regaining::is_section(const FlatFace& face) const {
  std::size_t n_crossed = 0;
  for (const auto& [a, b] : face.outline) {
    bool is_above = false, is_below = false;
    surface_.for_each_at(a, [&, b = b](TriangleIndex t) {
      const Triangle& corners = surface_.corners(t);
      if (std::find(corners.begin(), corners.end(), b) == corners.end()) return;
      for (const VertexId v : corners) {
        const double height = (point(v) - face.origin).dot(face.normal);
        is_above |= height > face.tolerance;
        is_below |= height < -face.tolerance;
      }
    });
    n_crossed += is_above && is_below ? 1 : 0;
  }
  return 2 * n_crossed > face.outline.size();
}

/// Tries the vertices of the face by themselves, then with one ring of Delaunay
/// edges about them, then with two.
bool Regaining::regain(const FlatFace& face) {
  constexpr int kRings = 2;
  const bool is_used =
      std::all_of(face.vertices.begin(), face.vertices.end(),
                  [this](VertexId v) { return surface_.is_used(v); });
  if (!is_used || !is_lost(face) || is_section(face)) return false;
  Region region;
  region.vertices = face.vertices;
  for (int ring = 0; ring <= kRings; ++ring) {
    if (!changes_.may_go_on()) break;
    if (ring > 0) region.vertices = changes_.ringed(region.vertices);
    if (attempt(region, face)) return true;
  }
  return false;
}

/// Takes the surface that solves the program with the whole face, if that has
/// no more pieces and no more handles.
bool Regaining::attempt(const Region& region, const FlatFace& face) {
  const Attempt solved =
      changes_.solution(region, {.going = {}, .coming = face.triangles});
  if (solved.outcome != Outcome::Solved ||
      solved.chosen.size() > solved.freed.size() ||
      changes_.n_pieces_added(solved) > 0)
    return false;
  surface_.replace(solved.freed, solved.chosen);
  return true;
}

/// Whether a triangle of the surface lies in the plane of another one at it.
bool continues(const delaunay::Triangulation3& triangulation,
               const WorkingSurface& surface, TriangleIndex t) {
  const Triangle& corners = surface.corners(t);
  const Point3& a = triangulation.point(corners[0]);
  const Point3 u = triangulation.point(corners[1]) - a;
  const Point3 v = triangulation.point(corners[2]) - a;
  const Point3 n = u.stableNormalized().cross(v.stableNormalized());
  const double root_of_area = std::sqrt(u.stableNorm()) *
                              std::sqrt(v.stableNorm()) *
                              std::sqrt(n.norm() / 2);
  const Point3 normal = n.normalized();
  bool result = false;
  for (const VertexId x : corners)
    surface.for_each_at(x, [&](TriangleIndex other) {
      VertexId apex = x;
      unsigned n_shared = 0;
      for (const VertexId w : surface.corners(other))
        if (std::find(corners.begin(), corners.end(), w) != corners.end())
          ++n_shared;
        else
          apex = w;
      if (n_shared != 2) return;
      const double height = (triangulation.point(apex) - a).dot(normal);
      result |= std::abs(height) <= FlatFace::kTolerance * root_of_area;
    });
  return result;
}

/// A look at some triangles of the surface, evenly spread: of a designed body
/// a quarter and more continue others. Of the real sets 46 % to all do where
/// they are designed, up to 17 % where they are scans (flat_faces.md).
bool may_have_flat_faces(const delaunay::Triangulation3& triangulation,
                         const WorkingSurface& surface) {
  constexpr std::size_t kLooks = 256;
  const std::size_t step =
      std::max<std::size_t>(1, surface.n_indices() / kLooks);
  std::size_t n = 0, n_flat = 0;
  for (std::size_t i = 0; i < surface.n_indices(); i += step) {
    const auto t = static_cast<TriangleIndex>(i);
    if (!surface.contains(t)) continue;
    ++n;
    n_flat += continues(triangulation, surface, t) ? 1 : 0;
  }
  return 4 * n_flat >= n;
}

/// The triangles of all cells at what the closing has added.
std::vector<LocatedTriangle> seeds(
    const delaunay::Triangulation3& triangulation,
    const WorkingSurface& surface) {
  std::vector<LocatedTriangle> result;
  surface.for_each_added([&](TriangleIndex t) {
    const delaunay::Facet facet = surface.triangle(t).facet;
    const delaunay::Facet other =
        triangulation.cell(facet.cell()).neighbor[facet.index()];
    for (const delaunay::CellId id : {facet.cell(), other.cell()}) {
      const delaunay::Cell& cell = triangulation.cell(id);
      if (cell.is_infinite()) continue;
      for (unsigned i = 0; i < 4; ++i) {
        const delaunay::Facet here(id, i), there = cell.neighbor[i];
        result.push_back(
            {corners(triangulation, here), there.cell() < id ? there : here});
      }
    }
  });
  std::sort(result.begin(), result.end(), by_corners);
  const auto last = std::unique(
      result.begin(), result.end(),
      [](const auto& a, const auto& b) { return a.corners == b.corners; });
  result.erase(last, result.end());
  return result;
}

}  // namespace

RegainedFaces regain_faces(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           WorkingSurface& surface) {
  if (!may_have_flat_faces(triangulation, surface)) return {};
  Regaining regaining(triangulation, options, surface);
  std::vector<FlatFace> faces =
      find_flat_faces(triangulation, seeds(triangulation, surface),
                      [&] { return regaining.is_over(); });
  std::erase_if(faces,
                [](const FlatFace& face) { return face.n_holes() == 0; });
  RegainedFaces result;
  for (const FlatFace& face : faces)
    result.count += regaining.regain(face) ? 1 : 0;
  result.spent = regaining.solver().spent();
  return result;
}

}  // namespace umbrella
