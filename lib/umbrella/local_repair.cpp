#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "umbrella/badness_internal.h"
#include "umbrella/census_internal.h"
#include "umbrella/exchange_internal.h"
#include "umbrella/handle_loops_internal.h"
#include "umbrella/local_repair_internal.h"
#include "umbrella/region_solver_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

constexpr std::size_t kMostVertices = 300;
/// At most so many times options.handle_edges edges have loops at which handles
/// are cut. On 26 sets to choose by, 8 edges bring none right that 5 do not, 10
/// one, and 12 lose that again: then it passes for a tube.
constexpr unsigned kLonger = 2;
/// The same of loops at which handles that are left are cut at last.
constexpr unsigned kLongest = 4;

/// A handle stays if the triangles that would come are so many times as bad as
/// those that would go. On one half of 342 samples of surfaces 1.3, 1.4 and 1.5
/// leave 126, 128 and 123 right, on the other 132, 128 and 122.
constexpr double kMostLoss = 1.4;

/// Every piece that is no larger is banned, and no larger one looked for. The
/// whole surface is none: of two pieces one has no more than half of it.
ClosingOptions with_small_pieces(ClosingOptions options,
                                 std::size_t n_triangles) {
  options.piece_triangles = std::max(
      options.piece_triangles, std::min(2 * kMostVertices, n_triangles / 2));
  options.piece_part = options.joined_part = 0;
  return options;
}

std::vector<RankedTriangle> with_ranks(
    std::span<const LocatedTriangle> triangles) {
  std::vector<RankedTriangle> result(triangles.size());
  std::transform(triangles.begin(), triangles.end(), result.begin(),
                 [](const LocatedTriangle& t) {
                   return RankedTriangle{t.corners, t.facet, {}};
                 });
  return result;
}

