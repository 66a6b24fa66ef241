#include "apps/reconstruct_run.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "apps/memory.h"
#include "apps/reconstruct_outputs.h"
#include "apps/terminal.h"
#include "io/mesh.h"
#include "io/points.h"
#include "umbrella/stopwatch.h"

namespace command {
namespace {

/// What a reconstruction takes, by far most of it for the triangulation: 0.9
/// to 1.1 kB on the scans of the paper.
constexpr std::size_t kBytesPerPoint = 1024;

/// Up to here to make room has paid off; with a million points huge pages take
/// longer.
constexpr std::size_t kMostPoints = 100'000;

// The points of all files, in order; rows count through.
io::PointSet read_all(const std::vector<std::string>& files) {
  io::PointSet all;
  for (const std::string& file : files) {
    io::PointSet part = io::read_points(file);
    if (all.points.empty()) {
      all = std::move(part);
      continue;
    }
    if (part.dimension != all.dimension)
      throw std::invalid_argument(
          file + ": points of dimension " + std::to_string(part.dimension) +
          " after points of dimension " + std::to_string(all.dimension));
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  }
  return all;
}

// The vertices of a mesh, used or not, and its triangles.
io::PointSet read_mesh(const std::string& file,
                       std::vector<umbrella::IndexedTriangle>& faces) {
  io::Mesh mesh = io::read_mesh(file);
  if (mesh.triangles.empty())
    throw std::invalid_argument(file + ": no triangles to repair");
  io::PointSet points;
  points.dimension = 3;
  points.points = std::move(mesh.vertices);
  faces = std::move(mesh.triangles);
  return points;
}

}  // namespace

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

ExitCode run_reconstruct(const ReconstructOptions& options) {
  require_outputs(options);
  keep_memory();
  const Request& request = options.request;
  terminal::Progress progress(options.quiet);
  const umbrella::Stopwatch total;
  progress.show("read");
  std::vector<umbrella::IndexedTriangle> faces;
  const io::PointSet points = request.repairs
                                  ? read_mesh(request.files.front(), faces)
                                  : read_all(request.files);
  if (!options.out.empty())
    io::require_mesh_format(options.out, points.dimension);
  const double read_seconds = total.seconds();
  if (points.points.size() <= kMostPoints)
    make_room(kBytesPerPoint * points.points.size());

  const Outcome outcome =
      points.dimension == 2
          ? reconstruct_plane(points, request)
          : reconstruct_surface(points, request, progress, faces);

  progress.show("write");
  const umbrella::Stopwatch writing;
  if (!options.out.empty())
    io::write_mesh(options.out, outcome.mesh, outcome.lambda);
  const double write_seconds = writing.seconds();
  const double total_seconds = total.seconds();
  write_report(options, outcome, {read_seconds, write_seconds, total_seconds});
  progress.clear();
  if (!options.quiet) print_summary(options, outcome, total_seconds);
  const bool as_asked =
      outcome.sound || request.stage != umbrella::Stage::Closed;
  return as_asked ? ExitCode::Done : ExitCode::Open;
}

}  // namespace command
