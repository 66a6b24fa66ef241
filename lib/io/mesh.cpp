#include "io/mesh.h"

#include <algorithm>
#include <limits>

#include "io/error.h"
#include "io/file.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"
#include "io/writers_internal.h"

namespace io {
namespace {

// Throws if no mesh of this dimension goes to such a file.
OutputFormat mesh_format(const std::string& path, int dimension) {
  if (path == "-") return OutputFormat::Ply;
  const auto format = output_format(path);
  const auto wrong = dimension == 2
                         ? std::array{OutputFormat::Off, OutputFormat::Stl}
                         : std::array{OutputFormat::Text, OutputFormat::Svg};
  if (!format || std::ranges::count(wrong, *format) > 0)
    throw WriteError(display_output(path) +
                     ": cannot write: the extension of a " +
                     (dimension == 2 ? "curve is .ply, .obj, .svg or .txt"
                                     : "mesh is .ply, .off, .obj or .stl"));
  return *format;
}

bool fits_float(const Mesh& mesh) {
  static constexpr double kMax = std::numeric_limits<float>::max();
  return std::ranges::all_of(mesh.vertices, [](const Eigen::Vector3d& p) {
    return (p.array().abs() <= kMax).all();
  });
}

}  // namespace

Mesh read_mesh(const std::string& path) {
  Mesh mesh = read(path, true);
  if (mesh.triangles.empty() && mesh.edges.empty())
    throw ParseError(display_name(path) +
                     ": neither triangles nor edges in the file");
  // Curves are written with z = 0, for the sake of viewers.
  const bool flat = std::ranges::all_of(
      mesh.vertices, [](const Eigen::Vector3d& p) { return p.z() == 0; });
  if (mesh.triangles.empty() && flat) mesh.dimension = 2;
  return mesh;
}

void require_mesh_format(const std::string& path, int dimension) {
  mesh_format(path, dimension);
}

void write_mesh(const std::string& path, const Mesh& mesh,
                std::span<const double> lambda) {
  switch (mesh_format(path, mesh.dimension)) {
    case OutputFormat::Ply:
      return write_file(path, ply_bytes(mesh, lambda));
    case OutputFormat::Off:
      return write_file(path, off_text(mesh));
    case OutputFormat::Obj:
      return write_file(path, obj_text(mesh));
    case OutputFormat::Svg:
      return write_file(path, svg_text(mesh));
    case OutputFormat::Text:
      return write_file(path, row_text(mesh));
    case OutputFormat::Stl:
      break;
  }
  if (!fits_float(mesh))
    throw WriteError(display_output(path) +
                     ": cannot write: a coordinate exceeds the floats of STL");
  write_file(path, stl_bytes(mesh));
}

}  // namespace io
