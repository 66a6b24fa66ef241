/// @file
/// Closing the holes by a 0/1 program over the Delaunay triangles of each
/// region [Adamy02, Sec. 3.2].
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/holes.h"
#include "umbrella/triangle.h"

namespace ilp {
struct LinearForm;
enum class Status;
}  // namespace ilp

namespace umbrella {

enum class CloseMode {
  Best,  ///< worst triangles switched off first; cuts, growing, dropping
  Paper  ///< any solution of the inequalities as printed; no growing
};

/// What makes a triangle the worse in CloseMode::Best: the larger, the worse.
enum class CloseWeight {
  BallOverlap,  ///< how deep the circumballs of its two cells cut each other
  Circumradius,
  LambdaLower,
  Area
};

struct ClosingOptions {
  CloseMode mode = CloseMode::Best;
  CloseWeight weight = CloseWeight::BallOverlap;
  /// Effort for each region and all that it grows to: so many conflicts, and
  /// so many propagations, with more for each vertex. The same on every run.
  /// Each program may take half of what is left.
  std::uint64_t conflicts = 10'000;
  std::uint64_t propagations = 2'000'000;
  std::uint64_t propagations_per_vertex = 150;
  /// Conflicts of a first search, which knows less of the program. It makes no
  /// difference to a result that is within the limits.
  std::uint64_t short_search = 100;
  /// Wall clock for all regions together; a limit that is hit makes the
  /// result depend on the machine.
  double seconds = std::numeric_limits<double>::infinity();
  /// The closing ends soon after this becomes true; may be set by any thread or
  /// by a signal handler. Regions open by then count as undecided.
  const std::atomic<bool>* stop = nullptr;
  /// Closed pieces of at most max(piece_triangles, piece_part * 2 n) triangles
  /// are cut off as long as some other solution exists.
  std::size_t piece_triangles = 12;
  double piece_part = 0.02;
  /// Likewise those of at most joined_part * 2 m triangles, m being the points
  /// that hang together with theirs: by Delaunay edges at most twice as long as
  /// some edge of the cleaned triangles at either end.
  double joined_part = 0.4;
  /// Once the surface is closed, handles that a loop of at most so many edges
  /// goes round are removed where a surface through the same points has none,
  /// if the closing may have made one: not in tubes, which have four such loops
  /// or more. Where some are, loops of up to twice as many edges count as well,
  /// and in the end some of up to four times as many, those of tubes with them.
  /// 0 to keep all.
  unsigned handle_edges = 5;
  /// Before that, flat faces with holes that were lost are put in, where there
  /// is a surface with them; see docs/decisions/flat_faces.md.
  bool regain_faces = true;
  /// Then flat lids are taken off two ends of a bore if else their rims would
  /// hold points for no reason; see docs/decisions/bores.md.
  bool open_bores = true;
  /// Regions are solved on so many threads, with the same result for any
  /// number; what has no solution as it is grows on one.
  unsigned threads = 1;
  /// Whether points may be left out where nothing else helps. Then the surface
  /// is closed whatever happens, in the end by cell_labels.h.
  bool drop_points = true;
  /// Called now and then by the thread that closes, with how many regions are
  /// done with and how many there are: never with less than before, and at last
  /// with all of them, if there are any.
  std::function<void(std::size_t, std::size_t)> on_progress = {};
  /// Called after each search, always in the same order, with its program and
  /// whether that has a solution. The program holds the inequalities (2) to (5)
  /// of [Adamy02, Def. 3.3], those of (6) that the search has needed, and all
  /// cuts. While it is set, `threads` counts for nothing.
  std::function<void(const ilp::LinearForm&, ilp::Status)> on_program = {};
};

/// Why a point is not on the surface.
enum class DropReason {
  NoSolution,  ///< the programs around it have none with all points
  Limit        ///< not known: a limit came first
};

struct ClosingReport {
  std::size_t regions = 0;
  std::size_t largest_region_vertices = 0;
  std::size_t candidate_triangles = 0;
  std::size_t variables = 0;
  std::size_t feasible = 0;        ///< regions closed
  std::size_t infeasible = 0;      ///< regions without, as far as they may grow
  std::size_t undecided = 0;       ///< regions given up at a limit
  std::size_t grown = 0;           ///< regions closed after growing
  std::size_t labelled = 0;        ///< of those given up, closed by cell labels
  std::size_t faces_regained = 0;  ///< flat ones
  std::size_t pieces_joined = 0;   ///< to others, once all was closed
  std::size_t brought_in = 0;      ///< points that had been left out
  std::size_t handles_removed = 0;
  std::size_t bores_opened = 0;
  /// Of all programs, those about lost faces, the local repair and the bores
  /// included.
  std::uint64_t conflicts = 0;
  /// All that was taken off efforts for these; what making a program costs
  /// counts for some.
  std::uint64_t propagations = 0;
  bool timed_out = false;  ///< the wall clock cut a search short
};

struct ClosingResult {
  std::vector<LocatedTriangle> triangles;  ///< by ascending corners
  std::vector<VertexId> dropped;           ///< left out to close, ascending
  std::vector<DropReason> reasons;         ///< of dropped
  ClosingReport report;
};

/// @param triangulation  whose triangles `cleaned` are; below dimension 3 it
///   has none, and all holes count as infeasible
/// @param cleaned  what the clean-up has left
/// @param holes  of `cleaned`; none may be missing
ClosingResult close_holes(const delaunay::Triangulation3& triangulation,
                          std::span<const RankedTriangle> cleaned,
                          std::span<const Hole> holes,
                          const ClosingOptions& options = {});

}  // namespace umbrella
