// umbrella view: a mesh as a page for the browser.

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>

#include "apps/command.h"
#include "apps/option_checks.h"
#include "apps/paths.h"
#include "apps/viewer.h"
#include "io/file.h"
#include "io/mesh.h"

namespace command {
namespace {

struct Options {
  std::string mesh;
  std::string out;
};

ExitCode view(const Options& options) {
  const std::array in = {options.mesh}, out = {options.out};
  require_no_input(in, out);
  io::require_writable(options.out);
  io::write_file(options.out, viewer_page(input_name(options.mesh),
                                          io::read_mesh(options.mesh)));
  return ExitCode::Done;
}

}  // namespace

void add_view(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* const sub =
      app.add_subcommand("view", "Make a page that shows a mesh");
  sub->footer(
      R"(The mesh is a PLY, OFF, OBJ or STL file of triangles, or a PLY, OBJ or .txt file
of edges. The page holds all it needs; edges without two triangles are red.

Examples:
  umbrella view mesh.ply -o mesh.html
  umbrella reconstruct scan.ply --view mesh.html)");
  sub->add_option("mesh", options->mesh, "Mesh file, - for standard input")
      ->required()
      ->check(path_problem)
      ->type_name("MESH");
  sub->add_option("-o,--output", options->out,
                  "HTML file, - for standard output")
      ->required()
      ->check(path_problem)
      ->type_name("FILE");
  sub->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace command
