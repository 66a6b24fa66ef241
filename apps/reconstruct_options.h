/// @file
/// The options that `umbrella reconstruct` and `umbrella repair` share.
#pragma once

#include <string>

#include "apps/outcome.h"
#include "apps/terminal.h"

namespace CLI {
class App;
}

namespace command {

struct ReconstructOptions {
  Request request;
  std::string out;     ///< mesh file; empty: none
  std::string report;  ///< empty: none
  std::string view;    ///< HTML file; empty: none
  bool quiet = false;
  terminal::Color color = terminal::Color::Auto;
};

/// -o, --report and --view; what is repaired is no curve.
void add_output_options(CLI::App& sub, ReconstructOptions& options);
/// How holes are closed, and within what time.
void add_closing_options(CLI::App& sub, Request& request);
/// The programs of the closing as files.
void add_program_options(CLI::App& sub, Request& request);
/// --threads, --quiet and --color.
void add_run_options(CLI::App& sub, ReconstructOptions& options);

}  // namespace command
