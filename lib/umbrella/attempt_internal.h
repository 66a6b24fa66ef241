/// @file
/// What is asked of one program, what it may take, and what came of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/closing.h"
#include "umbrella/pieces_internal.h"

namespace umbrella {

enum class Outcome : std::uint8_t {
  Solved,
  Banned,      ///< only with a small closed piece
  Infeasible,  ///< not at all
  Undecided    ///< a limit was hit
};

struct Attempt {
  Outcome outcome = Outcome::Undecided;
  std::size_t n_candidates = 0;
  std::size_t n_variables = 0;
  /// Candidates of the solution, or of the last one that was banned.
  std::vector<LocatedTriangle> chosen;
  std::vector<TriangleIndex> freed;  ///< candidates that stood there before
  std::vector<VertexId> vertices;    ///< of the program
  std::vector<VertexId> dropped;     ///< left without triangles
  std::vector<VertexId> stuck;       ///< of the contradiction, if there is one
  std::vector<Piece> pieces;         ///< those that were cut off
  bool has_waited = false;           ///< PieceFinder::has_waited, if solved
};

/// What is left of what some programs may take in all.
struct Effort {
  std::uint64_t conflicts = 0;
  std::uint64_t propagations = 0;

  bool is_spent() const { return propagations == 0; }
  void charge(std::uint64_t conflicts_taken, std::uint64_t propagations_taken) {
    conflicts -= std::min(conflicts, conflicts_taken);
    propagations -= std::min(propagations, propagations_taken);
  }
  /// Lets `use` have so much of it at most, and takes off what it took.
  /// @return what `use` does
  template <class Use>
  auto lend(std::uint64_t most_conflicts, std::uint64_t most_propagations,
            Use&& use) {
    const Effort before = {std::min(conflicts, most_conflicts),
                           std::min(propagations, most_propagations)};
    Effort lent = before;
    auto result = std::forward<Use>(use)(lent);
    charge(before.conflicts - lent.conflicts,
           before.propagations - lent.propagations);
    return result;
  }
};

/// What programs have taken.
struct Spent {
  std::uint64_t conflicts = 0;
  std::uint64_t propagations = 0;  ///< with what else is taken off an effort
  bool is_timed_out = false;       ///< the clock cut a search short
};

/// What programs about single places of a closed surface may take.
struct LocalEffort {
  Effort all;
  std::uint64_t conflicts_of_each;
};

/// As much as three regions together, one of them as much as the tenth of a
/// region: of the 429 programs that remove handles from the real sets none
/// takes more than 450 conflicts, and a program has half of what it is lent.
/// @param n_regions  of so many with all points the propagations
inline LocalEffort local_effort(const ClosingOptions& options,
                                std::size_t n_points, std::uint64_t n_regions) {
  return {{3 * options.conflicts,
           n_regions * (options.propagations +
                        options.propagations_per_vertex * n_points)},
          options.conflicts / 10};
}

/// V - E + F = V - F / 2 is 2 for each component less 2 for each handle.
inline constexpr std::size_t kTrianglesOfHandle = 4;

struct AttemptOptions {
  /// Vertices that may stay bare; ascending.
  std::span<const VertexId> may_drop = {};
  /// Whether a solution that leaves some bare is one. If not, all that stand
  /// in its way are named as stuck.
  bool accept_drops = true;
  /// Small closed pieces that may be.
  std::span<const Piece> allowed = {};
  /// At least so many triangles fewer than there are.
  std::size_t fewer_triangles = 0;
  /// No candidate of the solution has corners among these and among others;
  /// ascending.
  std::span<const VertexId> part = {};
  /// Whether there is a solution most often. If not, the sides are worth their
  /// price at once: without a solution they mostly show that without a search.
  bool is_likely = true;
};

}  // namespace umbrella
