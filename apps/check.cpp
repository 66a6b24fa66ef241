// umbrella check: the certificate of any mesh, and whether it passes through
// given points.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/option_checks.h"
#include "apps/report.h"
#include "io/mesh.h"
#include "io/points.h"
#include "umbrella/certificate.h"

namespace command {
namespace {

using Eigen::Vector3d;

struct Options {
  std::string mesh;
  std::string points;
  bool json = false;
};

bool before(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

Vector3d to_float(const Vector3d& p) { return p.cast<float>().cast<double>(); }

// Which points lie at a vertex that the mesh uses.
struct Passage {
  std::size_t used = 0;  // distinct points
  std::vector<std::uint32_t> unused_rows;
  std::size_t foreign_vertices = 0;  // at no point
};

// Meshes in floats (STL) are compared with the points as floats.
Passage passage(const std::vector<Vector3d>& vertices,
                std::vector<Vector3d> points) {
  const bool floats = std::ranges::all_of(
      vertices, [](const Vector3d& p) { return p == to_float(p); });
  if (floats) std::ranges::transform(points, points.begin(), to_float);

  std::vector<Vector3d> sorted_vertices = vertices;
  std::ranges::sort(sorted_vertices, before);
  std::vector<Vector3d> sorted_points = points;
  std::ranges::sort(sorted_points, before);
  const auto holds = [](const std::vector<Vector3d>& sorted,
                        const Vector3d& p) {
    return std::ranges::binary_search(sorted, p, before);
  };

  Passage result;
  for (std::size_t row = 0; row < points.size(); ++row)
    if (!holds(sorted_vertices, points[row]))
      result.unused_rows.push_back(static_cast<std::uint32_t>(row));
  for (std::size_t i = 0; i < sorted_points.size(); ++i)
    if ((i == 0 || sorted_points[i] != sorted_points[i - 1]) &&
        holds(sorted_vertices, sorted_points[i]))
      ++result.used;
  for (const Vector3d& v : vertices)
    if (!holds(sorted_points, v)) ++result.foreign_vertices;
  return result;
}

// The vertices that some triangle or edge uses.
std::vector<Vector3d> used_vertices(const io::Mesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  for (const auto& edge : mesh.edges)
    for (const std::uint32_t v : edge) is_used[v] = true;
  std::vector<Vector3d> used;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(mesh.vertices[v]);
  return used;
}

// The report, and whether the mesh is what one wants of a reconstruction.
template <class Certificate, class ToJson>
ExitCode print(const Options& options, const io::Mesh& mesh,
               const Certificate& certificate, const ToJson& to_json) {
  report::Json json = {{"mesh", options.mesh}};
  bool passes = true;
  if (options.points.empty()) {
    json["surface"] =
        to_json(certificate, certificate.vertices, certificate.unused_vertices);
  } else {
    const Passage through =
        passage(used_vertices(mesh), io::read_points(options.points).points);
    json["points"] = options.points;
    json["surface"] = to_json(certificate, through.used, through.unused_rows);
    json["surface"]["foreign_vertices"] = through.foreign_vertices;
    passes = through.unused_rows.empty() && through.foreign_vertices == 0;
  }
  report::add_build(json);
  std::cout << (options.json ? report::text(json)
                             : report::lines({{"mesh", options.mesh},
                                              {"surface", json["surface"]}}));
  const bool sound = certificate.closed && certificate.manifold && passes;
  return sound ? ExitCode::Done : ExitCode::Open;
}

ExitCode check(const Options& options) {
  const io::Mesh mesh = io::read_mesh(options.mesh);
  if (mesh.triangles.empty())
    return print(options, mesh,
                 umbrella::check_curve(mesh.vertices.size(), mesh.edges),
                 report::curve);
  return print(options, mesh,
               umbrella::check_surface(mesh.vertices, mesh.triangles),
               report::surface);
}

}  // namespace

void add_check(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* const sub =
      app.add_subcommand("check", "Say what a mesh is, from the mesh alone");
  sub->footer(
      R"(The mesh is a PLY, OFF, OBJ or STL file of triangles, or a PLY, OBJ or .txt
file of edges. Exit code 0: closed, manifold, and through all points of --points and
through nothing else; 3 otherwise.

Examples:
  umbrella check mesh.ply
  umbrella check mesh.ply --points scan.xyz --json)");
  sub->add_option("mesh", options->mesh, "Mesh file, - for standard input")
      ->required()
      ->check(path_problem)
      ->type_name("MESH");
  sub->add_option("--points", options->points,
                  "The points that it should pass through")
      ->check(path_problem)
      ->type_name("IN");
  sub->add_flag("--json", options->json, "Print JSON");
  sub->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace command
