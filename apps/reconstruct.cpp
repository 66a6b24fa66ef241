// umbrella reconstruct: points in, a closed surface or curve out.

#include "umbrella/reconstruct.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/option_checks.h"
#include "apps/outcome.h"
#include "apps/reconstruct_options.h"
#include "apps/reconstruct_run.h"
#include "umbrella/methods.h"

namespace command {
namespace {

template <class Names>
std::vector<std::string> strings(const Names& names) {
  return {names.begin(), names.end()};
}

void add_point_files(CLI::App& sub, ReconstructOptions& options) {
  sub.add_option("points", options.request.files,
                 "Point files (PLY, OFF, OBJ, STL, text), taken together; - is "
                 "standard input")
      ->required()
      ->check(path_problem)
      ->type_name("IN");
}

void add_method_options(CLI::App& sub, Request& request) {
  add_choice<umbrella::Stage, umbrella::Stage>(
      sub, {"--stage", "STAGE", "Stop after: filter, clean or closed [closed]"},
      request.stage,
      {{"filter", umbrella::Stage::Filter},
       {"clean", umbrella::Stage::Clean},
       {"closed", umbrella::Stage::Closed}});
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

auto is_one_of(const std::vector<std::string>& names) {
  return
      [names](const std::string& text) { return choice_problem(text, names); };
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
      ->check(is_one_of(criteria))
      ->type_name("NAME");
  const auto choices = strings(umbrella::umbrella_choice_names());
  sub.add_option(
         "--umbrella", request.umbrella,
         "Which umbrella a point chooses: " + joined(choices) + " [first]")
      ->check(is_one_of(choices))
      ->type_name("NAME");
  add_choice<std::optional<umbrella::CurveMode>, umbrella::CurveMode>(
      sub,
      {"--curve", "MODE",
       "Of points in the plane: auto, paper, closed, open, tsp or mutual "
       "[auto]"},
      request.curve,
      {{"auto", umbrella::CurveMode::Auto},
       {"paper", umbrella::CurveMode::Paper},
       {"closed", umbrella::CurveMode::Closed},
       {"open", umbrella::CurveMode::Open},
       {"tsp", umbrella::CurveMode::Tour},
       {"mutual", umbrella::CurveMode::Mutual}});
}

}  // namespace

void add_reconstruct(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<ReconstructOptions>();
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
  add_program_options(*sub, options->request);
  add_run_options(*sub, *options);
  sub->callback(
      [options, &exit_code] { exit_code = run_reconstruct(*options); });
}

}  // namespace command
