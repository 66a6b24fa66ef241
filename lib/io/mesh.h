/// @file
/// Mesh files in and out: triangles in space, polygons in the plane.
/// docs/io.md says what each format may hold.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace io {

struct Mesh {
  int dimension = 3;                      ///< 2 or 3
  std::vector<Eigen::Vector3d> vertices;  ///< z = 0 in the plane
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

/// Mesh of a PLY, OFF, OBJ or STL file, or of a .txt file of edges. Faces with
/// more than three corners are cut into a fan about their first corner; corners
/// of STL triangles and ends of edges as text with equal coordinates become one
/// vertex. Indices are in range; nothing else is promised of the triangles.
///
/// @param path  `-` is standard input
/// @throws ParseError  missing, empty, malformed or compressed file; neither
///   triangle nor edge
Mesh read_mesh(const std::string& path);

/// Format by extension: .ply (binary), .off, .obj, .stl (binary, coordinates
/// rounded to float); in the plane .ply, .obj, .svg (a picture), .txt (a line
/// `x y x y` an edge).
///
/// @param path    `-` is standard output, as PLY
/// @param lambda  one a triangle (an edge in the plane), or none; property
///   `lambda` of a PLY file, ignored by other formats
/// @throws WriteError  no such format, or the file cannot be written
void write_mesh(const std::string& path, const Mesh& mesh,
                std::span<const double> lambda = {});

/// Throws the WriteError that write_mesh would, for a path whose extension it
/// does not know: call before a long computation.
void require_mesh_format(const std::string& path, int dimension);

}  // namespace io
