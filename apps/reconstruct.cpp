// umbrella reconstruct: points in, a closed surface or curve out.

#include "umbrella/reconstruct.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "apps/command.h"
#include "apps/outcome.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "io/file.h"
#include "io/mesh.h"
#include "io/points.h"
#include "umbrella/methods.h"
#include "umbrella/stopwatch.h"

namespace command {
namespace {

struct Options {
  Request request;
  std::string out;
  std::string report;
  bool quiet = false;
  terminal::Color color = terminal::Color::Auto;
};

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

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux: KiB
}

struct Seconds {
  double read, write, total;
};

report::Json complete(const Request& request, const Outcome& outcome,
                      const Seconds& wall_clock) {
  report::Json json = outcome.report;
  report::Json seconds = {{"read", wall_clock.read}};
  seconds.update(json["seconds"]);
  seconds["write"] = wall_clock.write;
  seconds["total"] = wall_clock.total;
  json["seconds"] = seconds;
  json["threads"] = request.threads;
  json["peak_memory_bytes"] = peak_memory_bytes();
  report::add_build(json);
  return json;
}

void print_summary(const Options& options, const Outcome& outcome,
                   double total_seconds) {
  const bool stdout_is_taken = options.out == "-" || options.report == "-";
  std::ostream& out = stdout_is_taken ? std::cerr : std::cout;
  std::array<char, 32> seconds;
  std::snprintf(seconds.data(), seconds.size(), "%.2f", total_seconds);
  out << joined(options.request.files) << ": "
      << outcome.report["input"]["points"] << " points, " << outcome.summary
      << ", "
      << terminal::verdict(outcome.state, outcome.sound, options.color,
                           stdout_is_taken ? 2 : 1)
      << " (" << seconds.data() << " s)\n";
}

// Where a path leads; two paths that lead to one place are the same file.
std::filesystem::path place(const std::string& path) {
  std::error_code error;  // then the path itself has to do
  const auto full = std::filesystem::absolute(path, error);
  const auto canonical = std::filesystem::weakly_canonical(full, error);
  return error ? full : canonical;
}

void require_no_input(const Options& options, const std::string& output) {
  if (output == "-") return;
  for (const std::string& file : options.request.files)
    if (file != "-" && place(file) == place(output))
      throw std::invalid_argument(output + ": would overwrite the input");
}

// What would fail only after all the work, or spoil it.
void require_outputs(const Options& options) {
  for (const std::string& path : {options.out, options.report})
    if (!path.empty()) {
      require_no_input(options, path);
      io::require_writable(path);
    }
  if (options.out.empty() || options.report.empty()) return;
  if (place(options.out) == place(options.report))
    throw std::invalid_argument("-o and --report cannot both be " +
                                options.out);
}

ExitCode reconstruct(const Options& options) {
  require_outputs(options);
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
  if (!options.report.empty())
    io::write_file(
        options.report,
        report::text(complete(request, outcome,
                              {read_seconds, write_seconds, total_seconds})));
  progress.clear();
  if (!options.quiet) print_summary(options, outcome, total_seconds);
  const bool as_asked =
      outcome.sound || request.stage != umbrella::Stage::Closed;
  return as_asked ? ExitCode::Done : ExitCode::Open;
}

// Empty if the text names a file.
std::string path_problem(const std::string& text) {
  return text.empty() ? "the name of a file is empty" : "";
}

template <class Names>
std::vector<std::string> strings(const Names& names) {
  return {names.begin(), names.end()};
}

// Empty if the text is a time. (CLI::Range lets NaN through.)
std::string seconds_problem(const std::string& text) {
  double value = 0;
  const bool is_time =
      CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 1e9;
  return is_time ? "" : "Value " + text + " not in range 0 to 1e9";
}

void add_point_files(CLI::App& sub, Options& options) {
  sub.add_option("in", options.request.files,
                 "Point files (PLY, OFF, OBJ, STL, text), taken together; - is "
                 "standard input")
      ->required()
      ->type_name("IN");
}

void add_output_options(CLI::App& sub, Options& options) {
  sub.add_option(
         "-o,--output", options.out,
         "Mesh file: .ply (with lambda), .off, .obj, .stl; of a curve .ply, "
         ".obj, .svg, .txt; - is standard output, as PLY")
      ->check(path_problem)
      ->type_name("OUT");
  sub.add_option("--report", options.report,
                 "Counts, times and the certificate as JSON")
      ->check(path_problem)
      ->type_name("FILE");
}

void add_closing_options(CLI::App& sub, Request& request) {
  sub.add_option("--close", request.close,
                 "best: worst triangles last, no point left out if possible; "
                 "paper: any solution of the paper's program [best]")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, umbrella::CloseMode>{
              {"best", umbrella::CloseMode::Best},
              {"paper", umbrella::CloseMode::Paper}}))
      ->type_name("MODE");
  sub.add_option(
         "--time-limit", request.time_limit,
         "Seconds for closing; regions undecided by then are closed by cell "
         "labels")
      ->check(seconds_problem)
      ->type_name("S");
}

