// From a triangle its plane is followed over edges, around each of which the
// cells are walked through. Where corners are off the plane by rounding, a
// patch is a thin layer of cells; the facets under the thick cells on its one
// side are a tiling of it. Then the corners are a sample of curves in a plane,
// and the tiles fall into those within an odd number of them and the others.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "umbrella/curve.h"
#include "umbrella/flat_faces_internal.h"
#include "umbrella/length_unit_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

using delaunay::Facet;
using Side = std::array<VertexId, 2>;  // of a triangle, ascending

std::array<Side, 3> sides(const Triangle& t) {
  return {{{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}}};
}

/// Triangles that hang together in one plane.
struct Patch {
  std::vector<LocatedTriangle> triangles;
  FlatFace plane;  // but for its triangles
};

/// Walks over tiles from the outside in, and counts the curves passed.
class Parity {
 public:
  Parity(std::span<const LocatedTriangle> tiles, std::span<const Side> curves)
      : tiles_(tiles), curves_(curves), parity_(tiles.size(), kUnknown) {
    for (std::uint32_t t = 0; t < tiles.size(); ++t)
      for (const Side& side : sides(tiles[t].corners))
        tiles_at_[side].push_back(t);
    is_sound_ =
        std::all_of(curves.begin(), curves.end(),
                    [&](const Side& side) { return tiles_at_.contains(side); });
    std::vector<std::uint32_t> reached;
    for (const auto& [side, at] : tiles_at_) {
      is_sound_ = is_sound_ && at.size() <= 2;
      if (at.size() == 1) set(at[0], is_curve(side), reached);
    }
    while (!reached.empty()) {
      const std::uint32_t t = reached.back();
      reached.pop_back();
      for (const Side& side : sides(tiles[t].corners))
        for (const std::uint32_t next : tiles_at_[side])
          if (next != t) set(next, parity_[t] ^ is_curve(side), reached);
    }
  }

  /// Whether the tiles cover each place once, and all curves run along them.
  bool is_sound() const { return is_sound_; }
  const LocatedTriangle& tile(std::uint32_t t) const { return tiles_[t]; }
  bool is_within(std::uint32_t tile) const { return parity_[tile] == 1; }
  bool is_curve(const Side& side) const {
    return std::binary_search(curves_.begin(), curves_.end(), side);
  }
  std::span<const std::uint32_t> tiles_at(const Side& side) const {
    return tiles_at_.at(side);
  }

 private:
  static constexpr std::uint8_t kUnknown = 2;

  void set(std::uint32_t t, unsigned parity,
           std::vector<std::uint32_t>& reached) {
    if (parity_[t] == kUnknown) {
      parity_[t] = static_cast<std::uint8_t>(parity);
      reached.push_back(t);
    }
    is_sound_ = is_sound_ && parity_[t] == parity;
  }

  std::span<const LocatedTriangle> tiles_;
  std::span<const Side> curves_;
  std::vector<std::uint8_t> parity_;
  std::map<Side, std::vector<std::uint32_t>> tiles_at_;
  bool is_sound_ = true;
};

class FaceSearch {
 public:
  explicit FaceSearch(const delaunay::Triangulation3& triangulation)
      : triangulation_(triangulation),
        unit_(length_unit(triangulation)),
        is_met_(4 * triangulation.cells().size()) {}

  std::vector<FlatFace> run(std::span<const LocatedTriangle> seeds,
                            const std::function<bool()>& is_over);

 private:
  Point3 point(VertexId v) const { return unit_ * triangulation_.point(v); }
  double area(const Triangle& t) const;
  LocatedTriangle located(Facet facet) const;
  static std::size_t place(const LocatedTriangle& t) {
    return 4 * index(t.facet.cell()) + t.facet.index();
  }
  double height(const FlatFace& plane, VertexId v) const {
    return (point(v) - plane.origin).dot(plane.normal);
  }
  bool is_in(const FlatFace& plane, const Triangle& t) const;
  Patch patch_of(const LocatedTriangle& seed);
  void add_around(const LocatedTriangle& t, const Side& side, Patch& patch);
  std::vector<LocatedTriangle> tiling(const Patch& patch) const;
  std::vector<Side> curves(const FlatFace& plane,
                           std::span<const VertexId> vertices) const;
  void add_faces(const Patch& patch, std::vector<FlatFace>& faces) const;
  void collect(const Parity& parity, std::uint32_t tile,
               std::vector<bool>& is_done, FlatFace& face) const;

