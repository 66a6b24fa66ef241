/// @file
/// The shortest closed curve through all vertices of a sparse graph: for dense
/// samples of one benign closed curve it is the curve [Giesen99, Thm 2].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace umbrella {

struct TourEdge {
  std::array<std::uint32_t, 2> ends;  ///< different
  double length = 0;                  ///< finite, not negative
  bool required = false;              ///< the tour has to use it
};

enum class TourStatus {
  Optimal,     ///< none is shorter, up to the rounding of the sums
  Feasible,    ///< a tour, but the search was cut short
  Infeasible,  ///< there is no tour
  Limit        ///< none found in time
};

struct TourOptions {
  /// Spanning trees that may be built, of about 3 n log n steps each: a measure
  /// of effort that is the same on every run.
  std::uint64_t trees = 20'000;
};

struct TourResult {
  TourStatus status = TourStatus::Limit;
  std::vector<std::uint32_t> edges;  ///< of the tour, ascending; or empty
  double length = 0;                 ///< of the tour
  double bound = 0;                  ///< no tour is shorter
};

/// Branch and bound on the spanning-tree bound of [Held71], which is that of
/// the linear program with all subtour cuts [Althaus00].
///
/// @param edges  distinct; ends below n_vertices, which is 3 at least
/// @param start  a tour to begin with, as indices into edges; or none
TourResult shortest_tour(std::size_t n_vertices,
                         std::span<const TourEdge> edges,
                         std::span<const std::uint32_t> start = {},
                         const TourOptions& options = {});

}  // namespace umbrella
