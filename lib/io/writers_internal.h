/// @file
/// One writer a format, from a mesh to bytes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/mesh.h"

namespace io {

enum class OutputFormat { Ply, Off, Obj, Stl, Svg, Text };

/// What the extension says; none if it is unknown, and for `-`.
std::optional<OutputFormat> output_format(std::string_view path);

/// Binary little endian; coordinates are floats if all of them fit exactly.
std::string ply_bytes(const Mesh& mesh, std::span<const double> lambda);
std::string off_text(const Mesh& mesh);
std::string obj_text(const Mesh& mesh);
/// @pre coordinates fit float
std::string stl_bytes(const Mesh& mesh);
/// A picture of a curve and its points, to seven digits.
std::string svg_text(const Mesh& mesh);
/// A row per edge, `x y [z]` of its ends; without edges a row per vertex.
std::string row_text(const Mesh& mesh);

}  // namespace io
