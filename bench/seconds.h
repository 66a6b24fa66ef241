/// @file
/// How long a construction takes, measured alike for ours and for a peer.
#pragma once

#include <cstddef>

namespace bench {

/// `user`: the processor's seconds in this process, all threads together.
/// `wall`: what passed, with what the system spent on the process. They part
/// where memory is touched for the first time: the system clears its pages,
/// and a virtual machine may first have to get them from its host, which takes
/// as long as the construction or no time, as the machine was used before.
struct Seconds {
  double user = 0;
  double wall = 0;

  Seconds& operator+=(const Seconds& other);
  friend Seconds operator-(const Seconds& a, const Seconds& b) {
    return {a.user - b.user, a.wall - b.wall};
  }
  friend Seconds operator/(const Seconds& a, double b) {
    return {a.user / b, a.wall / b};
  }
};

/// Since some fixed time.
Seconds now();

/// Mean of as many constructions as take 0.3 user seconds together, and one at
/// least: the system counts user seconds in ticks of some milliseconds.
///
/// @param construct  returns what it makes; taking that down is not measured
/// @param look       is called with it, and not measured
template <class Construct, class Look>
Seconds seconds_of(const Construct& construct, const Look& look) {
  static constexpr double kLeast = 0.3;
  Seconds sum;
  std::size_t n_runs = 0;
  while (sum.user < kLeast) {
    const Seconds start = now();
    const auto made = construct();
    sum += now() - start;
    ++n_runs;
    look(made);
  }
  return sum / static_cast<double>(n_runs);
}

}  // namespace bench
