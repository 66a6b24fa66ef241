#include "bench/memory.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace bench {
namespace {

/// A number of /proc/self/status, there in units of 1024 bytes.
double status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":"))
      return std::atof(line.c_str() + name.size() + 1) * 1024e-6;
  return 0;
}

}  // namespace

double resident_memory() { return status("VmRSS"); }

double peak_memory() { return status("VmHWM"); }

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

}  // namespace bench
