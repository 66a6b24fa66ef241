// Each region is first solved as it is, on several threads: regions share no
// free triangle, but several of them may close a small piece together. So they
// are accepted one after another, and solved again where that shows.
// Those without a solution are then grown, one after another, around the
// constraints that contradict each other; points are left out last.
#include "umbrella/closing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "umbrella/bores_internal.h"
#include "umbrella/cell_labels.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/lost_faces_internal.h"
#include "umbrella/new_handles_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

void append(std::span<const VertexId> more, std::vector<VertexId>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

class Closing {
 public:
  Closing(const delaunay::Triangulation3& triangulation,
          std::span<const RankedTriangle> cleaned,
          const ClosingOptions& options)
      : options_(options),
        surface_(triangulation.points().size(), cleaned),
        is_open_(triangulation.points().size()),
        triangulation_(triangulation),
        groups_(triangulation, cleaned, surface_),
        solver_(triangulation, options, surface_, is_open_, groups_),
        is_undecided_(triangulation.points().size()) {}

  ClosingResult run(std::span<const Hole> holes);

 private:
  struct Banned {
    Region region;
    Attempt attempt;
    std::size_t n_regions;
  };

  /// A region that is still open.
  struct Task {
    Region region;  // as given, with those swallowed
    Attempt last;
    std::vector<VertexId> stuck;   // of all contradictions met
    std::optional<Banned> banned;  // first attempt that closed small pieces
    std::size_t n_regions = 1;     // with those swallowed
    Effort effort = {};
    bool has_hit_limit = false;
    // Of the smallest program that has hit a limit.
    std::size_t undecided = std::numeric_limits<std::size_t>::max();

    bool is_swallowed() const { return region.vertices.empty(); }
  };

  void solve_as_given(std::vector<Region> regions);
  std::vector<Attempt> attempts(std::span<const Region> regions,
                                std::vector<Effort>& efforts);
  Effort effort_for(const Region& region) const {
    return {options_.conflicts,
            options_.propagations +
                options_.propagations_per_vertex * region.vertices.size()};
  }
  void repair_all();
  void repair(Task task);
  void find_stuck(Task& task);
  bool grow(Task& task);
  bool attempt(Task& task, Region& region, bool accept_drops);
  void note(Task& task, const Region& region) const;
  bool allow_pieces(Task& task);
  bool drop_points(Task& task);
  std::vector<LocatedTriangle> swallow(Task& task, Region& region);
  void tell_progress(std::size_t n_done);
  void accept(const Attempt& solved);
  void give_up(const Task& task);
  bool label_cells();
  ClosingOptions options_for_rest() const;
  void count(const Spent& spent);
  bool regain_faces();
  bool repair_locally(bool is_labelled);
  void open_bores(bool has_changed);
  void list_dropped(std::vector<VertexId> dropped);

  const ClosingOptions& options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // vertices of regions not yet closed
  const delaunay::Triangulation3& triangulation_;
  PointGroups groups_;
  RegionSolver solver_;
  std::vector<Task> tasks_;  // regions that have no solution as given
  std::vector<std::uint32_t> task_of_;  // by vertex, while they are repaired
  std::vector<VertexId> dropped_;
  std::vector<bool> is_undecided_;  // vertices of regions given up at a limit
  bool is_cut_short_ = false;       // by the clock or the caller
  std::size_t n_told_ = 0;          // regions done with
  ClosingResult result_;
};

ClosingResult Closing::run(std::span<const Hole> holes) {
  solve_as_given(merge_holes(holes, surface_));
  if (options_.mode == CloseMode::Best) repair_all();
  for (const Task& task : tasks_) give_up(task);
  tell_progress(result_.report.regions);
  count(solver_.spent());
  result_.triangles = surface_.sorted();
  std::sort(dropped_.begin(), dropped_.end());
  if (options_.mode == CloseMode::Best && options_.drop_points) {
    const bool is_labelled = label_cells();
    const bool is_regained =
        options_.regain_faces && !is_labelled && regain_faces();
    const bool is_repaired = repair_locally(is_labelled || is_regained);
    if (options_.open_bores) open_bores(is_labelled || is_repaired);
    is_cut_short_ = solver_.is_over();
    result_.report.timed_out |= solver_.seconds_left() <= 0;
  }
  list_dropped(dropped_);
  return std::move(result_);
}

void Closing::solve_as_given(std::vector<Region> regions) {
  ClosingReport& report = result_.report;
  report.regions = regions.size();
  for (const Region& region : regions) {
    report.largest_region_vertices =
        std::max(report.largest_region_vertices, region.vertices.size());
    for (const VertexId v : region.vertices) is_open_[index(v)] = true;
  }
  std::vector<Effort> efforts;
  efforts.reserve(regions.size());
  for (const Region& region : regions) efforts.push_back(effort_for(region));
  std::vector<Attempt> first = attempts(regions, efforts);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    Attempt& attempt = first[i];
    report.candidate_triangles += attempt.n_candidates;
    report.variables += attempt.n_variables;
    if (attempt.outcome == Outcome::Solved && attempt.has_waited &&
        solver_.closes_fragment(attempt))
      attempt = solver_.attempt(regions[i], efforts[i]);
    if (attempt.outcome == Outcome::Solved) {
      accept(attempt);
      ++report.feasible;
    } else {
      tasks_.push_back(
          {std::move(regions[i]), std::move(attempt), {}, {}, 1, efforts[i]});
      note(tasks_.back(), tasks_.back().region);
    }
  }
}

