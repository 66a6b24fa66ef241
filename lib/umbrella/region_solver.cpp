#include <algorithm>
#include <utility>

#include "ilp/improve.h"
#include "ilp/linear_form.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/rooms_internal.h"

namespace umbrella {
namespace {

/// What making a program costs, in propagations: 6 us a variable where one
/// propagation takes about 1 us (a region of 22000 vertices of a noisy scan).
constexpr std::uint64_t kStepsPerVariable = 6;

/// Likewise in seconds, at the least: of 4 million variables 10 s, with what
/// the solver makes of them.
constexpr double kSecondsPerVariable = 2e-6;

/// Vertices of a walk over the surface that take as long as one propagation:
/// 0.14 us each (a lattice of 30000 points).
constexpr std::uint64_t kWalkStepsOfPropagation = 8;

/// Of the triangles of a surface through n points, but for a few.
std::size_t part_of(double part, std::size_t n) {
  return static_cast<std::size_t>(part * 2 * static_cast<double>(n));
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
  ilp::Solver solver{ilp::Problem()};  // of the program, once it is asked
  std::vector<std::vector<ilp::Literal>> added;  // clauses, to the program
  ilp::Status status = ilp::Status::Limit;       // of the program with these
  std::span<const Piece> allowed;
  Effort effort;  // for this attempt
  std::vector<ilp::VarId> worst_first;
  ilp::Model model;
  Attempt result;

  Work(std::vector<LocatedTriangle> candidates_found, ClosingProgram made)
      : candidates(std::move(candidates_found)), program(std::move(made)) {
    result.n_candidates = candidates.size();
    result.n_variables = program.problem().n_variables();
    result.vertices.assign(program.vertices().begin(),
                           program.vertices().end());
    result.freed.assign(program.freed().begin(), program.freed().end());
  }

  void add_clause(std::vector<ilp::Literal> clause) {
    solver.add_clause(clause);
    added.push_back(std::move(clause));
  }
};

RegionSolver::RegionSolver(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           const WorkingSurface& surface,
                           const std::vector<bool>& is_open,
                           PointGroups& groups)
    : options_(options),
      surface_(surface),
      is_open_(is_open),
      neighborhoods_(triangulation, surface),
      badness_(triangulation, options.weight),
      groups_(groups),
      numbers_(surface.n_vertices()),
      small_piece_(std::max(options.piece_triangles,
                            part_of(options.piece_part, surface.n_vertices()))),
      piece_finder_(surface,
                    std::max(small_piece_, part_of(options.joined_part,
                                                   surface.n_vertices()))),
      start_(std::chrono::steady_clock::now()) {}

Attempt RegionSolver::attempt(const Region& region, Effort& effort,
                              const AttemptOptions& how) {
  if (is_over()) {
    note_limit();
    return {};
  }
  return attempt({region, candidates(region)}, effort, how);
}

/// Whether the time is too short for a program. It is not begun then, so that
/// the limit is kept. @return Undecided if so
std::optional<Attempt> RegionSolver::too_late_for(std::size_t n_candidates) {
  const double least = kSecondsPerVariable * static_cast<double>(n_candidates);
  const bool is_late =
      std::isfinite(options_.seconds) && seconds_left() < least;
  if (!is_late && !is_over()) return {};
  is_timed_out_ = is_timed_out_ || is_late;
  Attempt undecided;
  undecided.n_candidates = n_candidates;
  return undecided;
}

Attempt RegionSolver::attempt(Proposal proposal, Effort& effort,
                              const AttemptOptions& how) {
  const std::vector<LocatedTriangle>& candidates = proposal.candidates;
  if (auto undecided = too_late_for(candidates.size()))
    return std::move(*undecided);
  ClosingProgram program(
      surface_,
      {candidates, vertices_of(proposal.region, candidates), how.may_drop},
      numbers_);
  if (how.fewer_triangles > 0) program.demand_fewer(how.fewer_triangles);
  if (!how.part.empty()) program.set_apart(how.part);
  Work work(std::move(proposal.candidates), std::move(program));
  work.allowed = how.allowed;
  work.effort = {effort.conflicts / 2, effort.propagations / 2};
  if (!(how.is_likely && solve_in_order(work)) && !is_over()) {
    conflicts_ += work.solver.statistics().conflicts;
    add_sides(work);
    if (work.worst_first.empty() && !is_refuted(work)) order_worst_first(work);
    if (settle_dropped(work, how)) search(work);
  }
  if (work.result.outcome == Outcome::Undecided) note_limit();
  const ilp::Statistics used = work.solver.statistics();
  conflicts_ += used.conflicts;
  charge(effort,
         {used.conflicts,
          used.propagations + kStepsPerVariable * work.result.n_variables});
  if (options_.on_program) tell(work);
  return std::move(work.result);
}

/// Most programs give way to a short search in order, without the sides, which
/// take as long to find. These follow from the rest, so the least model is the
/// same; what the search takes in vain is not charged.
///
/// @return whether that solved it; if not, the result is as before
bool RegionSolver::solve_in_order(Work& work) {
  if (options_.mode == CloseMode::Paper || !work.program.droppable().empty())
    return false;
  make_solver(work);
  if (is_over() || is_refuted(work)) return false;
  order_worst_first(work);
  work.solver.set_priority(work.worst_first);
  work.solver.set_branching(ilp::Branching::Static);
  do {
    ilp::Limits few = limits(work);
    const std::uint64_t used = work.solver.statistics().conflicts;
    few.conflicts =
        std::min(few.conflicts,
                 options_.short_search - std::min(used, options_.short_search));
    work.status = work.solver.solve({}, few);
    if (work.status != ilp::Status::Feasible) {
      work.result.pieces.clear();
      work.added.clear();
      return false;
    }
    work.model = work.solver.model();
  } while (!read_model(work));
  work.result.outcome = Outcome::Solved;
  return true;
}

/// Before any decision.
bool RegionSolver::is_refuted(Work& work) const {
  return work.solver.solve({}, {.propagations = 0}) == ilp::Status::Infeasible;
}

bool RegionSolver::closes_fragment(const Attempt& solved) {
  if (options_.mode == CloseMode::Paper) return false;
  const std::vector<Piece> pieces =
      piece_finder_.find(change_of(solved), is_open_);
  return std::any_of(pieces.begin(), pieces.end(),
                     [this](const Piece& piece) { return is_fragment(piece); });
}

std::ptrdiff_t RegionSolver::n_pieces_added(const Attempt& solved,
                                            Effort& effort) {
  const std::uint64_t before = piece_finder_.n_steps();
  const std::ptrdiff_t n = piece_finder_.n_pieces_added(change_of(solved));
  charge(effort,
         {0, (piece_finder_.n_steps() - before) / kWalkStepsOfPropagation});
  return n;
}

/// Starts anew, with a solver that knows inside from outside.
void RegionSolver::add_sides(Work& work) const {
  std::vector<LocatedTriangle> fixed;
  for (const TriangleIndex t : work.program.fixed())
    fixed.push_back(surface_.triangle(t));
  work.program.add_sides(walls_between_rooms(
      neighborhoods_.cells(),
      {work.candidates, fixed, work.program.vertices(), is_open_}));
  make_solver(work);
}

void RegionSolver::make_solver(Work& work) const {
  work.solver = ilp::Solver(work.program.problem());
  if (options_.on_program) work.solver.keep_cycles();
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

/// Leaving a vertex out is worse than any triangle. Starts with none left out,
/// and releases those that contradict each other until there is a solution.
/// Then one released vertex after another is asked for and settled for good; a
/// vertex that is hard to keep goes.
///
/// @return whether to go on; if not, the outcome is known
bool RegionSolver::settle_dropped(Work& work, const AttemptOptions& how) {
  constexpr std::uint64_t kConflictsOfVertex = 500;
  const auto droppable = work.program.droppable();
  if (droppable.empty()) return true;
  ilp::Solver& solver = work.solver;
  std::vector<ilp::Literal> kept;
  for (const auto& [vertex, is_dropped] : droppable)
    kept.emplace_back(is_dropped, false);
  if (!release_stuck(work, kept)) return false;
  if (kept.size() < droppable.size() && !how.accept_drops) {
    work.result.outcome = Outcome::Infeasible;
    return false;
  }
  std::vector<ilp::Literal> settled = kept;
  for (const auto& [vertex, is_dropped] : droppable) {
    const ilp::Literal keep(is_dropped, false);
    if (std::binary_search(kept.begin(), kept.end(), keep)) continue;
    settled.push_back(keep);
    if (!solver.model()[index(is_dropped)]) continue;
    ilp::Limits some = limits(work);
    some.conflicts = std::min(some.conflicts, kConflictsOfVertex);
    note(work, solver.solve(settled, some));
    if (work.status != ilp::Status::Feasible) settled.back() = !settled.back();
  }
  for (const ilp::Literal l : settled) work.add_clause({l});
  return true;
}

/// Takes from `kept`, ascending, what is in contradictions, until there is a
/// model. @return false if there is none found; then the outcome is set
bool RegionSolver::release_stuck(Work& work, std::vector<ilp::Literal>& kept) {
  Attempt& result = work.result;
  work.solver.set_priority(work.worst_first);
  while (true) {
    note(work, work.solver.solve(kept, limits(work)));
    if (work.status == ilp::Status::Feasible) return true;
    if (work.status == ilp::Status::Limit) return false;
    const ilp::Core core = work.solver.core();
    result.stuck = united(result.stuck, work.program.vertices_of(core));
    if (core.assumptions.empty()) {
      result.outcome = Outcome::Infeasible;
      return false;
    }
    std::erase_if(kept, [&](ilp::Literal l) {
      return std::binary_search(core.assumptions.begin(),
                                core.assumptions.end(), l);
    });
  }
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
      result.stuck =
          united(result.stuck, work.program.vertices_of(work.solver.core()));
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
    note(work, work.solver.solve({}, limits(work)));
    work.model = work.solver.model();
    return work.status;
  }
  ilp::Improvement best =
      ilp::minimize_worst_first(work.solver, work.worst_first, limits(work));
  work.model = std::move(best.model);
  note(work, best.status);
  if (best.status == ilp::Status::Feasible) note_limit();
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

  std::vector<Piece> banned = piece_finder_.find(change_of(result), is_open_);
  std::erase_if(banned, [&](const Piece& piece) {
    return is_among(piece, work.allowed) || !is_fragment(piece);
  });
  result.has_waited = piece_finder_.has_waited();
  cut(work, banned);
  return banned.empty();
}

/// Asks for triangles that lead out of the pieces. These share no vertex, so
/// one look at the candidates serves for all.
void RegionSolver::cut(Work& work, std::span<const Piece> pieces) {
  if (pieces.empty()) return;
  std::vector<VertexId> inside;
  std::vector<std::uint32_t> piece_of;  // by vertex inside
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    const std::vector<VertexId>& more = pieces[p].vertices;
    inside.insert(inside.end(), more.begin(), more.end());
    piece_of.insert(piece_of.end(), more.size(), p);
  }
  numbers_.assign(inside);
  const auto place = [&](VertexId v) {
    return numbers_.contains(v) ? piece_of[numbers_[v]]
                                : static_cast<std::uint32_t>(pieces.size());
  };
  std::vector<std::vector<ilp::Literal>> clauses(pieces.size() + 1);
  for (std::uint32_t i = 0; i < work.candidates.size(); ++i) {
    const auto& [a, b, c] = work.candidates[i].corners;
    const std::uint32_t p = place(a), q = place(b), r = place(c);
    if (p == q && q == r) continue;
    const ilp::Literal leads_out(ilp::VarId{i}, true);
    clauses[p].push_back(leads_out);
    if (q != p) clauses[q].push_back(leads_out);
    if (r != p && r != q) clauses[r].push_back(leads_out);
  }
  clauses.pop_back();  // of vertices in no piece
  for (auto& clause : clauses) work.add_clause(std::move(clause));
  auto& all = work.result.pieces;
  all.insert(all.end(), pieces.begin(), pieces.end());
}

/// Whether the piece is so small a part of all points, or of those that hang
/// together with its own, that it should not be one.
bool RegionSolver::is_fragment(const Piece& piece) {
  return piece.n_triangles <= small_piece_ ||
         piece.n_triangles <=
             part_of(options_.joined_part,
                     groups_.n_points_with(piece.all_vertices));
}

void RegionSolver::charge(Effort& effort, const Effort& taken) {
  effort.charge(taken.conflicts, taken.propagations);
  propagations_ += taken.propagations;
}

/// What was found out, and whether the clock came first.
void RegionSolver::note(Work& work, ilp::Status status) {
  work.status = status;
  if (status == ilp::Status::Limit) note_limit();
}

void RegionSolver::note_limit() {
  if (seconds_left() <= 0) is_timed_out_ = true;
}

/// What was found under assumptions is found again without, so that the cycles
/// behind it are known.
void RegionSolver::tell(Work& work) {
  if (work.result.outcome == Outcome::Infeasible &&
      work.status != ilp::Status::Infeasible) {
    for (const auto& [vertex, is_dropped] : work.program.droppable())
      work.add_clause({ilp::Literal(is_dropped, false)});
    work.status = work.solver.solve({}, limits(work));
  }
  ilp::Problem problem = work.program.problem();
  for (const auto& clause : work.added) problem.add_clause(clause);
  if (work.status == ilp::Status::Optimal) work.status = ilp::Status::Feasible;
  options_.on_program(linear_form(problem, work.solver.cycles()), work.status);
}

double RegionSolver::seconds_left() const {
  const std::chrono::duration<double> spent =
      std::chrono::steady_clock::now() - start_;
  return options_.seconds - spent.count();
}

/// What the attempt may still take.
ilp::Limits RegionSolver::limits(const Work& work) const {
  const ilp::Statistics used = work.solver.statistics();
  Effort left = work.effort;
  left.charge(used.conflicts, used.propagations);
  ilp::Limits limits;
  limits.conflicts = left.conflicts;
  limits.propagations = left.propagations;
  limits.seconds = std::max(0.0, seconds_left());
  limits.stop = options_.stop;
  return limits;
}

}  // namespace umbrella
