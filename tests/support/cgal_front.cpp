#include "tests/support/cgal_front.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <iterator>

namespace tests {

std::vector<umbrella::IndexedTriangle> advancing_front(
    std::span<const Eigen::Vector3d> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> copies;
  for (const Eigen::Vector3d& p : points)
    copies.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(copies.begin(), copies.end(),
                                               std::back_inserter(faces));
  std::vector<umbrella::IndexedTriangle> result;
  for (const auto& [a, b, c] : faces)
    result.push_back({static_cast<std::uint32_t>(a),
                      static_cast<std::uint32_t>(b),
                      static_cast<std::uint32_t>(c)});
  return result;
}

}  // namespace tests
