#include "bench/cgal_delaunay2.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

namespace bench {

CgalDelaunay2 cgal_delaunay2(std::span<const Eigen::Vector2d> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> copy;
  copy.reserve(points.size());
  for (const Eigen::Vector2d& p : points) copy.emplace_back(p[0], p[1]);

  std::size_t n_finite_cells = 0;
  const Seconds seconds = seconds_of(
      [&copy] {
        return CGAL::Delaunay_triangulation_2<Kernel>(copy.begin(), copy.end());
      },
      [&n_finite_cells](const auto& t) {
        n_finite_cells = t.dimension() == 2 ? t.number_of_faces() : 0;
      });
  return {n_finite_cells, seconds};
}

}  // namespace bench
