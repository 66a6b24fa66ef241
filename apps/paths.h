/// @file
/// Files that a run reads and writes must not be one.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace command {

/// Where a path leads; two paths that lead to one place are the same file.
std::filesystem::path place(const std::string& path);

/// What a reader would call an input: the last part of its path.
std::string input_name(const std::string& path);

/// @param outputs  empty ones are not asked for; "-" is a stream
/// @throws std::invalid_argument  an output is an input
void require_no_input(std::span<const std::string> inputs,
                      std::span<const std::string> outputs);

/// @throws std::invalid_argument  two of the outputs are one
void require_different(std::span<const std::string> outputs);

}  // namespace command
