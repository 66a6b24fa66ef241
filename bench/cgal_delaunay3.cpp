#include "bench/cgal_delaunay3.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

namespace bench {

CgalDelaunay3 cgal_delaunay3(std::span<const Eigen::Vector3d> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> copy;
  copy.reserve(points.size());
  for (const Eigen::Vector3d& p : points) copy.emplace_back(p[0], p[1], p[2]);

  std::size_t n_finite_cells = 0;
  const Seconds seconds = seconds_of(
      [&copy] {
        return CGAL::Delaunay_triangulation_3<Kernel>(copy.begin(), copy.end());
      },
      [&n_finite_cells](const auto& t) {
        n_finite_cells = t.number_of_finite_cells();
      });
  return {n_finite_cells, seconds};
}

}  // namespace bench
