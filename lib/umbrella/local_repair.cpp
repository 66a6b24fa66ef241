#include <algorithm>
#include <set>
#include <utility>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/handle_loops_internal.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/sort_unique_internal.h"

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

/// What triangles make of the points.
class Census {
 public:
  Census(std::size_t n_vertices, std::span<const LocatedTriangle> triangles)
      : sets_(n_vertices), is_used_(n_vertices) {
    for (const auto& [t, facet] : triangles) {
      for (const VertexId v : t) is_used_[index(v)] = 1;
      sets_.unite(index(t[0]), index(t[1]));
      sets_.unite(index(t[0]), index(t[2]));
    }
  }

  std::vector<VertexId> unused() const {
    std::vector<VertexId> result;
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (is_used_[v] == 0) result.push_back(VertexId{v});
    return result;
  }
  std::size_t n_components() {
    std::size_t n = 0;
    for (std::size_t v = 0; v < is_used_.size(); ++v)
      n += is_used_[v] != 0 && sets_.root(v) == v ? 1 : 0;
    return n;
  }
  /// The vertices of each component, ascending.
  std::vector<std::vector<VertexId>> components() {
    std::vector<std::vector<VertexId>> of_root(is_used_.size());
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (is_used_[v] != 0) of_root[sets_.root(v)].push_back(VertexId{v});
    std::erase_if(of_root, [](const auto& part) { return part.empty(); });
    return of_root;
  }

 private:
  DisjointSets sets_;
  std::vector<std::uint8_t> is_used_;
};

/// Of a surface on which each edge has two triangles.
bool has_handles(std::size_t n_vertices, std::size_t n_triangles,
                 std::size_t n_components) {
  return n_vertices < 2 * n_components + n_triangles / 2;
}

using Loops = HandleLoops::Loops;

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
        effort_{2 * (options.conflicts / 3),
                2 * (options.propagations + options.propagations_per_vertex *
                                                triangulation.points().size())},
        is_changed_(triangulation.points().size()),
        at_first_(std::move(census)),
        left_out_(at_first_.unused()),
        n_triangles_(triangles.size()),
        n_components_(at_first_.n_components()) {}

  std::size_t join_pieces();
  std::size_t bring_in();
  std::size_t remove_handles(HandleLoops& search, Loops loops);
  const std::vector<VertexId>& left_out() const { return left_out_; }
  std::uint64_t propagations() const { return solver_.propagations(); }
  std::vector<LocatedTriangle> triangles() const { return surface_.sorted(); }

 private:
  using Vertices = std::vector<VertexId>;

  bool hangs_together(const Vertices& piece);
  std::size_t remove_some_handles(const Loops& loops);
  bool remove_handle_at(const Vertices& loop);
  bool attempt(const Region& region, const AttemptOptions& how,
               std::size_t most_components);
  Vertices ringed(std::span<const VertexId> vertices) const;
  bool has_handles() const {
    return umbrella::has_handles(surface_.n_vertices() - left_out_.size(),
                                 n_triangles_, n_components_);
  }
  void accept(const Attempt& solved);
  bool is_over() const { return effort_.is_spent() || solver_.is_over(); }

  const ClosingOptions& options_;
  const ClosingOptions local_options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  Effort effort_;                 // for all that is tried
  std::vector<bool> is_changed_;  // by vertex, since loops were looked for
  Vertices changed_;              // where that is so, perhaps more than once
  std::set<Vertices> tried_;
  Census at_first_;
  // Of the surface as it is.
  Vertices left_out_;  // ascending
  std::size_t n_triangles_;
  std::size_t n_components_;
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
  for (const Vertices& piece : at_first_.components()) {
    if (n_components_ == 1 || is_over()) break;
    if (!hangs_together(piece)) continue;
    Region region;
    region.vertices = solver_.neighborhoods().ring(piece);
    attempt(region, {.may_drop = left_out_}, n_components_ - 1);
  }
  return n_before - n_components_;
}

