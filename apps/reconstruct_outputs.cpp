#include "apps/reconstruct_outputs.h"

#include <sys/resource.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "apps/program_files.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "io/file.h"

namespace command {
namespace {

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux: KiB
}

report::Json complete(const Request& request, const Outcome& outcome,
                      const Seconds& wall_clock) {
  report::Json json = outcome.report;
  report::Json seconds = {{"read", wall_clock.read}};
  seconds.update(json["seconds"]);
  seconds["write"] = wall_clock.write;
  seconds["total"] = wall_clock.total;
  json["seconds"] = seconds;
  json["threads"] = request.threads;
  json["peak_memory_bytes"] = peak_memory_bytes();
  report::add_build(json);
  return json;
}

// Where a path leads; two paths that lead to one place are the same file.
std::filesystem::path place(const std::string& path) {
  std::error_code error;  // then the path itself has to do
  const auto full = std::filesystem::absolute(path, error);
  const auto canonical = std::filesystem::weakly_canonical(full, error);
  return error ? full : canonical;
}

void require_no_input(const ReconstructOptions& options,
                      const std::string& output) {
  if (output == "-") return;
  for (const std::string& file : options.request.files)
    if (file != "-" && place(file) == place(output))
      throw std::invalid_argument(output + ": would overwrite the input");
}

}  // namespace

void require_outputs(const ReconstructOptions& options) {
  for (const std::string& path : {options.out, options.report})
    if (!path.empty()) {
      require_no_input(options, path);
      io::require_writable(path);
    }
  require_writable(options.request.programs);
  if (options.out.empty() || options.report.empty()) return;
  if (place(options.out) == place(options.report))
    throw std::invalid_argument("-o and --report cannot both be " +
                                options.out);
}

void write_report(const ReconstructOptions& options, const Outcome& outcome,
                  const Seconds& wall_clock) {
  if (options.report.empty()) return;
  io::write_file(options.report,
                 report::text(complete(options.request, outcome, wall_clock)));
}

void print_summary(const ReconstructOptions& options, const Outcome& outcome,
                   double total_seconds) {
  const bool stdout_is_taken = options.out == "-" || options.report == "-";
  std::ostream& out = stdout_is_taken ? std::cerr : std::cout;
  std::array<char, 32> seconds;
  std::snprintf(seconds.data(), seconds.size(), "%.2f", total_seconds);
  out << joined(options.request.files) << ": "
      << outcome.report["input"]["points"] << " points, " << outcome.summary
      << ", "
      << terminal::verdict(outcome.state, outcome.sound, options.color,
                           stdout_is_taken ? 2 : 1)
      << " (" << seconds.data() << " s)\n";
}

}  // namespace command
