#include "bench/seconds.h"

#include <sys/resource.h>

#include <chrono>

namespace bench {

Seconds& Seconds::operator+=(const Seconds& other) {
  user += other.user;
  wall += other.wall;
  return *this;
}

Seconds now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::chrono::duration<double> wall =
      std::chrono::steady_clock::now().time_since_epoch();
  return {static_cast<double>(usage.ru_utime.tv_sec) +
              1e-6 * static_cast<double>(usage.ru_utime.tv_usec),
          wall.count()};
}

}  // namespace bench
