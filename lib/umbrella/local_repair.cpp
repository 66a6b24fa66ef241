#include <algorithm>
#include <set>
#include <utility>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/region_solver_internal.h"

namespace umbrella {
namespace {

constexpr std::size_t kMostVertices = 300;

/// Every piece that is no larger is banned, and no larger one looked for. The
/// whole surface is none: of two pieces one has no more than half of it.
ClosingOptions with_small_pieces(ClosingOptions options,
                                 std::size_t n_triangles) {
  options.piece_triangles = std::max(
      options.piece_triangles, std::min(2 * kMostVertices, n_triangles / 2));
  options.piece_part = options.joined_part = 0;
  return options;
}

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
  std::vector<VertexId> unused() const {
    std::vector<VertexId> result;
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (!is_used_[v]) result.push_back(VertexId{v});
    return result;
  }
  std::size_t n_components() {
    std::size_t n = 0;
    for (std::size_t v = 0; v < is_used_.size(); ++v)
      n += is_used_[v] && sets_.root(v) == v ? 1 : 0;
    return n;
  }
  std::size_t n_vertices() const { return is_used_.size(); }
  /// The vertices of each component, ascending.
  std::vector<std::vector<VertexId>> components() {
    std::vector<std::vector<VertexId>> of_root(is_used_.size());
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (is_used_[v]) of_root[sets_.root(v)].push_back(VertexId{v});
    std::erase_if(of_root, [](const auto& part) { return part.empty(); });
    return of_root;
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

using Loops = std::vector<std::vector<VertexId>>;

/// Those of at most so many edges that go round a handle and no tube.
Loops short_loops(std::size_t n_vertices,
                  std::span<const LocatedTriangle> triangles,
                  unsigned max_edges) {
  std::vector<Triangle> corners(triangles.size());
  std::transform(triangles.begin(), triangles.end(), corners.begin(),
                 [](const LocatedTriangle& t) { return t.corners; });
  return EssentialLoops(n_vertices, corners).shortest_round_no_tube(max_edges);
}

class Repair {
 public:
  Repair(const delaunay::Triangulation3& triangulation,
         const ClosingOptions& options,
         std::span<const RankedTriangle> triangles, Census census)
      : options_(options),
        local_options_(with_small_pieces(options, triangles.size())),
        surface_(triangulation.points().size(), triangles),
        is_open_(triangulation.points().size()),
        groups_(triangulation, triangles),
        solver_(triangulation, local_options_, surface_, is_open_, groups_),
        effort_{options.conflicts / 3,
                options.propagations + options.propagations_per_vertex *
                                           triangulation.points().size()},
        is_changed_(triangulation.points().size()),
        census_(std::move(census)),
        n_components_(census_.n_components()) {}

  std::size_t join_pieces();
  std::size_t bring_in();
  std::size_t remove_handles(Loops loops);
  std::vector<VertexId> left_out() const { return census_.unused(); }
  std::vector<LocatedTriangle> triangles() const { return surface_.sorted(); }

 private:
  using Vertices = std::vector<VertexId>;

  bool hangs_together(const Vertices& piece);
  std::size_t remove_some_handles(const Loops& loops);
  bool remove_handle_at(const Vertices& loop);
  bool attempt(const Region& region, const AttemptOptions& how,
               std::size_t most_components);
  Vertices ringed(std::span<const VertexId> vertices) const;
  Census census_with(const Attempt& solved) const;
  void accept(const Attempt& solved);
  bool is_over() const { return effort_.is_spent() || solver_.is_stopped(); }

  const ClosingOptions& options_;
  const ClosingOptions local_options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  Effort effort_;  // for all that is tried
  std::vector<bool> is_changed_;
  Census census_;  // of the surface as it is
  std::size_t n_components_;
  std::set<Vertices> tried_;
};

/// With the rest of the surface, of which it is a small part.
bool Repair::hangs_together(const Vertices& piece) {
  return piece.size() <= kMostVertices &&
         static_cast<double>(piece.size()) <=
             options_.joined_part *
                 static_cast<double>(groups_.n_points_with(piece));
}

/// @return how many there are less
std::size_t Repair::join_pieces() {
  const std::size_t n_before = n_components_;
  if (n_components_ == 1) return 0;
  for (const Vertices& piece : census_.components()) {
    if (n_components_ == 1 || is_over()) break;
    if (!hangs_together(piece)) continue;
    Region region;
    region.vertices = solver_.neighborhoods().ring(piece);
    attempt(region, {.may_drop = left_out()}, n_components_ - 1);
  }
  return n_before - n_components_;
}

/// @return how many points came to the surface
std::size_t Repair::bring_in() {
  constexpr int kRings = 3;
  const Vertices missing = left_out();
  for (const VertexId v : missing) {
    Region region;
    region.vertices = {v};
    for (int ring = 0; ring < kRings && !surface_.is_used(v) && !is_over();
         ++ring) {
      region.vertices = solver_.neighborhoods().ring(region.vertices);
      Vertices others = left_out();
      std::erase(others, v);
      attempt(region, {.may_drop = others}, n_components_);
    }
  }
  return missing.size() - left_out().size();
}

/// @param loops  those of the surface as it is; none if nobody has looked
std::size_t Repair::remove_handles(Loops loops) {
  std::size_t n_removed = 0;
  while (!is_over() && census_.has_handles()) {
    if (loops.empty())
      loops = short_loops(surface_.n_vertices(), triangles(),
                          options_.handle_edges);
    const std::size_t n = remove_some_handles(loops);
    if (n == 0) break;
    n_removed += n;
    loops.clear();
  }
  return n_removed;
}

/// Tries each loop once, but for those that a removal has changed.
std::size_t Repair::remove_some_handles(const Loops& loops) {
  is_changed_.assign(is_changed_.size(), false);
  std::size_t n_removed = 0;
  for (const Vertices& loop : loops) {
    const bool has_changed =
        std::any_of(loop.begin(), loop.end(),
                    [this](VertexId v) { return is_changed_[index(v)]; });
    if (has_changed || !tried_.insert(loop).second) continue;
    if (is_over()) break;
    n_removed += remove_handle_at(loop) ? 1 : 0;
  }
  return n_removed;
}

/// Tries the vertices of the loop with one ring of the surface, then with two.
bool Repair::remove_handle_at(const Vertices& loop) {
  constexpr int kRings = 2;
  Region region;
  region.vertices = loop;
  for (int ring = 0; ring < kRings; ++ring) {
    region.vertices = ringed(region.vertices);
    if (attempt(region, {.fewer_triangles = kTrianglesOfHandle}, n_components_))
      return true;
  }
  return false;
}

/// Takes the surface that solves the region's program, if it has one.
bool Repair::attempt(const Region& region, const AttemptOptions& how,
                     std::size_t most_components) {
  const Effort before = {
      std::min(effort_.conflicts, options_.conflicts / 60),
      std::min(effort_.propagations, options_.propagations / 2)};
  Effort effort = before;
  const Attempt attempt = solver_.attempt(region, effort, how);
  effort_.charge(before.conflicts - effort.conflicts,
                 before.propagations - effort.propagations);
  if (attempt.outcome != Outcome::Solved) return false;
  Census census = census_with(attempt);
  const std::size_t n_components = census.n_components();
  if (n_components > most_components) return false;
  accept(attempt);
  census_ = std::move(census);
  n_components_ = n_components;
  return true;
}

/// With the vertices of all triangles there; ascending.
std::vector<VertexId> Repair::ringed(std::span<const VertexId> vertices) const {
  Vertices result;
  for (const VertexId v : vertices)
    surface_.for_each_at(v, [&](TriangleIndex t) {
      const Triangle& corners = surface_.corners(t);
      result.insert(result.end(), corners.begin(), corners.end());
    });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Census Repair::census_with(const Attempt& solved) const {
  std::vector<bool> is_freed(surface_.n_indices());
  for (const TriangleIndex t : solved.freed) is_freed[t] = true;
  Census census(surface_.n_vertices());
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t)
    if (surface_.contains(t) && !is_freed[t]) census.add(surface_.corners(t));
  for (const LocatedTriangle& t : solved.chosen) census.add(t.corners);
  return census;
}

void Repair::accept(const Attempt& solved) {
  for (const TriangleIndex t : solved.freed) surface_.remove(t);
  for (const LocatedTriangle& t : solved.chosen) surface_.add(t);
  for (const VertexId v : solved.vertices) is_changed_[index(v)] = true;
}

}  // namespace

LocalRepair repair_locally(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           std::vector<LocatedTriangle>& triangles) {
  Census census(triangulation.points().size());
  for (const LocatedTriangle& t : triangles) census.add(t.corners);
  LocalRepair result;
  result.left_out = census.unused();
  Loops loops;
  if (census.n_components() == 1 && result.left_out.empty()) {
    if (options.handle_edges == 0 || !census.has_handles()) return result;
    loops = short_loops(census.n_vertices(), triangles, options.handle_edges);
    if (loops.empty()) return result;
  }
  const std::vector<RankedTriangle> ranked = with_ranks(triangles);
  Repair repair(triangulation, options, ranked, std::move(census));
  result.pieces_joined = repair.join_pieces();
  result.brought_in = repair.bring_in();
  if (options.handle_edges > 0)
    result.handles_removed = repair.remove_handles(std::move(loops));
  result.left_out = repair.left_out();
  triangles = repair.triangles();
  return result;
}

}  // namespace umbrella
