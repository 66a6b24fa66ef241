/// @file
/// Whole files in and out; `-` is standard input or output.
#pragma once

#include <string>
#include <string_view>

namespace io {

/// @throws ParseError  the file is missing, a directory or not readable
std::string read_file(const std::string& path);

/// Throws the WriteError that write_file would, where it can be known before
/// there is anything to write: call before a long computation.
void require_writable(const std::string& path);

/// Writes a temporary file beside `path` and renames it when it is complete:
/// whatever fails, `path` is what it was, and no other file is left. A symbolic
/// link is followed; a device or a pipe is written directly.
///
/// @throws WriteError
void write_file(const std::string& path, std::string_view bytes);

}  // namespace io
