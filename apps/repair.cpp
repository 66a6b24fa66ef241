// umbrella repair: another tool's triangles in, a closed surface out.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/option_checks.h"
#include "apps/reconstruct_options.h"
#include "apps/reconstruct_run.h"

namespace command {

void add_repair(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<ReconstructOptions>();
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
      ->check(path_problem)
      ->type_name("MESH");
  add_output_options(*sub, *options);
  add_closing_options(*sub, options->request);
  add_program_options(*sub, options->request);
  add_run_options(*sub, *options);
  sub->callback(
      [options, &exit_code] { exit_code = run_reconstruct(*options); });
}

}  // namespace command
