/// @file
/// One region, one program: the best surface through it, or why there is none.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "ilp/solver.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/badness_internal.h"
#include "umbrella/closing.h"
#include "umbrella/closing_program_internal.h"
#include "umbrella/pieces_internal.h"
#include "umbrella/point_groups_internal.h"
#include "umbrella/region_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

class RegionSolver {
 public:
  /// @param triangulation, options, surface, is_open, groups  must outlive
  ///   this object; surface and is_open may change between calls, groups may
  ///   be shared by several threads
  RegionSolver(const delaunay::Triangulation3& triangulation,
               const ClosingOptions& options, const WorkingSurface& surface,
               const std::vector<bool>& is_open, PointGroups& groups);

  /// @param effort  half of it may be taken, and is taken off
  Attempt attempt(const Region& region, Effort& effort,
                  const AttemptOptions& how = {});

  /// A region with its candidates.
  struct Proposal {
    const Region& region;
    std::vector<LocatedTriangle> candidates;
  };
  /// @pre the candidates are the last ones asked for
  Attempt attempt(Proposal proposal, Effort& effort, const AttemptOptions& how);
  std::vector<LocatedTriangle> candidates(const Region& region) {
    return neighborhoods_.candidates(region);
  }

  /// Whether it would close a small piece, on the surface as it is now. May say
  /// so of a solved attempt that has waited, once other regions are done with.
  bool closes_fragment(const Attempt& solved);

  /// PieceFinder::n_pieces_added, by a solved attempt.
  /// @param effort  the walks are taken off
  std::ptrdiff_t n_pieces_added(const Attempt& solved, Effort& effort);

  /// PieceFinder::is_one_piece.
  bool is_one_piece() { return piece_finder_.is_one_piece(); }

  double seconds_left() const;
  /// Whether the clock or the caller says so. Then attempts find nothing.
  bool is_over() const {
    return (options_.stop != nullptr && *options_.stop) ||
           (std::isfinite(options_.seconds) && seconds_left() <= 0);
  }

  Neighborhoods& neighborhoods() { return neighborhoods_; }
  std::uint64_t conflicts() const { return conflicts_; }
  /// With what else is taken off an effort.
  std::uint64_t propagations() const { return propagations_; }
  /// Whether options.seconds cut a search short.
  bool is_timed_out() const { return is_timed_out_; }
  Spent spent() const { return {conflicts_, propagations_, is_timed_out_}; }

 private:
  struct Work;  // one attempt

  std::optional<Attempt> too_late_for(std::size_t n_candidates);

  /// @pre the cells of the candidates are the last ones collected
  void add_sides(Work& work) const;
  void make_solver(Work& work) const;
  static Change change_of(const Attempt& attempt) {
    return {attempt.freed, attempt.chosen, attempt.vertices};
  }
  bool solve_in_order(Work& work);
  bool is_refuted(Work& work) const;
  void order_worst_first(Work& work) const;
  bool settle_dropped(Work& work, const AttemptOptions& how);
  bool release_stuck(Work& work, std::vector<ilp::Literal>& kept);
  void search(Work& work);
  ilp::Status solve(Work& work);
  static std::vector<VertexId> bare_vertices(const Work& work);
  bool read_model(Work& work);
  void cut(Work& work, std::span<const Piece> pieces);
  bool is_fragment(const Piece& piece);
  ilp::Limits limits(const Work& work) const;
  void charge(Effort& effort, const Effort& taken);
  void note(Work& work, ilp::Status status);
  void note_limit();
  void tell(Work& work);

  const ClosingOptions& options_;
  const WorkingSurface& surface_;
  const std::vector<bool>& is_open_;
  Neighborhoods neighborhoods_;
  Badness badness_;
  PointGroups& groups_;
  VertexNumbers numbers_;  // scratch
  std::size_t small_piece_;
  PieceFinder piece_finder_;
  std::uint64_t conflicts_ = 0;
  std::uint64_t propagations_ = 0;
  bool is_timed_out_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace umbrella
