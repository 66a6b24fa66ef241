/// @file
/// What a 3D construction did; counted in builds with -DDELAUNAY_COUNTERS=ON.
#pragma once

#include <cstdint>

#include "delaunay/counters_config.h"  // kCounting, from the build's options

namespace delaunay {

struct Counters {
  std::uint64_t sphere_tests = 0;  ///< distances from cached centres
  std::uint64_t exact_tests = 0;   ///< of them left to exact predicates
  std::uint64_t walk_steps = 0;
  std::uint64_t cells_made = 0;

  Counters& operator+=(const Counters& other) {
    sphere_tests += other.sphere_tests;
    exact_tests += other.exact_tests;
    walk_steps += other.walk_steps;
    cells_made += other.cells_made;
    return *this;
  }
};

/// Without counting, the code for it vanishes.
inline void count(std::uint64_t& counter, std::uint64_t n = 1) {
  if constexpr (kCounting) counter += n;
}

}  // namespace delaunay