void add_method_options(CLI::App& sub, Request& request) {
  sub.add_option("--stage", request.stage,
                 "Stop after: filter, clean or closed [closed]")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, umbrella::Stage>{
              {"filter", umbrella::Stage::Filter},
              {"clean", umbrella::Stage::Clean},
              {"closed", umbrella::Stage::Closed}}))
      ->type_name("STAGE");
  add_closing_options(sub, request);
}

std::string method_problem(const std::string& text) {
  try {
    umbrella::parse_method(text);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "";
}

void add_experiment_options(CLI::App& sub, Request& request) {
  std::vector<std::string> methods;
  for (const auto& method : umbrella::all_methods())
    methods.emplace_back(method.name);
  sub.add_option("--method", request.method,
                 "What finds the first triangles: " + joined(methods) +
                     "; parameters follow as NAME=X or NAME=X:Y [umbrella]")
      ->check(method_problem)
      ->type_name("NAME");
  const auto criteria = strings(umbrella::criterion_names());
  sub.add_option(
         "--criterion", request.criterion,
         "What makes a triangle a good one: " + joined(criteria) + " [paper]")
      ->check(CLI::IsMember(criteria))
      ->type_name("NAME");
  const auto choices = strings(umbrella::umbrella_choice_names());
  sub.add_option(
         "--umbrella", request.umbrella,
         "Which umbrella a point chooses: " + joined(choices) + " [first]")
      ->check(CLI::IsMember(choices))
      ->type_name("NAME");
  sub.add_option("--curve", request.curve,
                 "Of points in the plane: auto, paper, closed, open, tsp or "
                 "mutual [auto]")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, umbrella::CurveMode>{
              {"auto", umbrella::CurveMode::Auto},
              {"paper", umbrella::CurveMode::Paper},
              {"closed", umbrella::CurveMode::Closed},
              {"open", umbrella::CurveMode::Open},
              {"tsp", umbrella::CurveMode::Tour},
              {"mutual", umbrella::CurveMode::Mutual}}))
      ->type_name("MODE");
}

void add_run_options(CLI::App& sub, Options& options) {
  sub.add_option("--threads", options.request.threads,
                 "At most so many threads, in space [1]")
      ->check(CLI::Range(1U, 4096U))
      ->type_name("N");
  sub.add_flag("--quiet", options.quiet, "No summary, no progress");
  sub.add_option("--color", options.color, "auto, always or never [auto]")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, terminal::Color>{
              {"auto", terminal::Color::Auto},
              {"always", terminal::Color::Always},
              {"never", terminal::Color::Never}}))
      ->type_name("WHEN");
}

}  // namespace

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

void add_reconstruct(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* const sub = app.add_subcommand(
      "reconstruct", "Put a closed surface or curve through sample points");
  sub->footer(
      R"(Without -o nothing but the summary is printed. Exit code 3: the surface is not
closed, not manifold, or a limit was hit; the report says where.

Examples:
  umbrella reconstruct scan.ply -o mesh.ply
  umbrella reconstruct a.xyz b.xyz -o mesh.stl --report mesh.json
  umbrella reconstruct scan.ply --stage filter -o filtered.ply)");
  add_point_files(*sub, *options);
  add_output_options(*sub, *options);
  add_method_options(*sub, options->request);
  add_experiment_options(*sub, options->request);
  add_run_options(*sub, *options);
  sub->callback([options, &exit_code] { exit_code = reconstruct(*options); });
}

void add_repair(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  options->request.repairs = true;
  CLI::App* const sub = app.add_subcommand(
      "repair", "Close the surface of another tool, through all its vertices");
  sub->footer(
      R"(Triangles of the mesh that are Delaunay triangles of its vertices are kept,
cleaned of what is not manifold, and closed. Exit codes and report are those of
reconstruct.

Examples:
  umbrella repair scan.off -o closed.ply
  umbrella repair torn.stl -o closed.stl --report closed.json)");
  sub->add_option("mesh", options->request.files,
                  "Mesh file (PLY, OFF, OBJ, STL); - is standard input")
      ->required()
      ->expected(1)
      ->type_name("MESH");
  add_output_options(*sub, *options);
  add_closing_options(*sub, options->request);
  add_run_options(*sub, *options);
  sub->callback([options, &exit_code] { exit_code = reconstruct(*options); });
}

}  // namespace command
