/// @file
/// Each of several inserters gets a part of the vertices and may change only
/// cells whose corners all lie in it; vertices whose cavity holds another cell
/// are put off [Marot19, Sec. 3]. Those lie along the seams between parts. At
/// first the parts are intervals of the Hilbert curve, along which vertices are
/// numbered; for what is put off space is cut into slabs across one direction,
/// then another, so that seams meet in lines, then in points. The few vertices
/// that remain are inserted by one thread.
///
/// What an inserter may do keeps it from all that another may write
/// (docs/delaunay.md, "Threads"), so there is neither lock nor atomic variable,
/// and the result does not depend on timing.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "delaunay/bowyer_watson3_internal.h"
#include "delaunay/insertion_rounds_internal.h"
#include "delaunay/parallel_insertion_internal.h"
#include "delaunay/threads.h"

namespace delaunay {
namespace {

using Vertices = std::vector<VertexId>;

/// All inserters of a mesh.
class Crew {
 public:
  Crew(Mesh3& mesh, const InsertionOptions& options);

  void start(const std::array<VertexId, 4>& first);
  /// @param round  in the order of insertion
  void insert(std::span<const VertexId> round);
  std::size_t finish();

 private:
  struct Task {
    BowyerWatson3& inserter;
    Vertices vertices;  // to insert; then those put off
  };

  std::vector<BowyerWatson3*> least_used();
  void insert_alone(std::span<const VertexId> vertices);
  void cut_curve(unsigned n_parts);
  void cut_space(const std::array<double, 3>& across,
                 std::span<const VertexId> vertices, unsigned n_parts);
  Vertices insert_in_parts(std::span<const VertexId> vertices,
                           unsigned n_parts);
  bool enter(BowyerWatson3& inserter, const Part& part,
             std::span<const VertexId> vertices);

