/// @file
/// The subcommands of `umbrella`, one file each.
#pragma once

namespace CLI {
class App;
}

namespace command {

enum class ExitCode {
  Done = 0,      ///< what was asked for, closed and manifold where it matters
  Bug = 1,       ///< an error of the program itself
  BadInput = 2,  ///< bad usage, an unreadable input or an unwritable output
  Open = 3       ///< written, but not closed or not manifold
};

/// Each adds its subcommand to `app`; running it sets `exit_code`. Bad input is
/// io::ParseError, io::WriteError or std::invalid_argument, its text one line.
void add_reconstruct(CLI::App& app, ExitCode& exit_code);
void add_repair(CLI::App& app, ExitCode& exit_code);
void add_check(CLI::App& app, ExitCode& exit_code);
void add_generate(CLI::App& app, ExitCode& exit_code);
void add_solve(CLI::App& app, ExitCode& exit_code);
void add_view(CLI::App& app, ExitCode& exit_code);

}  // namespace command
