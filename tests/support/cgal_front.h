/// @file
/// CGAL's advancing front, as a source of meshes that are not quite closed.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "umbrella/certificate.h"

namespace tests {

/// Triangles as rows of the points.
std::vector<umbrella::IndexedTriangle> advancing_front(
    std::span<const Eigen::Vector3d> points);

}  // namespace tests
