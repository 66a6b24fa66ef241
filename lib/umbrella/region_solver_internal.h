/// @file
/// One region, one program: the best surface through it, or why there is none.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "ilp/solver.h"
#include "umbrella/badness_internal.h"
#include "umbrella/closing.h"
#include "umbrella/closing_program_internal.h"
#include "umbrella/pieces_internal.h"
#include "umbrella/region_internal.h"
#include "umbrella/working_surface_internal.h"

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
  std::vector<LocatedTriangle> chosen;  ///< candidates of the solution
  std::vector<TriangleIndex> freed;     ///< candidates that stood there before
  std::vector<VertexId> vertices;       ///< of the program
  std::vector<VertexId> dropped;        ///< left without triangles
  std::vector<VertexId> stuck;  ///< of the contradiction, if there is one
  std::vector<Piece> pieces;    ///< those that were cut off
};

class RegionSolver {
 public:
  /// @param triangulation, options, surface, is_open  must outlive this
  ///   object; the last two may change between calls
  RegionSolver(const delaunay::Triangulation3& triangulation,
               const ClosingOptions& options, const WorkingSurface& surface,
               const std::vector<bool>& is_open);

  /// @param may_drop  vertices that may stay bare; ascending
  /// @param allowed  small closed pieces that may be
  Attempt attempt(const Region& region, std::span<const VertexId> may_drop = {},
                  std::span<const Piece> allowed = {});

  /// All vertices the program of the region would have; ascending.
  std::vector<VertexId> vertices(const Region& region);

  std::size_t n_candidates(const Region& region) {
    return neighborhoods_.candidates(region).size();
  }
  /// Whether nothing is left of the effort of all programs.
  bool is_spent() const {
    const bool is_stopped = options_.stop != nullptr && *options_.stop;
    return is_stopped || propagations_ >= options_.propagations;
  }
  void charge(std::uint64_t propagations) { propagations_ += propagations; }

  Neighborhoods& neighborhoods() { return neighborhoods_; }
  std::uint64_t conflicts() const { return conflicts_; }

 private:
  struct Work;  // one attempt

  /// @pre the cells of the candidates are the last ones collected
  void add_sides(ClosingProgram& program,
                 std::span<const LocatedTriangle> candidates) const;
  void order_worst_first(Work& work) const;
  void settle_dropped(Work& work) const;
  void search(Work& work);
  ilp::Status solve(Work& work);
  static std::vector<VertexId> bare_vertices(const Work& work);
  bool read_model(Work& work);
  void cut(Work& work, const Piece& piece);
  ilp::Limits limits(const ilp::Solver& solver) const;

  const ClosingOptions& options_;
  const WorkingSurface& surface_;
  const std::vector<bool>& is_open_;
  Neighborhoods neighborhoods_;
  Badness badness_;
  PieceFinder piece_finder_;
  std::uint64_t conflicts_ = 0;
  std::uint64_t propagations_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace umbrella
