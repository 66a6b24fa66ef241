#include "io/points.h"

#include <utility>

#include "io/error.h"
#include "io/file.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"
#include "io/writers_internal.h"

namespace io {

PointSet read_points(const std::string& path) {
  Mesh mesh = read(path, false);
  if (mesh.vertices.empty())
    throw ParseError(display_name(path) + ": no points in the file");
  return {mesh.dimension, std::move(mesh.vertices)};
}

void write_points(const std::string& path, const PointSet& points) {
  const Mesh mesh = {points.dimension, points.points, {}, {}};
  switch (output_format(path).value_or(OutputFormat::Text)) {
    case OutputFormat::Ply:
      return write_file(path, ply_bytes(mesh, {}));
    case OutputFormat::Obj:
      return write_file(path, obj_text(mesh));
    case OutputFormat::Off:
    case OutputFormat::Stl:
    case OutputFormat::Svg:
      throw WriteError(display_output(path) +
                       ": points go to .ply, .obj and text files");
    case OutputFormat::Text:
      return write_file(path, row_text(mesh));
  }
}

}  // namespace io
