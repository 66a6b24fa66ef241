/// @file
/// Resident memory of this process, where the system tells.
#pragma once

namespace bench {

/// In MB; 0 where the system does not tell.
double resident_memory();

/// The largest since the last call of reset_peak_memory(), in MB.
double peak_memory();
void reset_peak_memory();

}  // namespace bench
