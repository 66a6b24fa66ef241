#include "apps/reconstruct_outputs.h"

#include <sys/resource.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "apps/paths.h"
#include "apps/program_files.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "apps/viewer.h"
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

}  // namespace

void require_outputs(const ReconstructOptions& options) {
  const std::array outputs = {options.out, options.report, options.view};
  require_no_input(options.request.files, outputs);
  for (const std::string& path : outputs)
    if (!path.empty()) io::require_writable(path);
  require_different(outputs);
  require_apart(options.request.programs, outputs);
  require_apart(options.request.programs, options.request.files);
  require_writable(options.request.programs);
}

void write_report(const ReconstructOptions& options, const Outcome& outcome,
                  const Seconds& wall_clock) {
  if (options.report.empty()) return;
  io::write_file(options.report,
                 report::text(complete(options.request, outcome, wall_clock)));
}

void write_view(const ReconstructOptions& options, const Outcome& outcome) {
  if (options.view.empty()) return;
  std::span<const double> lambda;  // of edges it has no use
  if (!outcome.mesh.triangles.empty()) lambda = outcome.lambda;
  std::vector<std::string> names;
  for (const std::string& path : options.request.files)
    names.push_back(input_name(path));
  io::write_file(options.view,
                 viewer_page(joined(names), outcome.mesh, lambda));
}

void print_summary(const ReconstructOptions& options, const Outcome& outcome,
                   double total_seconds) {
  const bool stdout_is_taken =
      options.out == "-" || options.report == "-" || options.view == "-";
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