  const delaunay::Triangulation3& triangulation_;
  const double unit_;
  std::vector<bool> is_met_;  // in some patch; by facet of a located triangle
};

double FaceSearch::area(const Triangle& t) const {
  const Point3 a = point(t[0]);
  return (point(t[1]) - a).cross(point(t[2]) - a).norm() / 2;
}

LocatedTriangle FaceSearch::located(Facet facet) const {
  const Facet other = triangulation_.cell(facet.cell()).neighbor[facet.index()];
  return {corners(triangulation_, facet),
          other.cell() < facet.cell() ? other : facet};
}

bool FaceSearch::is_in(const FlatFace& plane, const Triangle& t) const {
  return std::all_of(t.begin(), t.end(), [&](VertexId v) {
    return std::abs(height(plane, v)) <= plane.tolerance;
  });
}

Patch FaceSearch::patch_of(const LocatedTriangle& seed) {
  const auto& [a, b, c] = seed.corners;
  Patch patch;
  patch.plane.origin = point(a);
  patch.plane.normal =
      (point(b) - point(a)).cross(point(c) - point(a)).normalized();
  patch.plane.tolerance = FlatFace::kTolerance * std::sqrt(area(seed.corners));
  patch.triangles = {seed};
  is_met_[place(seed)] = true;
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    const LocatedTriangle t = patch.triangles[i];
    for (const Side& side : sides(t.corners)) add_around(t, side, patch);
  }
  return patch;
}

/// Those at a side of t that lie in the plane.
void FaceSearch::add_around(const LocatedTriangle& t, const Side& side,
                            Patch& patch) {
  Facet facet = t.facet;
  do {
    const delaunay::Cell& cell = triangulation_.cell(facet.cell());
    unsigned i = 0;  // of the corner of this facet that is not on the side
    while (i == facet.index() || cell.vertex[i] == side[0] ||
           cell.vertex[i] == side[1])
      ++i;
    facet = cell.neighbor[i];
    const LocatedTriangle next = located(facet);
    if (next.corners[2] == delaunay::kInfinite) continue;
    if (!is_in(patch.plane, next.corners)) continue;
    if (is_met_[place(next)]) continue;
    is_met_[place(next)] = true;
    patch.triangles.push_back(next);
  } while (corners(triangulation_, facet) != t.corners);
}

/// The triangles under cells with an apex over the plane, on the side where
/// these cover more.
std::vector<LocatedTriangle> FaceSearch::tiling(const Patch& patch) const {
  std::array<std::vector<LocatedTriangle>, 2> result;
  std::array<double, 2> covered = {0, 0};
  for (const LocatedTriangle& t : patch.triangles)
    for (const Facet side :
         {t.facet,
          triangulation_.cell(t.facet.cell()).neighbor[t.facet.index()]}) {
      const delaunay::Cell& cell = triangulation_.cell(side.cell());
      if (cell.is_infinite()) continue;
      const double h = height(patch.plane, cell.vertex[side.index()]);
      if (std::abs(h) <= patch.plane.tolerance) continue;
      result[h > 0 ? 0 : 1].push_back(t);
      covered[h > 0 ? 0 : 1] += area(t.corners);
    }
  auto& best = result[covered[1] > covered[0] ? 1 : 0];
  std::sort(best.begin(), best.end(), by_corners);
  return std::move(best);
}

