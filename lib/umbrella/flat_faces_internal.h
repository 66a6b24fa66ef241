/// @file
/// Flat faces that the points of a designed body outline.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Delaunay triangles of one plane within closed curves of Delaunay edges, with
/// every corner on these curves: as a designer's mesh has it, which holds no
/// vertex within a flat face. Points of a general sample do not lie like that.
struct FlatFace {
  std::vector<LocatedTriangle> triangles;  ///< by ascending corners
  std::vector<VertexId> vertices;          ///< ascending
  /// The curves: edges with one triangle, by ascending ends.
  std::vector<std::array<VertexId, 2>> outline;
  // Lengths are in the unit of Cell::center, in which no product here leaves
  // the range of doubles.
  Point3 origin;         ///< a point of the plane
  Point3 normal;         ///< unit, to either side
  double tolerance = 0;  ///< how far from the plane a corner may lie
  double area = 0;

  /// How many of the curves lie within another one. With n vertices, all on the
  /// curves, a disc has n - 2 triangles, and each hole adds two.
  std::size_t n_holes() const {
    return (triangles.size() + 2 - vertices.size()) / 2;
  }

  /// Fewer points lie on one plane by chance, or in a grid.
  static constexpr std::size_t kLeastVertices = 8;
  /// More are the scan of a plane.
  static constexpr std::size_t kMostVertices = 4096;
  /// What a corner may be off by, as part of the root of the area of the
  /// largest seed in it. Files hold CAD models with five digits or so.
  static constexpr double kTolerance = 1e-4;
};

/// The flat faces in the planes of some triangles.
///
/// All triangles that hang together with one of these in its plane are looked
/// at, and all of their corners are put on closed curves, the shortest ones
/// (curve.h); where these are not to be had at once the outline is not clear. A
/// face is what lies within an odd number of them. Planes with
/// more than FlatFace::kMostVertices corners are left out.
///
/// @param seeds  distinct, by ascending corners
/// @param is_over  asked before each plane; those left are not looked at then
/// @return the largest first; no two share a triangle
std::vector<FlatFace> find_flat_faces(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> seeds,
    const std::function<bool()>& is_over = [] { return false; });

}  // namespace umbrella
