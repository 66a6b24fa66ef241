/// @file
/// One parser a format, from bytes to a mesh.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/mesh.h"

namespace io {

/// What a parser works on.
struct Source {
  std::string_view file;  ///< as shown in messages
  std::string_view bytes;
  bool faces = true;  ///< false: read points, pass over triangles and edges
};

/// The file, of whatever format. With `faces`, points as text are an error.
/// @throws ParseError  unreadable, empty, compressed or malformed
Mesh read(const std::string& path, bool faces);

/// Does the path end with this, in letters of either case?
bool has_extension(std::string_view path, std::string_view end);

/// Does an OFF file start like this?
bool is_off_keyword(std::string_view bytes);

Mesh parse_ply(const Source& source);
Mesh parse_off(const Source& source);
Mesh parse_obj(const Source& source);
Mesh parse_stl_text(const Source& source);
Mesh parse_stl_binary(const Source& source);
Mesh parse_text(const Source& source);
/// Edges of the plane, as write_mesh() puts them into a .txt file.
Mesh parse_text_edges(const Source& source);

/// Fan of a polygon, about its first corner.
template <class Corners>
void add_face(const Corners& corners, Mesh& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// More vertices than any file may hold: ids are 32 bits.
inline constexpr std::int64_t kMaxVertices = 0xffff'fffe;

}  // namespace io