/// Closed curves through all vertices; none if there are no such curves.
std::vector<Side> FaceSearch::curves(const FlatFace& plane,
                                     std::span<const VertexId> vertices) const {
  Point3 u = Point3::Zero();
  for (const VertexId v : vertices)
    if ((point(v) - plane.origin).norm() > u.norm())
      u = point(v) - plane.origin;
  u.normalize();
  const Point3 w = plane.normal.cross(u);
  std::vector<delaunay::Point2> flat;
  for (const VertexId v : vertices) {
    const Point3 p = point(v) - plane.origin;
    flat.emplace_back(p.dot(u), p.dot(w));
  }
  const CurveReconstruction curve = reconstruct_curve(
      flat, {.mode = CurveMode::Closed, .closing = {.max_growth = 0}});
  std::vector<Side> result;
  if (!curve.open_rows.empty() || curve.edges.size() != vertices.size())
    return result;
  for (const auto& [i, k] : curve.edges)
    result.push_back({std::min(vertices[i], vertices[k]),
                      std::max(vertices[i], vertices[k])});
  std::sort(result.begin(), result.end());
  return result;
}

void FaceSearch::add_faces(const Patch& patch,
                           std::vector<FlatFace>& faces) const {
  const std::vector<LocatedTriangle> tiles = tiling(patch);
  std::vector<VertexId> vertices;
  for (const LocatedTriangle& t : tiles)
    vertices.insert(vertices.end(), t.corners.begin(), t.corners.end());
  sort_unique(vertices);
  if (vertices.size() < FlatFace::kLeastVertices ||
      vertices.size() > FlatFace::kMostVertices)
    return;
  const std::vector<Side> curve = curves(patch.plane, vertices);
  if (curve.empty()) return;
  const Parity parity(tiles, curve);
  if (!parity.is_sound()) return;
  std::vector<bool> is_done(tiles.size());
  for (std::uint32_t t = 0; t < tiles.size(); ++t)
    if (!is_done[t] && parity.is_within(t)) {
      FlatFace face = patch.plane;
      collect(parity, t, is_done, face);
      if (face.vertices.size() >= FlatFace::kLeastVertices)
        faces.push_back(std::move(face));
    }
}

/// The face that a tile lies in.
void FaceSearch::collect(const Parity& parity, std::uint32_t tile,
                         std::vector<bool>& is_done, FlatFace& face) const {
  std::vector<std::uint32_t> reached = {tile};
  is_done[tile] = true;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const LocatedTriangle& t = parity.tile(reached[i]);
    face.triangles.push_back(t);
    face.area += area(t.corners);
    face.vertices.insert(face.vertices.end(), t.corners.begin(),
                         t.corners.end());
    for (const Side& side : sides(t.corners)) {
      if (parity.is_curve(side)) {
        face.outline.push_back(side);
        continue;
      }
      for (const std::uint32_t next : parity.tiles_at(side))
        if (!is_done[next]) {
          is_done[next] = true;
          reached.push_back(next);
        }
    }
  }
  sort_unique(face.vertices);
  std::sort(face.outline.begin(), face.outline.end());
  std::sort(face.triangles.begin(), face.triangles.end(), by_corners);
}

std::vector<FlatFace> FaceSearch::run(std::span<const LocatedTriangle> seeds,
                                      const std::function<bool()>& is_over) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < seeds.size(); ++i)
    order.emplace_back(-area(seeds[i].corners), i);
  std::sort(order.begin(), order.end());
  std::vector<FlatFace> result;
  for (const auto& [negative_area, i] : order) {
    if (is_over()) break;
    if (negative_area < 0 && !is_met_[place(seeds[i])])
      add_faces(patch_of(seeds[i]), result);
  }
  std::stable_sort(
      result.begin(), result.end(),
      [](const FlatFace& a, const FlatFace& b) { return a.area > b.area; });
  return result;
}

}  // namespace

std::vector<FlatFace> find_flat_faces(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> seeds,
    const std::function<bool()>& is_over) {
  return FaceSearch(triangulation).run(seeds, is_over);
}

}  // namespace umbrella
