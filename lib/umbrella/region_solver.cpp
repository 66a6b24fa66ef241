#include <algorithm>
#include <utility>

#include "ilp/improve.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/rooms_internal.h"

namespace umbrella {
namespace {

std::size_t largest_piece(const ClosingOptions& options, std::size_t n) {
  const double part = options.piece_part * 2 * static_cast<double>(n);
  return std::max(options.piece_triangles, static_cast<std::size_t>(part));
}

bool is_among(const Piece& piece, std::span<const Piece> pieces) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const Piece& p) {
    return p.vertices == piece.vertices;
  });
}

}  // namespace

struct RegionSolver::Work {
  std::vector<LocatedTriangle> candidates;
  ClosingProgram program;
  ilp::Solver solver;
  std::span<const Piece> allowed;
  std::vector<ilp::VarId> worst_first;
  ilp::Model model;
  Attempt result;

  Work(std::vector<LocatedTriangle> candidates_found, ClosingProgram made)
      : candidates(std::move(candidates_found)),
        program(std::move(made)),
        solver(program.problem()) {
    result.n_candidates = candidates.size();
    result.n_variables = program.problem().n_variables();
    result.vertices.assign(program.vertices().begin(),
                           program.vertices().end());
    result.freed.assign(program.freed().begin(), program.freed().end());
  }
};

RegionSolver::RegionSolver(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           const WorkingSurface& surface,
                           const std::vector<bool>& is_open)
    : options_(options),
      surface_(surface),
      is_open_(is_open),
      neighborhoods_(triangulation),
      badness_(triangulation, options.weight),
      piece_finder_(surface,
                    largest_piece(options, triangulation.points().size())),
      start_(std::chrono::steady_clock::now()) {}

Attempt RegionSolver::attempt(const Region& region,
                              std::span<const VertexId> may_drop,
                              std::span<const Piece> allowed) {
  std::vector<LocatedTriangle> candidates = neighborhoods_.candidates(region);
  ClosingProgram program(surface_, candidates, region.vertices, may_drop);
  add_sides(program, candidates);
  Work work(std::move(candidates), std::move(program));
  work.allowed = allowed;
  order_worst_first(work);
  settle_dropped(work);
  search(work);
  conflicts_ += work.solver.statistics().conflicts;
  propagations_ += work.solver.statistics().propagations;
  return std::move(work.result);
}