/// Of a surface on which each edge has two triangles.
std::size_t count_handles(std::size_t n_vertices, std::size_t n_triangles,
                          std::size_t n_components) {
  return (2 * n_components + n_triangles / 2 - n_vertices) / 2;
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
        groups_(triangulation, triangles, surface_),
        solver_(triangulation, local_options_, surface_, is_open_, groups_),
        badness_(triangulation, options.weight),
        overlap_(triangulation, CloseWeight::BallOverlap),
        most_conflicts_(local_effort(options, 0, 0).conflicts_of_each),
        effort_(local_effort(options, triangulation.points().size(), 2).all),
        is_changed_(triangulation.points().size()),
        at_first_(std::move(census)),
        left_out_(at_first_.unused()),
        n_triangles_(triangles.size()),
        n_components_(at_first_.n_components()) {}

  std::size_t join_pieces();
  std::size_t bring_in();
  std::size_t remove_handles(HandleLoops& search, Loops loops);
  const std::vector<VertexId>& left_out() const { return left_out_; }
  const RegionSolver& solver() const { return solver_; }
  std::vector<LocatedTriangle> triangles() const { return surface_.sorted(); }

 private:
  using Vertices = std::vector<VertexId>;

  /// How to remove the handle that a loop goes round.
  enum class Way { Any, Cut };
  enum class Cut { None, Refused, Taken };
  /// Whether the triangles let a handle go.
  using Question = bool (Repair::*)(const Vertices& loop,
                                    const Attempt& solved) const;

  bool hangs_together(const Vertices& piece);
  void remove_handles(HandleLoops& search, Loops loops, Way way);
  void remove_last_handles(HandleLoops& search);
  bool remove_some_handles(const Loops& loops, Way way);
  bool remove_handle_at(const Vertices& loop, Way way);
  bool remove_handle(const Vertices& loop, const Region& region);
  Outcome take_fewer_triangles(const Vertices& loop, const Region& region,
                               std::uint64_t most_conflicts);
  Cut cut(const Vertices& loop, const Region& region, Question may_take);
  /// By vertex: that the sampling of one body is in doubt says nothing about
  /// another.
  std::vector<bool> on_changed_components() const {
    return n_components_ == 1 ? std::vector<bool>(surface_.n_vertices(), true)
                              : on_components_of(surface_, all_changed_);
  }
  bool remove_last_handle(const Loops& loops);
  bool is_cut(const Vertices& loop, const Region& region) {
    return cut(loop, region, &Repair::may_go) == Cut::Taken;
  }
  Cut cut_at_last(const Vertices& loop);
  bool costs_little(const Vertices& loop, const Attempt& solved) const;
  bool has_changed(const Vertices& loop) const;
  void forget_changes();
  std::vector<Vertices> parts_without(const Vertices& loop,
                                      const Vertices& vertices) const;
  bool may_go(const Vertices& loop, const Attempt& solved) const;
  bool attempt(const Region& region, const AttemptOptions& how,
               std::size_t most_components);
  Attempt solution(const Region& region, const AttemptOptions& how,
                   std::uint64_t most_conflicts);
  bool take(const Attempt& solved, std::size_t most_components);
  Vertices ringed(std::span<const VertexId> vertices) const;
  std::size_t n_handles() const {
    return count_handles(surface_.n_vertices() - left_out_.size(), n_triangles_,
                         n_components_);
  }
  void accept(const Attempt& solved);
  bool is_over() const { return effort_.is_spent() || solver_.is_over(); }
  bool may_go_on() const { return !is_over() && n_handles() > 0; }

  const ClosingOptions& options_;
  const ClosingOptions local_options_;
  WorkingSurface surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  Badness badness_;
  Badness overlap_;
  std::uint64_t most_conflicts_;  // lent to a program
  Effort effort_;                 // for all that is tried
  std::vector<bool> is_changed_;  // by vertex, since loops were looked for
  Vertices changed_;              // where that is so, perhaps more than once
  Vertices all_changed_;          // the same since all of it was looked at
  std::set<Vertices> tried_;
  std::set<Vertices> refused_;  // of the last cuts
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
  constexpr int kMostRings = 3;
  const Vertices missing = left_out_;
  for (const VertexId v : missing) {
    Region region;
    region.vertices = {v};
    for (int ring = 0; ring < kMostRings && !surface_.is_used(v) && !is_over();
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

/// Where short loops go round handles that should not be, longer ones may do so
/// as well.
///
/// @param loops  what the search has found on the surface as it is; none if it
///   has not looked
/// @return how many handles there are less
std::size_t Repair::remove_handles(HandleLoops& search, Loops loops) {
  const std::size_t n_before = n_handles();
  if (loops.empty() && may_go_on())
    loops = search.all(surface_.n_vertices(), triangles());
  remove_handles(search, std::move(loops), Way::Any);
  if (n_handles() < n_before && may_go_on()) {
    search.set_max_edges(kLonger * options_.handle_edges);
    remove_handles(search, search.about(surface_, all_changed_), Way::Cut);
  }
  if (n_handles() < n_before) remove_last_handles(search);
  return n_before - n_handles();
}

/// @param loops  where to begin
void Repair::remove_handles(HandleLoops& search, Loops loops, Way way) {
  while (may_go_on() && remove_some_handles(loops, way))
    if (may_go_on()) loops = search.about(surface_, changed_);
}

/// At few loops each, those of tubes and those tried in other ways among them.
void Repair::remove_last_handles(HandleLoops& search) {
  constexpr std::size_t kAlike = 8;
  const unsigned max_edges = kLongest * options_.handle_edges;
  tried_.clear();
  bool is_any_removed = true;
  while (may_go_on() && is_any_removed) {
    forget_changes();
    is_any_removed = false;
    const std::vector<bool> is_in_doubt = on_changed_components();
    for (const Loops& loops :
         search.independent(surface_, all_changed_, max_edges, kAlike))
      if (is_in_doubt[index(loops[0][0])])
        is_any_removed |= remove_last_handle(loops);
  }
}

/// What the triangles say about the first cut there is holds for the handle.
///
/// @param loops  that go round the same
bool Repair::remove_last_handle(const Loops& loops) {
  for (const Vertices& loop : loops) {
    if (refused_.contains(loop) || is_over()) return false;
    if (has_changed(loop) || !tried_.insert(loop).second) continue;
    const Cut result = cut_at_last(loop);
    if (result == Cut::Refused) refused_.insert(loop);
    if (result != Cut::None) return result == Cut::Taken;
  }
  return false;
}

/// Tries each loop once, but for those that a removal has changed. Those to be
/// cut have to lie on a component that has been changed.
/// @return whether any is removed
bool Repair::remove_some_handles(const Loops& loops, Way way) {
  forget_changes();
  const std::vector<bool> is_in_doubt =
      way == Way::Cut ? on_changed_components()
                      : std::vector<bool>(surface_.n_vertices(), true);
  bool is_any_removed = false;
  for (const Vertices& loop : loops) {
    if (!is_in_doubt[index(loop[0])] || has_changed(loop) ||
        !tried_.insert(loop).second)
      continue;
    if (is_over()) break;
    is_any_removed |= remove_handle_at(loop, way);
  }
  return is_any_removed;
}

/// Since changes were forgotten.
bool Repair::has_changed(const Vertices& loop) const {
  return std::any_of(loop.begin(), loop.end(),
                     [this](VertexId v) { return is_changed_[index(v)]; });
}

void Repair::forget_changes() {
  for (const VertexId v : changed_) is_changed_[index(v)] = false;
  changed_.clear();
}

/// Tries the vertices of the loop with one ring of the surface, then with two.
bool Repair::remove_handle_at(const Vertices& loop, Way way) {
  constexpr int kRings = 2;
  Region region;
  region.vertices = loop;
  for (int ring = 0; ring < kRings; ++ring) {
    region.vertices = ringed(region.vertices);
    if (way == Way::Any ? remove_handle(loop, region) : is_cut(loop, region))
      return true;
  }
  return false;
}

/// Whether a handle can go at all mostly shows within a few conflicts; where it
/// does not, a cut tells sooner than a longer search.
bool Repair::remove_handle(const Vertices& loop, const Region& region) {
  constexpr std::uint64_t kFewConflicts = 60;
  const Outcome outcome = take_fewer_triangles(loop, region, kFewConflicts);
  if (outcome != Outcome::Undecided) return outcome == Outcome::Solved;
  return is_cut(loop, region) ||
         take_fewer_triangles(loop, region, most_conflicts_) == Outcome::Solved;
}

/// Takes the surface that has a handle less, if there is one near the loop.
/// @return Infeasible if there is none, or the triangles speak for the handle
Outcome Repair::take_fewer_triangles(const Vertices& loop, const Region& region,
                                     std::uint64_t most_conflicts) {
  const Attempt solved = solution(
      region, {.fewer_triangles = kTrianglesOfHandle, .is_likely = false},
      most_conflicts);
  if (solved.outcome != Outcome::Solved) return solved.outcome;
  const bool is_taken = may_go(loop, solved) && take(solved, n_components_);
  return is_taken ? Outcome::Solved : Outcome::Infeasible;
}

/// Whether the triangles do not speak for the handle. Three points are no
/// section of a tube, so nothing is asked of theirs. Long loops are looked at
/// only where short ones have shown that the sampling is in doubt.
bool Repair::may_go(const Vertices& loop, const Attempt& solved) const {
  if (loop.size() == 3) return true;
  const Exchange exchange = exchange_of(solved, surface_, badness_);
  return loop.size() <= options_.handle_edges
             ? exchange.mean_coming <= kMostLoss * exchange.mean_going
             : exchange.mean_coming <= exchange.worst_going;
}

/// Parts the two sides of the loop, which goes with one of them: no triangle
/// joins them near the loop, so that each is closed by itself. That is shown to
/// be possible, or not to be, much sooner than that there is a surface with
/// fewer triangles.
Repair::Cut Repair::cut(const Vertices& loop, const Region& region,
                        Question may_take) {
  const std::vector<Vertices> parts = parts_without(loop, region.vertices);
  if (parts.size() < 2) return Cut::None;
  Cut result = Cut::None;
  for (const Vertices& part : parts) {
    const Attempt solved =
        solution(region, {.part = part, .is_likely = false}, most_conflicts_);
    if (solved.outcome != Outcome::Solved ||
        solved.chosen.size() + kTrianglesOfHandle > solved.freed.size())
      continue;
    if (!(this->*may_take)(loop, solved))
      result = Cut::Refused;
    else if (take(solved, n_components_))
      return Cut::Taken;
  }
  return result;
}

/// In as few rings as it takes: most of the triangles that come close the
/// handle then.
Repair::Cut Repair::cut_at_last(const Vertices& loop) {
  constexpr int kRings = 3;
  Cut result = Cut::None;
  Region region;
  region.vertices = loop;
  for (int ring = 0; ring < kRings && result == Cut::None; ++ring) {
    region.vertices = ringed(region.vertices);
    if (region.vertices.size() > kMostVertices) break;
    result = cut(loop, region, &Repair::costs_little);
  }
  return result;
}

/// Whether the triangles that come have, on average, little more of ball
/// overlap than those that go. Well sampled, a tube has triangles near -1, and
/// those that close it are near 1; where parts touch they are much alike. The
/// more edges a loop has, the better is a tube of its size sampled.
bool Repair::costs_little(const Vertices& loop, const Attempt& solved) const {
  const bool is_long = loop.size() > kLonger * options_.handle_edges;
  const double most = is_long ? 2.0 / 3 : 0.5;
  const Exchange exchange = exchange_of(solved, surface_, overlap_);
  return exchange.mean_coming <= exchange.mean_going + most;
}

/// Vertices but for those of the loop, in parts that edges of the surface hold
/// together; each ascending.
std::vector<std::vector<VertexId>> Repair::parts_without(
    const Vertices& loop, const Vertices& vertices) const {
  std::set<VertexId> left;
  std::set_difference(vertices.begin(), vertices.end(), loop.begin(),
                      loop.end(), std::inserter(left, left.end()));
  std::vector<Vertices> parts;
  while (!left.empty()) {
    Vertices part = {*left.begin()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < part.size(); ++i) {
      surface_.for_each_at(part[i], [&](TriangleIndex t) {
        for (const VertexId v : surface_.corners(t))
          if (left.erase(v) > 0) part.push_back(v);
      });
    }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Takes the surface that solves the region's program, if it has one.
bool Repair::attempt(const Region& region, const AttemptOptions& how,
                     std::size_t most_components) {
  const Attempt solved = solution(region, how, most_conflicts_);
  return solved.outcome == Outcome::Solved && take(solved, most_components);
}

/// What its program gives, with conflicts from the effort of all.
Attempt Repair::solution(const Region& region, const AttemptOptions& how,
                         std::uint64_t most_conflicts) {
  return effort_.lend(most_conflicts, options_.propagations, [&](Effort& lent) {
    return solver_.attempt(region, lent, how);
  });
}

/// Unless the surface would have too many components.
bool Repair::take(const Attempt& solved, std::size_t most_components) {
  const std::size_t n_components =
      n_components_ + solver_.n_pieces_added(solved, effort_);
  if (n_components > most_components) return false;
  accept(solved);
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
  surface_.replace(solved.freed, solved.chosen);
  for (const VertexId v : solved.vertices) {
    is_changed_[index(v)] = true;
    changed_.push_back(v);
    all_changed_.push_back(v);
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
        count_handles(n_vertices, triangles.size(), 1) == 0)
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
  result.spent = repair.solver().spent();
  result.left_out = repair.left_out();
  triangles = repair.triangles();
  return result;
}

}  // namespace umbrella
