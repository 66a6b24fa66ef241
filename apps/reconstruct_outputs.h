/// @file
/// The files and the summary that a reconstruction leaves.
#pragma once

#include "apps/outcome.h"
#include "apps/reconstruct_options.h"

namespace command {

/// @throws io::WriteError, std::invalid_argument  for what would fail only
///   after all the work, or spoil it: a file that cannot be written, that is
///   also an input, or that is named twice
void require_outputs(const ReconstructOptions& options);

/// Wall clock of what the stages do not count.
struct Seconds {
  double read, write, total;
};

/// The report file, if one is asked for.
void write_report(const ReconstructOptions& options, const Outcome& outcome,
                  const Seconds& wall_clock);

/// The page that shows the mesh, if one is asked for.
void write_view(const ReconstructOptions& options, const Outcome& outcome);

/// A line on standard output, or on standard error if that is taken.
void print_summary(const ReconstructOptions& options, const Outcome& outcome,
                   double total_seconds);

}  // namespace command
