/// @file
/// A row of a table that compares ours with a peer.
#pragma once

#include <string>
#include <vector>

#include "bench/seconds.h"

namespace bench {

/// Seconds of both over several runs.
class Comparison {
 public:
  void add(const Seconds& ours, const Seconds& peer);

  /// Titles of the columns of row().
  static std::string header();
  /// User seconds of ours and of the peer and their ratio, then wall seconds:
  /// medians, the ratio's too.
  std::string row() const;

 private:
  struct Column {
    std::vector<double> ours, peer, ratio;
    void add(double our_seconds, double peer_seconds);
    std::string row() const;
  };
  Column user_, wall_;
};

}  // namespace bench
