#include "apps/reconstruct_options.h"

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"

namespace command {
void add_output_options(CLI::App& sub, ReconstructOptions& options) {
  const bool may_be_curve = !options.request.repairs;
  sub.add_option(
         "-o,--output", options.out,
         std::string("Mesh file: .ply (with lambda), .off, .obj, .stl; ") +
             (may_be_curve ? "of a curve .ply, .obj, .svg, .txt; " : "") +
             "- is standard output, as PLY")
      ->check(path_problem)
      ->type_name("OUT");
  sub.add_option("--report", options.report,
                 "Counts, times and the certificate as JSON")
      ->check(path_problem)
      ->type_name("FILE");
  sub.add_option("--view", options.view,
                 std::string("HTML page that shows the surface") +
                     (may_be_curve ? " or curve" : ""))
      ->check(path_problem)
      ->type_name("FILE");
}

void add_closing_options(CLI::App& sub, Request& request) {
  add_choice<umbrella::CloseMode, umbrella::CloseMode>(
      sub,
      {"--close", "MODE",
       "best: worst triangles last, no point left out if possible; "
       "paper: any solution of the paper's program [best]"},
      request.close,
      {{"best", umbrella::CloseMode::Best},
       {"paper", umbrella::CloseMode::Paper}});
  add_choice<umbrella::CloseWeight, umbrella::CloseWeight>(
      sub,
      {"--weight", "NAME",
       "What makes a triangle the worse in --close best: ball-overlap, "
       "circumradius, lambda or area [ball-overlap]"},
      request.weight,
      {{"ball-overlap", umbrella::CloseWeight::BallOverlap},
       {"circumradius", umbrella::CloseWeight::Circumradius},
       {"lambda", umbrella::CloseWeight::LambdaLower},
       {"area", umbrella::CloseWeight::Area}});
  sub.add_option(
         "--time-limit", request.time_limit,
         "Seconds for closing; regions undecided by then are closed by cell "
         "labels")
      ->check(seconds_problem)
      ->type_name("S");
}

void add_program_options(CLI::App& sub, Request& request) {
  const auto prefix = [&sub](const char* name, std::string& value,
                             const char* extension) {
    sub.add_option(name, value,
                   std::string("Write each program of the closing as "
                               "PREFIX-1") +
                       extension + ", PREFIX-2" + extension + ", ...")
        ->check(file_problem)
        ->type_name("PREFIX");
  };
  prefix("--write-opb", request.programs.opb, ".opb");
  prefix("--write-lp", request.programs.lp, ".lp");
  prefix("--write-mps", request.programs.mps, ".mps");
}

void add_run_options(CLI::App& sub, ReconstructOptions& options) {
  sub.add_option("--threads", options.request.threads,
                 "At most so many threads, in space: 1 to 4096 [1]")
      ->check(CLI::Range(1U, 4096U).description(""))
      ->type_name("N");
  sub.add_flag("--quiet", options.quiet, "No summary, no progress");
  add_choice<terminal::Color, terminal::Color>(
      sub, {"--color", "WHEN", "auto, always or never [auto]"}, options.color,
      {{"auto", terminal::Color::Auto},
       {"always", terminal::Color::Always},
       {"never", terminal::Color::Never}});
}

}  // namespace command
