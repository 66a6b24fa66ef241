#include "bench/cgal_delaunay3.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <vector>

namespace bench {

CgalDelaunay3 cgal_delaunay3(std::span<const Eigen::Vector3d> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> copy;
  copy.reserve(points.size());
  for (const Eigen::Vector3d& p : points) copy.emplace_back(p[0], p[1], p[2]);

  const auto start = std::chrono::steady_clock::now();
  const CGAL::Delaunay_triangulation_3<Kernel> t(copy.begin(), copy.end());
  const std::chrono::duration<double> time =
      std::chrono::steady_clock::now() - start;
  return {t.number_of_finite_cells(), time.count()};
}

}  // namespace bench
