/// @file
/// Checks of option values, for CLI::Option::check(): each returns what is
/// wrong, or nothing.
#pragma once

#include <string>

namespace command {

/// Empty names are refused.
std::string path_problem(const std::string& text);

/// Likewise, and standard output, which takes other lines.
std::string file_problem(const std::string& text);

/// A time from 0 to 1e9. (CLI::Range lets NaN through.)
std::string seconds_problem(const std::string& text);

/// A number without a sign. (CLI takes -1 for a large one.)
std::string count_problem(const std::string& text);

}  // namespace command