std::vector<VertexId> RegionSolver::vertices(const Region& region) {
  std::vector<VertexId> result = region.vertices;
  for (const auto& c : neighborhoods_.candidates(region))
    result.insert(result.end(), c.corners.begin(), c.corners.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void RegionSolver::add_sides(
    ClosingProgram& program,
    std::span<const LocatedTriangle> candidates) const {
  std::vector<LocatedTriangle> fixed;
  for (const TriangleIndex t : program.fixed())
    fixed.push_back(surface_.triangle(t));
  program.add_sides(
      walls_between_rooms(neighborhoods_.cells(),
                          {candidates, fixed, program.vertices(), is_open_}));
}

void RegionSolver::order_worst_first(Work& work) const {
  const auto& candidates = work.candidates;
  std::vector<double> badness(candidates.size());
  std::vector<ilp::VarId> order(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    badness[i] = badness_(candidates[i].corners, candidates[i].facet);
    order[i] = ilp::VarId{static_cast<std::uint32_t>(i)};
  }
  std::sort(order.begin(), order.end(), [&](ilp::VarId a, ilp::VarId b) {
    const double bad_a = badness[index(a)], bad_b = badness[index(b)];
    return bad_a != bad_b ? bad_a > bad_b : a > b;
  });
  work.worst_first = std::move(order);
}

/// Leaving a vertex out is worse than any triangle: starting from any solution,
/// asks for one vertex after another that it leaves bare, and settles each for
/// good. A vertex that is hard to keep goes.
void RegionSolver::settle_dropped(Work& work) const {
  constexpr std::uint64_t kConflictsOfVertex = 500;
  if (work.program.droppable().empty()) return;
  ilp::Solver& solver = work.solver;
  solver.set_priority(work.worst_first);
  if (solver.solve({}, limits(solver)) != ilp::Status::Feasible) return;
  std::vector<ilp::Literal> settled;
  for (const auto& [vertex, is_dropped] : work.program.droppable()) {
    settled.emplace_back(is_dropped, false);
    if (!solver.model()[index(is_dropped)]) continue;
    ilp::Limits some = limits(solver);
    some.conflicts = std::min(some.conflicts, kConflictsOfVertex);
    if (solver.solve(settled, some) != ilp::Status::Feasible)
      settled.back() = !settled.back();
  }
  for (const ilp::Literal l : settled) solver.add_clause({&l, 1});
}

/// Solves and cuts off small closed pieces until there is none.
void RegionSolver::search(Work& work) {
  Attempt& result = work.result;
  while (true) {
    const ilp::Status status = solve(work);
    if (status == ilp::Status::Limit) {
      // The last model, if any, is kept: its pieces are what is wrong with it.
      if (!result.pieces.empty()) result.outcome = Outcome::Banned;
      return;
    }
    if (status == ilp::Status::Infeasible) {
      result.outcome =
          result.pieces.empty() ? Outcome::Infeasible : Outcome::Banned;
      result.stuck = work.program.vertices_of(work.solver.core());
      for (const Piece& piece : result.pieces)
        result.stuck = united(result.stuck, piece.vertices);
      return;
    }
    if (read_model(work)) {
      result.outcome = Outcome::Solved;
      return;
    }
  }
}

ilp::Status RegionSolver::solve(Work& work) {
  if (options_.mode == CloseMode::Paper) {
    const ilp::Status status = work.solver.solve({}, limits(work.solver));
    work.model = work.solver.model();
    return status;
  }
  ilp::Improvement best = ilp::minimize_worst_first(
      work.solver, work.worst_first, limits(work.solver));
  work.model = std::move(best.model);
  return best.status;
}

std::vector<VertexId> RegionSolver::bare_vertices(const Work& work) {
  std::vector<VertexId> used;
  for (const LocatedTriangle& t : work.result.chosen)
    used.insert(used.end(), t.corners.begin(), t.corners.end());
  std::sort(used.begin(), used.end());
  std::vector<VertexId> bare;
  for (const auto& [vertex, is_dropped] : work.program.droppable())
    if (!std::binary_search(used.begin(), used.end(), vertex))
      bare.push_back(vertex);
  return bare;
}

/// @return whether the model is good; otherwise cuts are added
bool RegionSolver::read_model(Work& work) {
  Attempt& result = work.result;
  result.chosen.clear();
  result.dropped.clear();
  for (std::size_t i = 0; i < work.candidates.size(); ++i)
    if (work.model[i]) result.chosen.push_back(work.candidates[i]);
  result.dropped = bare_vertices(work);
  if (options_.mode == CloseMode::Paper) return true;

  bool is_good = true;
  for (const Piece& piece : piece_finder_.find(
           {result.freed, result.chosen, result.vertices}, is_open_)) {
    if (is_among(piece, work.allowed)) continue;
    is_good = false;
    cut(work, piece);
  }
  return is_good;
}

/// Asks for a triangle that leads out of the piece.
void RegionSolver::cut(Work& work, const Piece& piece) {
  std::vector<ilp::Literal> clause;
  for (std::uint32_t i = 0; i < work.candidates.size(); ++i) {
    const auto& corners = work.candidates[i].corners;
    const auto inside =
        std::count_if(corners.begin(), corners.end(), [&](VertexId v) {
          return std::binary_search(piece.vertices.begin(),
                                    piece.vertices.end(), v);
        });
    if (inside == 1 || inside == 2) clause.emplace_back(ilp::VarId{i}, true);
  }
  work.solver.add_clause(clause);
  work.result.pieces.push_back(piece);
}

/// What one attempt may still take.
ilp::Limits RegionSolver::limits(const ilp::Solver& solver) const {
  const std::chrono::duration<double> spent =
      std::chrono::steady_clock::now() - start_;
  constexpr std::uint64_t kPart = 2;
  const auto left = [](std::uint64_t all, std::uint64_t used) {
    return all - std::min(all, used);
  };
  const ilp::Statistics used = solver.statistics();
  ilp::Limits limits;
  limits.conflicts =
      left(left(options_.conflicts, conflicts_) / kPart, used.conflicts);
  limits.propagations = left(left(options_.propagations, propagations_) / kPart,
                             used.propagations);
  limits.seconds = std::max(0.0, options_.seconds - spent.count());
  limits.stop = options_.stop;
  return limits;
}

}  // namespace umbrella
