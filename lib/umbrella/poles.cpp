#include "umbrella/poles.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "umbrella/circumradius_internal.h"
#include "umbrella/triangle.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::Triangulation3;

/// Sorts; whether that took an odd number of swaps.
bool sort_is_odd(std::array<VertexId, 4>& v) {
  bool is_odd = false;
  for (std::size_t n = v.size(); n > 1; --n)
    for (std::size_t i = 1; i < n; ++i)
      if (v[i] < v[i - 1]) {
        std::swap(v[i], v[i - 1]);
        is_odd = !is_odd;
      }
  return is_odd;
}

/// From the corner with the least id, so that it does not depend on how the
/// cell is stored.
Point3 circumcenter(const Triangulation3& triangulation,
                    const Circumspheres& spheres, CellId c) {
  std::array<VertexId, 4> v = triangulation.cell(c).vertex;
  const bool is_turned = sort_is_odd(v);
  const Point3& origin = triangulation.point(v[0]);
  const auto to = [&](VertexId id) {
    return scaled_difference(triangulation.point(id), origin, spheres.scale());
  };
  const Sphere<double> s = sphere(to(v[1]), to(v[2]), to(v[3]));
  // The cell is positive, so the sign of the volume is known.
  const Point3 direction =
      Point3(s.center[0], s.center[1], s.center[2]).stableNormalized() *
      (is_turned ? -1 : 1);
  const double R = std::sqrt(spheres.squared_radius(c));
  return origin + R * direction / spheres.scale();
}

Point3 outward_normal(const Triangulation3& triangulation, const Cell& cell) {
  const Point3& a = triangulation.point(cell.vertex[0]);
  return (triangulation.point(cell.vertex[1]) - a)
      .stableNormalized()
      .cross((triangulation.point(cell.vertex[2]) - a).stableNormalized())
      .stableNormalized();
}

}  // namespace

std::vector<Point3> circumcenters(const Triangulation3& triangulation,
                                  const Circumspheres& spheres) {
  std::vector<Point3> centers(triangulation.n_finite_cells());
  for (std::uint32_t c = 0; c < centers.size(); ++c)
    centers[c] = circumcenter(triangulation, spheres, CellId{c});
  return centers;
}

std::vector<Poles> poles(const Triangulation3& triangulation,
                         const Circumspheres& spheres,
                         const std::vector<Point3>& centers) {
  std::vector<Poles> result(triangulation.points().size());
  const auto cells = triangulation.cells();
  std::vector<bool> on_hull(result.size());
  for (std::size_t c = centers.size(); c < cells.size(); ++c)
    for (unsigned i = 0; i < 3; ++i) {
      on_hull[index(cells[c].vertex[i])] = true;
      result[index(cells[c].vertex[i])].normal +=
          outward_normal(triangulation, cells[c]);
    }

  // A centre is as far from each corner of its cell as the radius says.
  const auto is_farther = [&](CellId c, bool has_other, CellId other) {
    return !has_other ||
           spheres.squared_radius(c) > spheres.squared_radius(other);
  };
  const auto each_corner = [&](auto use) {
    for (std::uint32_t c = 0; c < centers.size(); ++c)
      for (const VertexId v : cells[c].vertex)
        use(result[index(v)], CellId{c}, v);
  };
  each_corner([&](Poles& p, CellId c, VertexId v) {
    if (on_hull[index(v)] || !is_farther(c, p.has_outer, p.outer)) return;
    p.outer = c;
    p.has_outer = true;
    p.normal = centers[index(c)] - triangulation.point(v);
  });
  for (Poles& p : result) p.normal = p.normal.stableNormalized();
  each_corner([&](Poles& p, CellId c, VertexId v) {
    const Point3 to_center = centers[index(c)] - triangulation.point(v);
    if (!(p.normal.dot(to_center) < 0) || !is_farther(c, p.has_inner, p.inner))
      return;
    p.inner = c;
    p.has_inner = true;
  });
  return result;
}

}  // namespace umbrella
