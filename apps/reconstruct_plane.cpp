#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "apps/outcome.h"
#include "umbrella/certificate.h"
#include "umbrella/curve.h"

namespace command {
namespace {

using umbrella::CurveMode;
using umbrella::Stage;

void require_plane_options(const Request& request) {
  if (request.criterion != "paper")
    throw std::invalid_argument("--criterion " + request.criterion +
                                " is for points in space");
  if (request.method != "umbrella")
    throw std::invalid_argument("--method " + request.method +
                                " is for points in space");
  if (request.umbrella != "first")
    throw std::invalid_argument("--umbrella " + request.umbrella +
                                " is for points in space");
  if (request.stage != Stage::Closed && request.curve &&
      *request.curve != CurveMode::Paper)
    throw std::invalid_argument(
        "--stage filter and clean know no --curve but paper");
  if (request.close != umbrella::CloseMode::Best)
    throw std::invalid_argument("--close paper is for points in space");
  if (request.weight != umbrella::CloseWeight::BallOverlap)
    throw std::invalid_argument("--weight is for points in space");
  if (!request.programs.are_empty())
    throw std::invalid_argument(
        "--write-opb, --write-lp and --write-mps are for points in space");
}

// The filter alone, if no more is asked for.
CurveMode mode_of(const Request& request) {
  if (request.stage != Stage::Closed) return CurveMode::Paper;
  return request.curve.value_or(CurveMode::Auto);
}

umbrella::CurveReconstruction run(const io::PointSet& points,
                                  const Request& request) {
  std::vector<Eigen::Vector2d> planar;
  planar.reserve(points.points.size());
  for (const Eigen::Vector3d& p : points.points) planar.push_back(p.head<2>());
  umbrella::CurveOptions options;
  options.mode = mode_of(request);
  auto result = umbrella::reconstruct_curve(planar, options);
  if (result.dimension == 2) return result;
  const std::size_t distinct = result.counts.points - result.counts.duplicates;
  throw std::invalid_argument(
      joined(request.files) + ": no curve: " +
      (distinct < 3 ? std::to_string(distinct) + " distinct points of 3 needed"
                    : "all points lie on one line"));
}

const char* name(umbrella::TourStatus status) {
  switch (status) {
    case umbrella::TourStatus::Optimal:
      return "optimal";
    case umbrella::TourStatus::Feasible:
      return "feasible";
    case umbrella::TourStatus::Infeasible:
      return "infeasible";
    case umbrella::TourStatus::Limit:
      break;
  }
  return "limit";
}

bool has_tour(const umbrella::TourResult& tour) {
  return tour.status == umbrella::TourStatus::Optimal ||
         tour.status == umbrella::TourStatus::Feasible;
}

report::Json closing(const Request& request,
                     const umbrella::CurveReconstruction& result) {
  report::Json json;
  if (mode_of(request) == CurveMode::Closed) {
    const umbrella::CurveClosingReport& c = result.closing;
    json = {{"regions", c.regions},     {"variables", c.variables},
            {"feasible", c.feasible},   {"infeasible", c.infeasible},
            {"undecided", c.undecided}, {"grown", c.grown},
            {"conflicts", c.conflicts}};
  }
  if (result.descent) {
    const umbrella::CurveAutoReport& d = *result.descent;
    json = {{"ambiguous", d.ambiguous}, {"moves", d.moves},
            {"joined", d.joined},       {"tours", d.tours},
            {"turns", d.turns},         {"gap", d.gap}};
  }
  if (result.tour)
    json = {{"status", name(result.tour->status)},
            {"length", result.tour->length},
            {"bound", result.tour->bound}};
  json["open_points"] = result.open_rows;
  return json;
}

report::Json full_report(const Request& request,
                         const umbrella::CurveReconstruction& result,
                         const umbrella::CurveReport& curve) {
  const umbrella::CurveCounts& n = result.counts;
  report::Json json;
  json["input"] = {{"files", request.files},
                   {"points", n.points},
                   {"duplicates", n.duplicates},
                   {"dimension", 2}};
  json["delaunay"] = {{"cells", n.delaunay_cells},
                      {"edges", n.delaunay_edges},
                      {"gabriel_edges", n.gabriel_edges}};
  json["filter"] = {{"edges", n.filter_edges},
                    {"vertices_without_umbrella", n.filter_without_umbrella}};
  if (request.stage == Stage::Closed)
    json["closing"] = closing(request, result);
  std::vector<std::uint32_t> unused;  // without the rows of duplicates
  std::ranges::set_intersection(result.open_rows, curve.unused_vertices,
                                std::back_inserter(unused));
  json["surface"] = report::curve(curve, curve.vertices, unused);
  const umbrella::CurveSeconds& s = result.seconds;
  json["seconds"] = {{"delaunay", s.delaunay},
                     {"lambda", s.lambda},
                     {"filter", s.filter},
                     {"closing", s.closing}};
  return json;
}

}  // namespace

Outcome reconstruct_plane(const io::PointSet& points, const Request& request) {
  require_plane_options(request);
  umbrella::CurveReconstruction result = run(points, request);
  const umbrella::CurveReport curve =
      umbrella::check_curve(points.points.size(), result.edges);
  Outcome outcome;
  outcome.mesh.dimension = 2;
  const auto vertex = take_used_rows(points, result.edges, outcome.mesh);
  for (const auto& [a, b] : result.edges)
    outcome.mesh.edges.push_back({vertex[a], vertex[b]});
  outcome.report = full_report(request, result, curve);
  outcome.summary = std::to_string(curve.edges) + " edges, " +
                    std::to_string(curve.components) +
                    (curve.components == 1 ? " curve" : " curves");
  outcome.state = curve.closed ? "closed" : "open";
  outcome.state += curve.manifold ? ", manifold" : ", not manifold";
  const CurveMode mode = mode_of(request);
  const bool may_end = mode == CurveMode::Open || mode == CurveMode::Mutual;
  outcome.sound = curve.manifold && (curve.closed || may_end);
  if (result.tour) {
    outcome.state += std::string(", tour ") + name(result.tour->status);
    outcome.sound = outcome.sound && has_tour(*result.tour);
  }
  outcome.lambda = std::move(result.lambda);
  return outcome;
}

}  // namespace command
