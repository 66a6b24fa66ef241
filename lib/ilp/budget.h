/// @file
/// One budget for several calls of a solver.
#pragma once

#include <algorithm>
#include <chrono>

#include "ilp/solver.h"

namespace ilp {

/// The rest of the limits, call after call.
class Budget {
 public:
  Budget(const Solver& solver, const Limits& limits)
      : solver_(solver), limits_(limits), before_(solver.statistics()) {}

  Limits left() const {
    const Statistics now = solver_.statistics();
    const std::chrono::duration<double> seconds = Clock::now() - start_;
    return {limits_.conflicts - (now.conflicts - before_.conflicts),
            limits_.propagations -
                std::min(limits_.propagations,
                         now.propagations - before_.propagations),
            limits_.seconds - seconds.count(), limits_.stop};
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Solver& solver_;
  Limits limits_;
  Statistics before_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace ilp
