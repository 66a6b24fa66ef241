#include "umbrella/voronoi_filters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "umbrella/criterion.h"
#include "umbrella/poles.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::Facet;
using delaunay::Triangulation3;

Triangle corners_of(const Triangulation3& triangulation, Facet facet) {
  const auto& v = triangulation.cell(facet.cell()).vertex;
  const auto& [i, j, k] = delaunay::kFacetCorners[facet.index()];
  Triangle corners = {v[i], v[j], v[k]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::vector<LocatedTriangle> located_triangles(
    const Triangulation3& triangulation) {
  std::vector<LocatedTriangle> result;
  for (const Facet facet : facets(triangulation))
    result.push_back({corners_of(triangulation, facet), facet});
  std::sort(result.begin(), result.end(), by_corners);
  return result;
}

/// The samples, in the order of their ids, and then their poles.
std::vector<Point3> with_poles(const Triangulation3& triangulation,
                               const Circumspheres& spheres) {
  const std::vector<Point3> centers = circumcenters(triangulation, spheres);
  std::vector<bool> is_pole(centers.size());
  for (const Poles& p : poles(triangulation, spheres, centers)) {
    if (p.has_outer) is_pole[index(p.outer)] = true;
    if (p.has_inner) is_pole[index(p.inner)] = true;
  }
  const auto samples = triangulation.points();
  std::vector<Point3> points(samples.begin(), samples.end());
  for (std::size_t c = 0; c < centers.size(); ++c)
    if (is_pole[c] && centers[c].allFinite()) points.push_back(centers[c]);
  return points;
}

/// Sees the ends of dual Voronoi edges from samples, by the cosine of the angle
/// to the sample's normal. Beyond the hull an edge goes on for ever along the
/// outward normal of the triangle.
class Cocones {
 public:
  Cocones(const Triangulation3& triangulation, const Circumspheres& spheres)
      : triangulation_(triangulation),
        centers_(circumcenters(triangulation, spheres)),
        poles_(poles(triangulation, spheres, centers_)) {}

  /// The least |cosine| on the edge is at an end, unless the sign changes.
  bool meets(Facet facet, VertexId v, double largest_cosine) const {
    const Facet opposite =
        triangulation_.cell(facet.cell()).neighbor[facet.index()];
    const double here = cosine(facet.cell(), v);
    const double there = cosine(opposite.cell(), v);
    return std::min(here, there) <= largest_cosine &&
           std::max(here, there) >= -largest_cosine;
  }

 private:
  double cosine(CellId c, VertexId v) const {
    return direction(c, v).stableNormalized().dot(poles_[index(v)].normal);
  }
  Point3 direction(CellId c, VertexId v) const {
    const Cell& cell = triangulation_.cell(c);
    if (!cell.is_infinite())
      return centers_[index(c)] - triangulation_.point(v);
    const Point3& a = triangulation_.point(cell.vertex[0]);
    return (triangulation_.point(cell.vertex[1]) - a)
        .stableNormalized()
        .cross((triangulation_.point(cell.vertex[2]) - a).stableNormalized());
  }

  const Triangulation3& triangulation_;
  std::vector<Point3> centers_;
  std::vector<Poles> poles_;
};

}  // namespace

std::vector<LocatedTriangle> crust(const Triangulation3& triangulation,
                                   const Circumspheres& spheres) {
  const std::size_t n = triangulation.points().size();
  const Triangulation3 finer(with_poles(triangulation, spheres));
  // A pole in the very place of a sample is that sample.
  constexpr std::uint32_t kPole = 0xffff'ffffU;
  std::vector<std::uint32_t> sample(finer.points().size(), kPole);
  for (std::uint32_t v = 0; v < n; ++v)
    sample[index(finer.vertex_of_row()[v])] = v;

  std::vector<Triangle> kept;
  for (const Facet facet : facets(finer)) {
    Triangle t = corners_of(finer, facet);
    for (VertexId& v : t) v = VertexId{sample[index(v)]};
    std::sort(t.begin(), t.end());
    if (t[2] != VertexId{kPole}) kept.push_back(t);
  }
  std::sort(kept.begin(), kept.end());

  std::vector<LocatedTriangle> result = located_triangles(triangulation);
  std::erase_if(result, [&](const LocatedTriangle& t) {
    return !std::binary_search(kept.begin(), kept.end(), t.corners);
  });
  assert(result.size() == kept.size() && "ties are decided alike");
  return result;
}

std::vector<LocatedTriangle> cocone(const Triangulation3& triangulation,
                                    const Circumspheres& spheres,
                                    double angle) {
  const Cocones cocones(triangulation, spheres);
  const double largest_cosine = std::sin(angle);
  std::vector<LocatedTriangle> result = located_triangles(triangulation);
  std::erase_if(result, [&](const LocatedTriangle& t) {
    return !std::all_of(t.corners.begin(), t.corners.end(), [&](VertexId v) {
      return cocones.meets(t.facet, v, largest_cosine);
    });
  });
  return result;
}

}  // namespace umbrella
