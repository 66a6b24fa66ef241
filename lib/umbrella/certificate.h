/// @file
/// What a mesh is, found out from the mesh alone: this file shares no code
/// with the reconstruction it judges.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace umbrella {

/// A triangle as three rows of a vertex array; the order is its orientation.
using IndexedTriangle = std::array<std::uint32_t, 3>;
using IndexedEdge = std::array<std::uint32_t, 2>;

/// Closed and manifold, with every vertex used: that is a surface complex
/// [Adamy02, Def. 3.2].
struct SurfaceReport {
  std::size_t vertices = 0;  ///< rows that some triangle uses
  std::size_t triangles = 0;
  std::int64_t euler = 0;  ///< vertices - edges + triangles
  /// Sum over the components; none unless closed, manifold and orientable.
  std::optional<std::int64_t> genus;
  std::size_t components = 0;            ///< joined by shared edges
  std::size_t boundary_edges = 0;        ///< with one triangle
  std::size_t nonmanifold_edges = 0;     ///< with three or more
  std::size_t nonmanifold_vertices = 0;  ///< triangles not one fan or umbrella
  std::size_t degenerate_triangles = 0;  ///< with equal corners
  std::size_t duplicate_triangles = 0;   ///< on corners seen before
  bool closed = false;      ///< not empty, and each edge has two triangles
  bool manifold = false;    ///< no fault of the four kinds above
  bool orientable = false;  ///< could be oriented
  bool oriented = false;    ///< is: neighbours run along an edge opposite ways
  bool outward = false;     ///< oriented, closed, each component's volume > 0
  double area = 0;
  double volume = 0;  ///< signed; 0 unless closed and oriented
  std::vector<std::uint32_t> unused_vertices;  ///< rows, ascending
};

/// @throws std::invalid_argument  a triangle names a row that is not there
///   (says which)
SurfaceReport check_surface(std::span<const Eigen::Vector3d> vertices,
                            std::span<const IndexedTriangle> triangles);

struct CurveReport {
  std::size_t vertices = 0;  ///< rows that some edge uses
  std::size_t edges = 0;
  std::size_t components = 0;
  std::size_t ends = 0;              ///< vertices with one edge
  std::size_t branchings = 0;        ///< vertices with three or more
  std::size_t degenerate_edges = 0;  ///< with equal ends
  std::size_t duplicate_edges = 0;   ///< on ends seen before
  bool closed = false;    ///< not empty, and each vertex used has two edges
  bool manifold = false;  ///< no branching, no degenerate or duplicate edge
  std::vector<std::uint32_t> unused_vertices;  ///< rows, ascending
};

/// @throws std::invalid_argument  an edge names a row that is not there
CurveReport check_curve(std::size_t n_vertices,
                        std::span<const IndexedEdge> edges);

}  // namespace umbrella