  Mesh3& mesh_;
  std::size_t min_vertices_;
  std::vector<BowyerWatson3> inserters_;
  std::vector<std::uint8_t> part_of_vertex_;
  CellId near_{};  // any cell
};

Crew::Crew(Mesh3& mesh, const InsertionOptions& options)
    : mesh_(mesh), min_vertices_(options.min_vertices) {
  inserters_.reserve(options.threads);
  for (unsigned i = 0; i < options.threads; ++i)
    inserters_.emplace_back(mesh, i, options.threads);
}

void Crew::start(const std::array<VertexId, 4>& first) {
  inserters_[0].start(first);
}

// At right angles, and to no plane that points are likely to lie in.
constexpr std::array<std::array<double, 3>, 3> kAcross = {
    {{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}};

void Crew::insert(std::span<const VertexId> round) {
  // A thread is worth its start for fewer vertices than in a new round, as the
  // others wait for them. Where most are put off, parts are too small.
  static constexpr std::size_t kRestShare = 16;
  Vertices put_off;
  auto n_parts = static_cast<unsigned>(
      std::min(round.size() / min_vertices_, inserters_.size()));
  for (unsigned pass = 0; pass <= kAcross.size() && n_parts > 1; ++pass) {
    if (pass == 0)
      cut_curve(n_parts);
    else
      cut_space(kAcross[pass - 1], round, n_parts);
    const std::size_t n_before = round.size();
    put_off = insert_in_parts(round, n_parts);
    round = put_off;
    if (n_parts > 2 && 2 * round.size() > n_before) n_parts /= 2;
    n_parts = static_cast<unsigned>(std::min<std::size_t>(
        n_parts, kRestShare * round.size() / min_vertices_));
  }
  insert_alone(round);
}

/// Into intervals of equal length.
void Crew::cut_curve(unsigned n_parts) {
  const std::size_t n = mesh_.sites.size();
  part_of_vertex_.resize(n);
  auto begin = part_of_vertex_.begin();
  for (std::size_t i = 0; i < n_parts; ++i) {
    const auto end = part_of_vertex_.begin() +
                     static_cast<std::ptrdiff_t>(n * (i + 1) / n_parts);
    std::fill(begin, end, static_cast<std::uint8_t>(i));
    begin = end;
  }
}

/// Into slabs with about as many of the vertices each.
void Crew::cut_space(const std::array<double, 3>& across,
                     std::span<const VertexId> vertices, unsigned n_parts) {
  static constexpr std::size_t kSample = 1000;
  const auto height = [&](const Mesh3::Site& s) {
    return across[0] * s.at[0] + across[1] * s.at[1] + across[2] * s.at[2];
  };
  std::vector<double> sample;
  const std::size_t stride = vertices.size() / kSample + 1;
  for (std::size_t i = 0; i < vertices.size(); i += stride)
    sample.push_back(height(mesh_.sites[index(vertices[i])]));
  std::ranges::sort(sample);
  std::vector<double> cuts;
  for (unsigned i = 1; i < n_parts; ++i)
    cuts.push_back(sample[sample.size() * i / n_parts]);

  const std::size_t n = mesh_.sites.size();
  run_tasks(n_parts, n_parts, [&](unsigned i) {
    for (std::size_t v = n * i / n_parts; v < n * (i + 1) / n_parts; ++v) {
      const double h = height(mesh_.sites[v]);
      part_of_vertex_[v] = static_cast<std::uint8_t>(
          std::ranges::count_if(cuts, [h](double cut) { return cut <= h; }));
    }
  });
}

/// Those who used the fewest cells first, so that all use as many in the end.
std::vector<BowyerWatson3*> Crew::least_used() {
  std::vector<BowyerWatson3*> all;
  for (BowyerWatson3& i : inserters_) all.push_back(&i);
  std::ranges::stable_sort(all, {}, [](const auto* i) { return i->end(); });
  return all;
}

void Crew::insert_alone(std::span<const VertexId> vertices) {
  static constexpr std::size_t kTurn = 1024;
  while (!vertices.empty()) {
    BowyerWatson3& inserter = *least_used().front();
    const auto turn = vertices.first(std::min(kTurn, vertices.size()));
    inserter.resume(near_);
    for (const VertexId v : turn) inserter.insert(v);
    near_ = inserter.hint();
    vertices = vertices.subspan(turn.size());
  }
}

/// The cells at a part's first vertices may be another's, so vertices farther
/// and farther from the first are tried.
bool Crew::enter(BowyerWatson3& inserter, const Part& part,
                 std::span<const VertexId> vertices) {
  bool has_entered = false;
  for (std::size_t i = 0; i < vertices.size() && !has_entered; i = 2 * i + 1) {
    has_entered = inserter.enter(part, vertices[i], near_);
    near_ = inserter.hint();
  }
  return has_entered;
}

/// Inserts what it can; returns the others.
Vertices Crew::insert_in_parts(std::span<const VertexId> vertices,
                               unsigned n_parts) {
  std::vector<Vertices> mine(n_parts);
  for (const VertexId v : vertices)
    mine[part_of_vertex_[index(v)]].push_back(v);
  const auto inserters = least_used();
  Vertices put_off;
  std::vector<Task> tasks;
  for (unsigned i = 0; i < n_parts; ++i) {
    const Part part(part_of_vertex_, static_cast<std::uint8_t>(i));
    if (enter(*inserters[i], part, mine[i]))
      tasks.push_back({*inserters[i], std::move(mine[i])});
    else
      put_off.insert(put_off.end(), mine[i].begin(), mine[i].end());
  }
  const auto n_tasks = static_cast<unsigned>(tasks.size());
  run_tasks(n_tasks, n_tasks, [&](unsigned i) {
    Vertices rest;
    for (const VertexId v : tasks[i].vertices)
      if (!tasks[i].inserter.insert_within_part(v)) rest.push_back(v);
    tasks[i].vertices = std::move(rest);
  });

  bool lacks_room = false;
  for (const Task& task : tasks) {
    put_off.insert(put_off.end(), task.vertices.begin(), task.vertices.end());
    lacks_room = lacks_room || task.inserter.lacks_room();
    near_ = task.inserter.hint();
  }
  if (lacks_room) mesh_.make_room(mesh_.cells.size() + 1);
  std::ranges::sort(put_off);
  return put_off;
}

std::size_t Crew::finish() {
  std::size_t end = 0;
  for (const BowyerWatson3& i : inserters_) end = std::max(end, i.end());
  std::vector<CellId> gaps;
  CellId beyond_hull{};
  for (BowyerWatson3& i : inserters_) {
    const auto& more = i.gaps(end);
    gaps.insert(gaps.end(), more.begin(), more.end());
    mesh_.counters += i.counters();
  }
  // Who replaces an infinite cell makes another: so the last one to make some
  // knows one that is still there.
  for (const BowyerWatson3& i : inserters_) {
    const Cell& cell = mesh_.cells[index(i.beyond_hull())];
    if (Mesh3::is_cell(cell) && cell.is_infinite())
      beyond_hull = i.beyond_hull();
  }
  return mesh_.compact(end, std::move(gaps), beyond_hull);
}

}  // namespace

std::size_t insert_all(Mesh3& mesh, const std::array<VertexId, 4>& first,
                       const InsertionOptions& options) {
  Crew crew(mesh, options);
  crew.start(first);
  for (Vertices& round : insertion_rounds(mesh)) {
    std::erase_if(round, [&](VertexId v) {
      return std::ranges::find(first, v) != first.end();
    });
    crew.insert(round);
  }
  return crew.finish();
}

}  // namespace delaunay
