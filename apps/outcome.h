/// @file
/// What `umbrella reconstruct` asks for and gets, in the plane and in space.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/program_files.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "io/mesh.h"
#include "io/points.h"
#include "umbrella/curve.h"
#include "umbrella/reconstruct.h"

namespace command {

struct Request {
  std::vector<std::string> files;  ///< for messages and the report
  umbrella::Stage stage = umbrella::Stage::Closed;
  std::string method = "umbrella";
  std::string criterion = "paper";
  std::string umbrella = "first";
  umbrella::CloseMode close = umbrella::CloseMode::Best;
  umbrella::CloseWeight weight = umbrella::CloseWeight::BallOverlap;
  std::optional<umbrella::CurveMode> curve;  ///< in the plane; none: Auto
  std::optional<double> time_limit;          ///< seconds
  unsigned threads = 1;
  bool repairs = false;  ///< the file is a mesh
  ProgramPrefixes programs;
};

struct Outcome {
  io::Mesh mesh;  ///< the used rows as vertices, in their order
  std::vector<double> lambda;
  /// The report up to and with `surface`, and `seconds` of the stages. Stages
  /// that were not run have no keys.
  report::Json report;
  std::string summary;  ///< "20 triangles, genus 0", "12 edges"
  std::string state;    ///< "closed, manifold" or what is wrong
  bool sound = false;   ///< closed and manifold, and no limit was hit
};

/// @param faces  of a mesh to be repaired, else none
/// @throws std::invalid_argument  too few points, or all in one plane
Outcome reconstruct_surface(
    const io::PointSet& points, const Request& request,
    terminal::Progress& progress,
    std::span<const umbrella::IndexedTriangle> faces = {});

/// @throws std::invalid_argument  too few points, all on one line, or an option
///   that the plane does not have
Outcome reconstruct_plane(const io::PointSet& points, const Request& request);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

/// The rows that some cell (triangle or edge) uses become the vertices of
/// `mesh`, in their order.
/// @return the vertex of each row that is used
template <class Cells>
std::vector<std::uint32_t> take_used_rows(const io::PointSet& points,
                                          const Cells& cells, io::Mesh& mesh) {
  std::vector<std::uint32_t> vertex_of_row(points.points.size(), 0);
  for (const auto& cell : cells)
    for (const std::uint32_t row : cell) vertex_of_row[row] = 1;
  for (std::size_t row = 0; row < vertex_of_row.size(); ++row) {
    if (vertex_of_row[row] == 0) continue;
    vertex_of_row[row] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(points.points[row]);
  }
  return vertex_of_row;
}

}  // namespace command
