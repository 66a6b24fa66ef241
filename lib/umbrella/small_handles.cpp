#include <algorithm>
#include <set>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/small_handles_internal.h"

namespace umbrella {
namespace {

/// V - E + F = V - F / 2 is 2 for each component less 2 for each handle.
constexpr std::size_t kTrianglesOfHandle = 4;

std::vector<RankedTriangle> with_ranks(
    std::span<const LocatedTriangle> triangles) {
  std::vector<RankedTriangle> result(triangles.size());
  std::transform(triangles.begin(), triangles.end(), result.begin(),
                 [](const LocatedTriangle& t) {
                   return RankedTriangle{t.corners, t.facet, {}};
                 });
  return result;
}

/// Counts what triangles make of the points.
class Census {
 public:
  explicit Census(std::size_t n_vertices)
      : sets_(n_vertices), is_used_(n_vertices) {}

  void add(const Triangle& t) {
    for (const VertexId v : t) {
      is_used_[index(v)] = true;
      sets_.unite(index(t[0]), index(v));
    }
    ++n_triangles_;
  }
  std::size_t n_components() {
    std::size_t n = 0;
    for (std::size_t v = 0; v < is_used_.size(); ++v)
      n += is_used_[v] && sets_.root(v) == v ? 1 : 0;
    return n;
  }
  /// If each edge has two triangles.
  bool has_handles() {
    const auto n_used = static_cast<std::size_t>(
        std::count(is_used_.begin(), is_used_.end(), true));
    return n_used < 2 * n_components() + n_triangles_ / 2;
  }

 private:
  DisjointSets sets_;
  std::vector<bool> is_used_;
  std::size_t n_triangles_ = 0;
};

class HandleRemoval {
 public:
  HandleRemoval(const delaunay::Triangulation3& triangulation,
                const ClosingOptions& options,
                std::span<const RankedTriangle> triangles)
      : options_(options),
        surface_(triangulation.points().size(), triangles),
        is_open_(triangulation.points().size()),
        groups_(triangulation, triangles),
        solver_(triangulation, options, surface_, is_open_, groups_),
        effort_{options.conflicts,
                options.propagations + options.propagations_per_vertex *
                                           triangulation.points().size()},
        is_changed_(triangulation.points().size()) {}

  std::size_t run();
  std::vector<LocatedTriangle> triangles() const { return surface_.sorted(); }

 private:
  using Loop = std::vector<VertexId>;

  std::size_t run_once();
  bool try_about(const Loop& loop);
  std::vector<VertexId> ringed(std::span<const VertexId> vertices) const;
  bool is_good(const Attempt& solved) const;
  void accept(const Attempt& solved);

  const ClosingOptions& options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  Effort effort_;  // for all that is tried
  std::vector<bool> is_changed_;
  std::set<Loop> tried_;
};

std::size_t HandleRemoval::run() {
  std::size_t n_removed = 0;
  for (std::size_t n = run_once(); n > 0; n = run_once()) n_removed += n;
  return n_removed;
}

/// Tries each loop once, but for those that a removal has changed.
std::size_t HandleRemoval::run_once() {
  std::vector<Triangle> corners;
  for (const LocatedTriangle& t : surface_.sorted())
    corners.push_back(t.corners);
  EssentialLoops loops(surface_.n_vertices(), corners);
  is_changed_.assign(is_changed_.size(), false);
  std::size_t n_removed = 0;
  for (const Loop& loop : loops.shortest(options_.handle_edges)) {
    const bool has_changed =
        std::any_of(loop.begin(), loop.end(),
                    [this](VertexId v) { return is_changed_[index(v)]; });
    if (has_changed || !tried_.insert(loop).second) continue;
    if (effort_.is_spent() || solver_.is_stopped()) break;
    n_removed += try_about(loop) ? 1 : 0;
  }
  return n_removed;
}

/// The vertices of the loop with one ring of the surface, then with two.
bool HandleRemoval::try_about(const Loop& loop) {
  constexpr int kRings = 2;
  Region region;
  region.vertices = loop;
  for (int ring = 0; ring < kRings; ++ring) {
    region.vertices = ringed(region.vertices);
    Effort effort = {std::min(effort_.conflicts, options_.conflicts / 20),
                     std::min(effort_.propagations, options_.propagations / 2)};
    const Effort before = effort;
    const Attempt attempt = solver_.attempt(
        region, effort, {.fewer_triangles = kTrianglesOfHandle});
    effort_.charge(before.conflicts - effort.conflicts,
                   before.propagations - effort.propagations);
    if (attempt.outcome != Outcome::Solved || !is_good(attempt)) continue;
    accept(attempt);
    return true;
  }
  return false;
}

/// With the vertices of all triangles there; ascending.
std::vector<VertexId> HandleRemoval::ringed(
    std::span<const VertexId> vertices) const {
  std::vector<VertexId> result;
  for (const VertexId v : vertices)
    surface_.for_each_at(v, [&](TriangleIndex t) {
      const Triangle& corners = surface_.corners(t);
      result.insert(result.end(), corners.begin(), corners.end());
    });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Whether it is a handle that goes, and no component comes.
bool HandleRemoval::is_good(const Attempt& solved) const {
  Census before(surface_.n_vertices()), after(surface_.n_vertices());
  std::vector<bool> is_freed(surface_.n_indices());
  for (const TriangleIndex t : solved.freed) is_freed[t] = true;
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t) {
    if (!surface_.contains(t)) continue;
    before.add(surface_.corners(t));
    if (!is_freed[t]) after.add(surface_.corners(t));
  }
  for (const LocatedTriangle& t : solved.chosen) after.add(t.corners);
  return after.n_components() <= before.n_components();
}

void HandleRemoval::accept(const Attempt& solved) {
  for (const TriangleIndex t : solved.freed) surface_.remove(t);
  for (const LocatedTriangle& t : solved.chosen) surface_.add(t);
  for (const VertexId v : solved.vertices) is_changed_[index(v)] = true;
}

}  // namespace

std::size_t remove_small_handles(const delaunay::Triangulation3& triangulation,
                                 const ClosingOptions& options,
                                 std::vector<LocatedTriangle>& triangles) {
  Census census(triangulation.points().size());
  for (const LocatedTriangle& t : triangles) census.add(t.corners);
  if (options.handle_edges == 0 || !census.has_handles()) return 0;
  const std::vector<RankedTriangle> ranked = with_ranks(triangles);
  HandleRemoval removal(triangulation, options, ranked);
  const std::size_t n = removal.run();
  if (n > 0) triangles = removal.triangles();
  return n;
}

}  // namespace umbrella
