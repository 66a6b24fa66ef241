/// @file
/// Distance from points to a mesh.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mesh_distance {

using Point = Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;  ///< rows of the points

/// To the nearest point of the closed triangle.
double point_to_triangle(const Point& p, const std::array<Point, 3>& abc);

/// The triangles of a mesh in a tree of boxes.
class Tree {
 public:
  /// @param points  must outlive the tree
  Tree(std::span<const Point> points, std::span<const Corners> triangles);

  /// Infinite if there are no triangles.
  double distance(const Point& p) const;

 private:
  /// Node i has the children 2 i + 1 and 2 i + 2; a leaf one triangle or none.
  void build(std::size_t node, std::size_t first, std::size_t last);
  void search(std::size_t node, std::size_t first, std::size_t last,
              const Point& p, double& nearest) const;
  std::array<Point, 3> corners(std::size_t triangle) const;

  std::span<const Point> points_;
  std::vector<Corners> triangles_;  // by leaf
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace mesh_distance
