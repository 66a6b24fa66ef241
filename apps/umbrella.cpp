// The umbrella command: finds the subcommand, and turns whatever goes wrong
// into one line and an exit code.

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "apps/command.h"
#include "build_info.h"
#include "io/error.h"

namespace {

using command::ExitCode;

constexpr const char* kFooter = R"(Examples:
  umbrella generate knot -n 10000 -o knot.ply
  umbrella reconstruct knot.ply -o mesh.ply --report mesh.json
  umbrella check mesh.ply --points knot.ply

`-` is standard input or output. Exit codes: 0 done, a closed manifold surface;
2 bad usage or bad input; 3 a surface that is not closed or not manifold, or a
limit or Ctrl-C came first; 1 an error of the program itself.
`umbrella SUBCOMMAND --help` lists the options of a subcommand.)";

ExitCode fail(ExitCode code, std::string message) {
  // Some texts of the option parser have two lines; ours is to be one.
  for (char& c : message)
    if (c == '\n') c = ' ';
  std::cerr << "umbrella: error: " << message << '\n';
  return code;
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Closed surfaces and curves through sample points", "umbrella");
  app.footer(kFooter);
  app.set_version_flag("--version",
                       "umbrella " + std::string(build_info::kVersion));
  app.require_subcommand(1);
  ExitCode exit_code = ExitCode::Done;
  command::add_reconstruct(app, exit_code);
  command::add_repair(app, exit_code);
  command::add_check(app, exit_code);
  command::add_generate(app, exit_code);
  command::add_solve(app, exit_code);
  command::add_view(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // help and version
    app.exit(request);
  } catch (const CLI::RequiredError& e) {
    // The parser misses the subcommand and does not look what is in its place.
    if (app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-')
      return fail(ExitCode::BadInput,
                  "no subcommand is called '" + std::string(argv[1]) + "'");
    return fail(ExitCode::BadInput, e.what());
  } catch (const CLI::ParseError& e) {
    return fail(ExitCode::BadInput, e.what());
  }
  if (!std::cout.flush())
    return fail(ExitCode::BadInput, "<stdout>: cannot write");
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  const auto end = [](ExitCode code) { return static_cast<int>(code); };
  // A file beyond the limit of sizes is then an error like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return end(run(argc, argv));
  } catch (const io::ParseError& e) {
    return end(fail(ExitCode::BadInput, e.what()));
  } catch (const io::WriteError& e) {
    return end(fail(ExitCode::BadInput, e.what()));
  } catch (const std::invalid_argument& e) {
    return end(fail(ExitCode::BadInput, e.what()));
  } catch (const std::bad_alloc&) {
    return end(fail(ExitCode::BadInput, "not enough memory"));
  } catch (const std::exception& e) {
    return end(fail(ExitCode::Bug, std::string("internal error: ") + e.what()));
  }
}
