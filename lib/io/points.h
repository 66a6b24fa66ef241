/// @file
/// Point files in and out. docs/io.md says what each format may hold.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace io {

struct PointSet {
  int dimension = 3;                    ///< 2 or 3
  std::vector<Eigen::Vector3d> points;  ///< z = 0 in the plane
};

/// Points of a PLY, OFF, OBJ, STL or text file, in the order of the file; the
/// content decides the format, the extension only where the content does not.
/// Each is finite.
///
/// @param path  `-` is standard input
/// @throws ParseError  missing, empty, malformed or compressed file; no point
PointSet read_points(const std::string& path);

/// Text lines `x y [z]` that read back to the same doubles, or what the
/// extension says: .ply (binary) or .obj.
///
/// @param path  `-` is standard output, as text
/// @throws WriteError  for .off, .stl and .svg too: they hold meshes
void write_points(const std::string& path, const PointSet& points);

}  // namespace io
