#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

#include "apps/interrupt.h"
#include "apps/outcome.h"
#include "umbrella/methods.h"

namespace command {
namespace {

using report::Json;
using umbrella::Stage;

void require_space_options(const Request& request) {
  if (request.curve)
    throw std::invalid_argument("--curve is for points in the plane");
  if (request.stage != Stage::Closed && !request.programs.are_empty())
    throw std::invalid_argument(
        "--write-opb, --write-lp and --write-mps are for --stage closed");
  if (request.close == umbrella::CloseMode::Paper &&
      request.weight != umbrella::CloseWeight::BallOverlap)
    throw std::invalid_argument("--weight is for --close best");
  if (umbrella::parse_method(request.method).is_umbrella()) return;
  if (request.criterion != "paper" || request.umbrella != "first")
    throw std::invalid_argument(
        "--criterion and --umbrella are for --method umbrella");
}

// Shows the regions that are done with, at most a hundred times.
std::function<void(std::size_t, std::size_t)> closing_progress(
    terminal::Progress& progress) {
  return [&progress, shown = std::size_t{0}](std::size_t done,
                                             std::size_t all) mutable {
    const std::size_t percent = 100 * done / all;
    if (percent == shown) return;
    shown = percent;
    progress.show("closing: " + std::to_string(done) + " of " +
                  std::to_string(all) + " regions");
  };
}

umbrella::Reconstruction run(const io::PointSet& points, const Request& request,
                             terminal::Progress& progress,
                             std::span<const umbrella::IndexedTriangle> faces,
                             ProgramFiles& programs) {
  umbrella::ReconstructOptions options;
  options.stage = request.stage;
  options.method = request.method;
  options.criterion = request.criterion;
  options.umbrella = umbrella::umbrella_choice(request.umbrella);
  options.closing.mode = request.close;
  options.closing.weight = request.weight;
  if (request.repairs) options.faces = faces;
  if (request.time_limit) options.closing.seconds = *request.time_limit;
  options.threads = request.threads;
  if (!request.programs.are_empty())
    options.closing.on_program = [&](const ilp::LinearForm& form,
                                     ilp::Status status) {
      programs.add(form, status);
    };
  const terminal::Interrupt interrupt;
  options.closing.stop = &terminal::Interrupt::flag();
  options.progress = [&](std::string_view stage) { progress.show(stage); };
  options.closing.on_progress = closing_progress(progress);
  return umbrella::reconstruct(points.points, options);
}

void require_space(const Request& request,
                   const umbrella::Reconstruction& result) {
  if (result.dimension == 3) return;
  const std::size_t distinct = result.counts.points - result.counts.duplicates;
  throw std::invalid_argument(
      joined(request.files) + ": no surface: " +
      (distinct < 4 ? std::to_string(distinct) + " distinct points of 4 needed"
                    : "all points lie in one plane"));
}

// Each point left out, and why.
Json dropped_report(const umbrella::Reconstruction& result) {
  Json list = Json::array();
  for (std::size_t i = 0; i < result.dropped_rows.size(); ++i) {
    const bool is_proven =
        result.drop_reasons[i] == umbrella::DropReason::NoSolution;
    list.push_back({{"row", result.dropped_rows[i]},
                    {"reason", is_proven ? "no solution" : "limit"}});
  }
  return list;
}

Json stages_report(const Request& request,
                   const umbrella::Reconstruction& result) {
  const umbrella::ReconstructCounts& n = result.counts;
  const umbrella::ClosingReport& c = result.closing;
  Json json;
  json["delaunay"] = {{"cells", n.delaunay_cells},
                      {"triangles", n.delaunay_triangles},
                      {"gabriel_triangles", n.admissible_triangles}};
  json["filter"] = {{"method", request.method},
                    {"criterion", request.criterion},
                    {"umbrella", request.umbrella},
                    {"triangles", n.filter_triangles},
                    {"vertices_without_umbrella", n.filter_without_umbrella}};
  if (request.stage == Stage::Filter) return json;
  json["clean_up"] = {{"deleted_type2", n.deleted_type2},
                      {"deleted_type3", n.deleted_type3},
                      {"dissolved", n.dissolved},
                      {"triangles", n.clean_triangles},
                      {"vertices_without_umbrella", n.clean_without_umbrella}};
  if (request.stage == Stage::Clean) return json;
  json["holes"] = {{"count", n.holes},
                   {"largest_vertices", n.largest_hole_vertices},
                   {"candidate_triangles", c.candidate_triangles}};
  json["closing"] = {{"regions", c.regions},
                     {"largest_region_vertices", c.largest_region_vertices},
                     {"variables", c.variables},
                     {"feasible", c.feasible},
                     {"infeasible", c.infeasible},
                     {"undecided", c.undecided},
                     {"labelled", c.labelled},
                     {"grown", c.grown},
                     {"pieces_joined", c.pieces_joined},
                     {"brought_in", c.brought_in},
                     {"handles_removed", c.handles_removed},
                     {"faces_regained", c.faces_regained},
                     {"bores_opened", c.bores_opened},
                     {"dropped_points", result.dropped_rows},
                     {"dropped", dropped_report(result)},
                     {"conflicts", c.conflicts},
                     {"propagations", c.propagations},
                     {"timed_out", c.timed_out},
                     {"interrupted", terminal::Interrupt::flag().load()}};
  return json;
}

Json full_report(const Request& request,
                 const umbrella::Reconstruction& result) {
  const umbrella::ReconstructCounts& n = result.counts;
  Json json;
  json["input"] = {{"files", request.files},
                   {"points", n.points},
                   {"duplicates", n.duplicates},
                   {"dimension", 3}};
  if (request.repairs) {
    const umbrella::FaceCounts& f = result.faces;
    json["repair"] = {{"faces", f.faces},
                      {"degenerate", f.degenerate},
                      {"duplicates", f.duplicates},
                      {"not_delaunay", f.not_delaunay},
                      {"kept", f.kept}};
  }
  json.update(stages_report(request, result));
  json["surface"] = report::surface(result.surface, result.surface.vertices,
                                    result.surface.unused_vertices);
  const umbrella::ReconstructSeconds& s = result.seconds;
  json["seconds"] = {{"delaunay", s.delaunay}, {"lambda", s.lambda},
                     {"filter", s.filter},     {"clean_up", s.clean_up},
                     {"holes", s.holes},       {"closing", s.closing},
                     {"surface", s.surface},   {"certificate", s.certificate}};
  return json;
}

std::string state_of(const umbrella::SurfaceReport& surface) {
  std::string text = surface.closed ? "closed" : "open";
  text += surface.manifold ? ", manifold" : ", not manifold";
  if (surface.boundary_edges > 0)
    text += ", " + std::to_string(surface.boundary_edges) + " boundary edges";
  return text;
}

// Why the exit code may be 3 although the surface is sound.
std::string cut_text(const Request& request,
                     const umbrella::Reconstruction& result) {
  if (request.stage != Stage::Closed) return "";
  if (terminal::Interrupt::flag()) return ", cut short by Ctrl-C";
  return result.closing.timed_out ? ", cut short by --time-limit" : "";
}

std::ptrdiff_t n_dropped(const umbrella::Reconstruction& result,
                         umbrella::DropReason reason) {
  return std::ranges::count(result.drop_reasons, reason);
}

// ", 3 points unused (2 no solution, 1 limit)", or nothing.
std::string unused_text(const umbrella::Reconstruction& result) {
  const std::size_t n_unused = result.surface.unused_vertices.size();
  if (n_unused == 0) return "";
  std::string why;
  const auto add = [&](std::ptrdiff_t n, const char* reason) {
    if (n > 0)
      why += (why.empty() ? "" : ", ") + std::to_string(n) + " " + reason;
  };
  add(n_dropped(result, umbrella::DropReason::NoSolution), "no solution");
  add(n_dropped(result, umbrella::DropReason::Limit), "limit");
  return ", " + std::to_string(n_unused) +
         (n_unused == 1 ? " point unused" : " points unused") +
         (why.empty() ? "" : " (" + why + ")");
}

}  // namespace

Outcome reconstruct_surface(const io::PointSet& points, const Request& request,
                            terminal::Progress& progress,
                            std::span<const umbrella::IndexedTriangle> faces) {
  require_space_options(request);
  ProgramFiles programs(request.programs);
  umbrella::Reconstruction result =
      run(points, request, progress, faces, programs);
  require_space(request, result);
  Outcome outcome;
  const auto vertex = take_used_rows(points, result.triangles, outcome.mesh);
  for (const auto& [a, b, c] : result.triangles)
    outcome.mesh.triangles.push_back({vertex[a], vertex[b], vertex[c]});
  outcome.report = full_report(request, result);
  if (!request.programs.are_empty() && request.stage == Stage::Closed)
    outcome.report["closing"]["programs"] = programs.answers();
  outcome.summary = std::to_string(result.surface.triangles) + " triangles";
  if (result.surface.genus)
    outcome.summary += ", genus " + std::to_string(*result.surface.genus);
  outcome.summary += unused_text(result);
  outcome.state = state_of(result.surface) + cut_text(request, result);
  outcome.sound = result.surface.closed && result.surface.manifold &&
                  !terminal::Interrupt::flag() && !result.closing.timed_out &&
                  n_dropped(result, umbrella::DropReason::Limit) == 0;
  outcome.lambda = std::move(result.lambda);
  return outcome;
}

}  // namespace command