/// @return how many points came to the surface
std::size_t Repair::bring_in() {
  constexpr int kRings = 3;
  const Vertices missing = left_out_;
  for (const VertexId v : missing) {
    Region region;
    region.vertices = {v};
    for (int ring = 0; ring < kRings && !surface_.is_used(v) && !is_over();
         ++ring) {
      region.vertices = solver_.neighborhoods().ring(region.vertices);
      Vertices others = region.vertices;
      std::erase_if(others,
                    [&](VertexId w) { return w == v || surface_.is_used(w); });
      attempt(region, {.may_drop = others}, n_components_);
    }
  }
  return missing.size() - left_out_.size();
}

/// @param loops  what the search has found on the surface as it is; none if it
///   has not looked
std::size_t Repair::remove_handles(HandleLoops& search, Loops loops) {
  const auto goes_on = [this] { return !is_over() && has_handles(); };
  if (loops.empty() && goes_on())
    loops = search.all(surface_.n_vertices(), triangles());
  std::size_t n_removed = 0;
  while (goes_on()) {
    const std::size_t n = remove_some_handles(loops);
    if (n == 0) break;
    n_removed += n;
    if (goes_on()) loops = search.about(surface_, changed_);
  }
  return n_removed;
}

/// Tries each loop once, but for those that a removal has changed.
std::size_t Repair::remove_some_handles(const Loops& loops) {
  for (const VertexId v : changed_) is_changed_[index(v)] = false;
  changed_.clear();
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
    if (attempt(region,
                {.fewer_triangles = kTrianglesOfHandle, .is_likely = false},
                n_components_))
      return true;
  }
  return false;
}

/// Takes the surface that solves the region's program, if it has one.
bool Repair::attempt(const Region& region, const AttemptOptions& how,
                     std::size_t most_components) {
  const Effort before = {std::min(effort_.conflicts, options_.conflicts / 30),
                         std::min(effort_.propagations, options_.propagations)};
  Effort effort = before;
  const Attempt attempt = solver_.attempt(region, effort, how);
  const bool is_solved = attempt.outcome == Outcome::Solved;
  const std::size_t n_components =
      n_components_ + (is_solved ? solver_.n_pieces_added(attempt, effort) : 0);
  effort_.charge(before.conflicts - effort.conflicts,
                 before.propagations - effort.propagations);
  if (!is_solved || n_components > most_components) return false;
  accept(attempt);
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
  sort_unique(result);
  return result;
}

void Repair::accept(const Attempt& solved) {
  for (const TriangleIndex t : solved.freed) surface_.remove(t);
  for (const LocatedTriangle& t : solved.chosen) surface_.add(t);
  for (const VertexId v : solved.vertices) {
    is_changed_[index(v)] = true;
    changed_.push_back(v);
  }
  n_triangles_ += solved.chosen.size() - solved.freed.size();
  std::erase_if(left_out_, [this](VertexId v) { return surface_.is_used(v); });
}

}  // namespace

LocalRepair repair_locally(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           std::vector<LocatedTriangle>& triangles) {
  const std::size_t n_vertices = triangulation.points().size();
  Census census(n_vertices, triangles);
  LocalRepair result;
  result.left_out = census.unused();
  HandleLoops search(options.handle_edges);
  Loops loops;
  if (census.n_components() == 1 && result.left_out.empty()) {
    if (options.handle_edges == 0 ||
        !has_handles(n_vertices, triangles.size(), 1))
      return result;
    loops = search.all(n_vertices, triangles);
    if (loops.empty()) return result;
  }
  const std::vector<RankedTriangle> ranked = with_ranks(triangles);
  Repair repair(triangulation, options, ranked, std::move(census));
  result.pieces_joined = repair.join_pieces();
  result.brought_in = repair.bring_in();
  if (options.handle_edges > 0)
    result.handles_removed = repair.remove_handles(search, std::move(loops));
  result.propagations = repair.propagations();
  result.left_out = repair.left_out();
  triangles = repair.triangles();
  return result;
}

}  // namespace umbrella
