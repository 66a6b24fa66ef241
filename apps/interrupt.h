/// @file
/// Ctrl-C as a request to come to an end.
#pragma once

#include <signal.h>

#include <atomic>

namespace terminal {

/// While it lives, the first SIGINT sets a flag, and the next one ends the
/// process as usual. A process that was started with SIGINT ignored goes on
/// ignoring it. At most one object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& flag();

 private:
  struct sigaction before_ = {};
};

}  // namespace terminal
