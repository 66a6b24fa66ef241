#include "bench/cgal_delaunay2.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <vector>

namespace bench {

CgalDelaunay2 cgal_delaunay2(std::span<const Eigen::Vector2d> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> copy;
  copy.reserve(points.size());
  for (const Eigen::Vector2d& p : points) copy.emplace_back(p[0], p[1]);

  const auto start = std::chrono::steady_clock::now();
  const CGAL::Delaunay_triangulation_2<Kernel> t(copy.begin(), copy.end());
  const std::chrono::duration<double> time =
      std::chrono::steady_clock::now() - start;
  const bool is_planar = t.dimension() == 2;
  return {is_planar ? t.number_of_faces() : 0, time.count()};
}

}  // namespace bench