/// Each region on the surface as it is now, whatever the others do: they share
/// no triangle but for the pieces that they close together.
std::vector<Attempt> Closing::attempts(std::span<const Region> regions,
                                       std::vector<Effort>& efforts) {
  std::vector<Attempt> result(regions.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<std::uint64_t> conflicts = 0;
  std::atomic<std::uint64_t> propagations = 0;
  std::atomic<bool> is_timed_out = false;
  std::atomic<std::size_t> n_solved = 0;
  const auto work = [&](RegionSolver& solver) {
    for (std::size_t i = next++; i < regions.size(); i = next++) {
      result[i] = solver.attempt(regions[i], efforts[i]);
      if (result[i].outcome == Outcome::Solved) ++n_solved;
      if (&solver == &solver_) tell_progress(n_solved);
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t n =
        options_.on_program
            ? 1
            : std::min<std::size_t>(options_.threads, regions.size());
    for (std::size_t k = 1; k < n; ++k)
      others.emplace_back([&] {
        RegionSolver solver(triangulation_, options_, surface_, is_open_,
                            groups_);
        work(solver);
        conflicts += solver.conflicts();
        propagations += solver.propagations();
        if (solver.is_timed_out()) is_timed_out = true;
      });
    work(solver_);
  }
  result_.report.conflicts = conflicts;
  result_.report.propagations = propagations;
  result_.report.timed_out = is_timed_out;
  return result;
}

/// Small ones come first, before a large one has taken most of the effort.
void Closing::repair_all() {
  std::reverse(tasks_.begin(), tasks_.end());
  std::stable_sort(tasks_.begin(), tasks_.end(),
                   [](const Task& a, const Task& b) {
                     return a.region.vertices.size() > b.region.vertices.size();
                   });
  task_of_.assign(surface_.n_vertices(),
                  std::numeric_limits<std::uint32_t>::max());
  for (std::uint32_t i = 0; i < tasks_.size(); ++i)
    for (const VertexId v : tasks_[i].region.vertices) task_of_[index(v)] = i;
  while (!tasks_.empty()) {
    Task task = std::move(tasks_.back());
    tasks_.pop_back();
    if (!task.is_swallowed()) repair(std::move(task));
  }
}

void Closing::repair(Task task) {
  ClosingReport& report = result_.report;
  find_stuck(task);
  if (grow(task) || allow_pieces(task) || drop_points(task))
    report.grown += task.n_regions;
  else
    give_up(task);
  tell_progress(report.feasible + report.grown + report.infeasible +
                report.undecided);
}

/// The first attempt at a region that closes a small piece may be in vain.
void Closing::tell_progress(std::size_t n_done) {
  if (!options_.on_progress || n_done <= n_told_) return;
  n_told_ = n_done;
  options_.on_progress(n_done, result_.report.regions);
}

void Closing::give_up(const Task& task) {
  (task.has_hit_limit ? result_.report.undecided : result_.report.infeasible) +=
      task.n_regions;
  if (task.has_hit_limit)
    for (const VertexId v : task.region.vertices)
      is_undecided_[index(v)] = true;
}

/// All contradictions of the region as it is, where the first attempt has met
/// only one.
void Closing::find_stuck(Task& task) {
  if (task.last.outcome != Outcome::Infeasible) return;
  const Attempt all = solver_.attempt(
      task.region, task.effort,
      {.may_drop = task.region.vertices, .accept_drops = false});
  task.stuck = united(task.stuck, all.stuck);
}

/// Around what contradicts itself: all Delaunay triangles with two corners
/// there, then with one; the same with a ring of vertices more; and again
/// around what contradicts itself then. Each program holds the last one, so one
/// that is not larger is the same.
bool Closing::grow(Task& task) {
  constexpr int kRounds = 6;
  Region region = task.region;
  for (int round = 0; round < kRounds && !task.stuck.empty(); ++round) {
    for (const unsigned reach : {2U, 1U, 3U}) {
      region.stuck = task.stuck;
      region.reach = reach;
      if (reach == 3)
        region.vertices =
            united(region.vertices, solver_.neighborhoods().ring(task.stuck));
      if (attempt(task, region, false)) return true;
      if (task.last.outcome == Outcome::Undecided) return false;
    }
  }
  return false;
}

/// Tries a region that holds task.region, and keeps what can be learned.
bool Closing::attempt(Task& task, Region& region, bool accept_drops) {
  if (task.effort.is_spent() || solver_.is_over()) {
    task.last.outcome = Outcome::Undecided;
    task.has_hit_limit = true;
    return false;
  }
  std::vector<LocatedTriangle> candidates = swallow(task, region);
  const std::size_t n_candidates = candidates.size();
  if (n_candidates >= task.undecided ||
      (!accept_drops && n_candidates == task.last.n_candidates))
    return false;
  task.last = solver_.attempt(
      {region, std::move(candidates)}, task.effort,
      {.may_drop = region.vertices, .accept_drops = accept_drops});
  if (task.last.outcome == Outcome::Solved) {
    accept(task.last);
    return true;
  }
  note(task, region);
  return false;
}

void Closing::note(Task& task, const Region& region) const {
  if (task.last.outcome == Outcome::Undecided) {
    task.has_hit_limit = true;
    task.undecided = std::min(task.undecided, task.last.n_candidates);
  }
  task.stuck = united(task.stuck, task.last.stuck);
  if (task.last.outcome == Outcome::Banned && !task.banned)
    task.banned = Banned{region, task.last, task.n_regions};
}

/// Open regions that the program would touch become part of it.
/// @return the candidates of what is the region then
std::vector<LocatedTriangle> Closing::swallow(Task& task, Region& region) {
  while (true) {
    std::vector<LocatedTriangle> candidates = solver_.candidates(region);
    const std::vector<VertexId> touched = vertices_of(region, candidates);
    std::vector<std::uint32_t> met;
    for (const VertexId v : touched)
      if (const std::uint32_t i = task_of_[index(v)];
          i < tasks_.size() && !tasks_[i].is_swallowed())
        met.push_back(i);
    if (met.empty()) return candidates;
    sort_unique(met);
    std::vector<VertexId> vertices, stuck;
    for (const std::uint32_t i : met) {
      const Task other = std::exchange(tasks_[i], {});
      append(other.region.vertices, vertices);
      append(other.stuck, stuck);
      task.n_regions += other.n_regions;
    }
    sort_unique(vertices);
    sort_unique(stuck);
    region.vertices = united(region.vertices, vertices);
    task.region.vertices = united(task.region.vertices, vertices);
    task.stuck = united(task.stuck, stuck);
  }
}

/// Lifts the ban on the largest small piece met, until there is a solution; at
/// a limit, on all.
bool Closing::allow_pieces(Task& task) {
  if (!task.banned) return false;
  Region region = task.banned->region;
  region.vertices = united(region.vertices, task.region.vertices);
  Attempt last = std::move(task.banned->attempt);
  bool is_current = task.banned->n_regions == task.n_regions;
  std::vector<Piece> allowed;
  while (last.outcome == Outcome::Banned &&
         (!is_current || !last.stuck.empty())) {
    allowed.push_back(*std::max_element(last.pieces.begin(), last.pieces.end(),
                                        [](const Piece& a, const Piece& b) {
                                          return a.n_triangles != b.n_triangles
                                                     ? a.n_triangles <
                                                           b.n_triangles
                                                     : a.vertices > b.vertices;
                                        }));
    last = solver_.attempt(region, task.effort, {.allowed = allowed});
    is_current = true;
  }
  if (last.outcome != Outcome::Solved && last.outcome != Outcome::Banned)
    return false;
  // Others may have been looked at since; what is made has to be the last.
  (void)solver_.closes_fragment(last);
  accept(last);
  return true;
}

/// Lets vertices stay bare that no fixed triangle needs, in a region that grows
/// around the contradictions.
bool Closing::drop_points(Task& task) {
  constexpr int kRounds = 4;
  if (!options_.drop_points) return false;
  task.effort = effort_for(task.region);
  Region region = task.region;
  for (int round = 0; round < kRounds; ++round) {
    if (attempt(task, region, true)) {
      if (task.has_hit_limit)
        for (const VertexId v : task.last.dropped)
          is_undecided_[index(v)] = true;
      return true;
    }
    if (task.stuck.empty()) break;
    region.vertices =
        united(region.vertices, solver_.neighborhoods().ring(task.stuck));
  }
  return false;
}

void Closing::accept(const Attempt& solved) {
  surface_.replace(solved.freed, solved.chosen);
  for (const VertexId v : solved.vertices) is_open_[index(v)] = false;
  dropped_.insert(dropped_.end(), solved.dropped.begin(), solved.dropped.end());
}

/// Closes what is still open, and brings in points that were left out.
/// @return whether there was anything to do
bool Closing::label_cells() {
  const ClosingReport& report = result_.report;
  result_.report.labelled = report.infeasible + report.undecided;
  if (report.labelled == 0 && dropped_.empty()) return false;
  std::vector<VertexId> open;
  for (std::size_t v = 0; v < is_open_.size(); ++v)
    if (is_open_[v]) open.push_back(VertexId{static_cast<std::uint32_t>(v)});
  CellLabelResult labelled =
      close_by_cell_labels(triangulation_, result_.triangles, open,
                           {.weight = options_.weight,
                            .piece_triangles = options_.piece_triangles,
                            .stop = options_.stop,
                            .seconds = solver_.seconds_left(),
                            .is_closed_elsewhere = true});
  result_.triangles = std::move(labelled.triangles);
  dropped_ = std::move(labelled.left_out);
  return true;
}

/// Of what comes after the regions.
ClosingOptions Closing::options_for_rest() const {
  ClosingOptions options = options_;
  options.on_program = {};
  options.seconds = std::max(0.0, solver_.seconds_left());
  return options;
}

void Closing::count(const Spent& spent) {
  result_.report.conflicts += spent.conflicts;
  result_.report.propagations += spent.propagations;
  result_.report.timed_out |= spent.is_timed_out;
}

/// @return whether the surface has changed
bool Closing::regain_faces() {
  if (solver_.is_over()) return false;
  const RegainedFaces regained =
      umbrella::regain_faces(triangulation_, options_for_rest(), surface_);
  result_.report.faces_regained = regained.count;
  count(regained.spent);
  if (regained.count > 0) result_.triangles = surface_.sorted();
  return regained.count > 0;
}

/// @return whether the surface may have changed
bool Closing::repair_locally(bool is_labelled) {
  if (solver_.is_over()) return false;
  ClosingOptions options = options_for_rest();
  if (!is_labelled && !may_have_new_handle(surface_, options.handle_edges)) {
    if (solver_.is_one_piece()) return false;
    options.handle_edges = 0;
  }
  LocalRepair repaired =
      umbrella::repair_locally(triangulation_, options, result_.triangles);
  count(repaired.spent);
  result_.report.pieces_joined = repaired.pieces_joined;
  result_.report.brought_in = repaired.brought_in;
  result_.report.handles_removed = repaired.handles_removed;
  dropped_ = std::move(repaired.left_out);
  return true;
}

/// @param has_changed  whether the result is no longer the working surface
void Closing::open_bores(bool has_changed) {
  if (solver_.is_over()) return;
  if (has_changed)
    surface_ =
        WorkingSurface(surface_.n_vertices(),
                       std::span<const LocatedTriangle>(result_.triangles));
  const OpenedBores opened =
      umbrella::open_bores(triangulation_, options_for_rest(), surface_);
  result_.report.bores_opened = opened.count;
  count(opened.spent);
  if (result_.report.bores_opened > 0) result_.triangles = surface_.sorted();
}

void Closing::list_dropped(std::vector<VertexId> dropped) {
  for (const VertexId v : dropped)
    result_.reasons.push_back(is_cut_short_ || is_undecided_[index(v)]
                                  ? DropReason::Limit
                                  : DropReason::NoSolution);
  result_.dropped = std::move(dropped);
}

}  // namespace

ClosingResult close_holes(const delaunay::Triangulation3& triangulation,
                          std::span<const RankedTriangle> cleaned,
                          std::span<const Hole> holes,
                          const ClosingOptions& options) {
  if (triangulation.dimension() < 3) {
    ClosingResult nothing;
    nothing.report.regions = nothing.report.infeasible = holes.size();
    return nothing;
  }
  return Closing(triangulation, cleaned, options).run(holes);
}

}  // namespace umbrella
