// Each region is first solved as it is: regions share no free triangle, so
// their order matters only to pieces that several of them close together.
// Those without a solution are then grown, one after another, around the
// constraints that contradict each other; points are left out last.
#include "umbrella/closing.h"

#include <algorithm>
#include <array>
#include <optional>

#include "umbrella/region_solver_internal.h"

namespace umbrella {
namespace {

class Closing {
 public:
  Closing(const delaunay::Triangulation3& triangulation,
          std::span<const RankedTriangle> cleaned,
          const ClosingOptions& options)
      : options_(options),
        surface_(triangulation.points().size(), cleaned),
        is_open_(triangulation.points().size()),
        solver_(triangulation, options, surface_, is_open_) {}

  ClosingResult run(std::span<const Hole> holes);

 private:
  /// A region that is still open, and its last attempt.
  struct Task {
    Region region;
    Attempt last;
    std::size_t n_regions = 1;  // with those swallowed
  };

  void solve_as_given(std::vector<Region> regions);
  void repair(Task task);
  bool grow(Task& task);
  bool try_grown(Task& task, const Region& region);
  bool allow_pieces(Task& task);
  bool drop_points(Task& task);
  void swallow(Task& task, Region& region);
  void accept(const Attempt& solved);

  const ClosingOptions& options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // vertices of regions not yet closed
  RegionSolver solver_;
  std::vector<Task> tasks_;  // regions that have no solution as given
  ClosingResult result_;
};

ClosingResult Closing::run(std::span<const Hole> holes) {
  solve_as_given(merge_holes(holes, surface_));
  if (options_.mode == CloseMode::Best) {
    std::reverse(tasks_.begin(), tasks_.end());
    while (!tasks_.empty()) {
      Task task = std::move(tasks_.back());
      tasks_.pop_back();
      repair(std::move(task));
    }
  }
  for (const Task& task : tasks_)
    ++(task.last.outcome == Outcome::Infeasible ? result_.report.infeasible
                                                : result_.report.undecided);
  result_.triangles = surface_.sorted();
  result_.report.conflicts = solver_.conflicts();
  std::sort(result_.dropped.begin(), result_.dropped.end());
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
  for (Region& region : regions) {
    Attempt attempt = solver_.attempt(region);
    report.candidate_triangles += attempt.n_candidates;
    report.variables += attempt.n_variables;
    if (attempt.outcome == Outcome::Solved) {
      accept(attempt);
      ++report.feasible;
    } else {
      tasks_.push_back({std::move(region), std::move(attempt)});
    }
  }
}

void Closing::repair(Task task) {
  const Outcome as_given = task.last.outcome;
  if (grow(task) || allow_pieces(task) || drop_points(task)) {
    result_.report.grown += task.n_regions;
    return;
  }
  (as_given == Outcome::Infeasible ? result_.report.infeasible
                                   : result_.report.undecided) +=
      task.n_regions;
}

/// Around what contradicts itself: all Delaunay triangles with two corners
/// there, then with one; the same with a ring of vertices more; and again
/// around what contradicts itself then.
bool Closing::grow(Task& task) {
  constexpr int kRounds = 3;
  std::vector<VertexId> stuck = task.last.stuck;
  Region region = task.region;
  for (int round = 0; round < kRounds && !stuck.empty(); ++round) {
    for (const unsigned reach : {2U, 1U, 3U}) {
      if (reach == 3)
        region.vertices =
            united(region.vertices, solver_.neighborhoods().ring(stuck));
      region.stuck = stuck;
      region.reach = reach;
      if (try_grown(task, region)) return true;
      stuck = united(stuck, task.last.stuck);
    }
  }
  return false;
}

bool Closing::try_grown(Task& task, const Region& region) {
  Region whole = region;
  swallow(task, whole);
  task.last = solver_.attempt(whole);
  if (task.last.outcome != Outcome::Solved) return false;
  accept(task.last);
  return true;
}

/// Open regions that the program would touch become part of it.
void Closing::swallow(Task& task, Region& region) {
  bool has_grown = true;
  while (has_grown) {
    has_grown = false;
    const std::vector<VertexId> touched = solver_.vertices(region);
    for (auto other = tasks_.begin(); other != tasks_.end();) {
      const auto& theirs = other->region.vertices;
      const bool meets =
          std::any_of(theirs.begin(), theirs.end(), [&](VertexId v) {
            return std::binary_search(touched.begin(), touched.end(), v);
          });
      if (!meets) {
        ++other;
        continue;
      }
      region.vertices = united(region.vertices, theirs);
      task.region.vertices = united(task.region.vertices, theirs);
      task.n_regions += other->n_regions;
      other = tasks_.erase(other);
      has_grown = true;
    }
  }
}

/// Lifts the ban on the largest small piece met, until there is a solution.
bool Closing::allow_pieces(Task& task) {
  std::vector<Piece> allowed;
  while (true) {
    task.last = solver_.attempt(task.region, {}, allowed);
    if (task.last.outcome == Outcome::Solved) {
      accept(task.last);
      return true;
    }
    if (task.last.outcome != Outcome::Banned) return false;
    allowed.push_back(*std::max_element(
        task.last.pieces.begin(), task.last.pieces.end(),
        [](const Piece& a, const Piece& b) {
          return a.n_triangles != b.n_triangles ? a.n_triangles < b.n_triangles
                                                : a.vertices > b.vertices;
        }));
  }
}

/// Leaves out vertices of the contradiction, and of those that follow it.
bool Closing::drop_points(Task& task) {
  if (!options_.drop_points) return false;
  std::vector<VertexId> may_drop;
  std::vector<Piece> allowed;
  while (task.last.outcome != Outcome::Undecided) {
    const std::vector<VertexId> more = united(may_drop, task.last.stuck);
    if (more == may_drop) return false;
    may_drop = more;
    task.last = solver_.attempt(task.region, may_drop, allowed);
    if (task.last.outcome != Outcome::Solved) continue;
    accept(task.last);
    return true;
  }
  return false;
}

void Closing::accept(const Attempt& solved) {
  for (const TriangleIndex t : solved.freed) surface_.remove(t);
  for (const LocatedTriangle& t : solved.chosen) surface_.add(t);
  for (const VertexId v : solved.vertices) is_open_[index(v)] = false;
  result_.dropped.insert(result_.dropped.end(), solved.dropped.begin(),
                         solved.dropped.end());
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
