/// @file
/// What `umbrella reconstruct` and `umbrella repair` do once their options are
/// known.
#pragma once

#include "apps/command.h"
#include "apps/reconstruct_options.h"

namespace command {

/// Reads, reconstructs, writes and prints the summary.
ExitCode run_reconstruct(const ReconstructOptions& options);

}  // namespace command
