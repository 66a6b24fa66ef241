/// @file
/// Vertices are numbered along a Hilbert curve, so an interval of numbers is a
/// compact piece of space. Each of several inserters gets such a part and may
/// change only cells whose corners all lie in it; vertices whose cavity holds
/// another cell are put off [Marot19, Sec. 3]. Those lie along the seams
/// between parts, and most can be inserted after the seams have moved; the few
/// that remain are inserted by one thread.
///
/// What an inserter may do keeps it from all that another may write
/// (docs/delaunay.md, "Threads"), so there is neither lock nor atomic variable,
/// and the result does not depend on timing.
#include <algorithm>
#include <utility>
#include <vector>

#include "delaunay/bowyer_watson3_internal.h"
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
  /// @param round  ascending
  void insert(Vertices round);
  std::size_t finish();

 private:
  struct Task {
    BowyerWatson3& inserter;
    Vertices vertices;  // to insert; then those put off
  };

  std::vector<BowyerWatson3*> least_used();
  void insert_alone(std::span<const VertexId> vertices);
  Vertices insert_in_parts(std::span<const VertexId> vertices, unsigned n_parts,
                           double shift);
  bool enter(BowyerWatson3& inserter, const Part& part,
             std::span<const VertexId> vertices);

  Mesh3& mesh_;
  std::size_t min_vertices_;
  std::vector<BowyerWatson3> inserters_;
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

void Crew::insert(Vertices round) {
  // The second pass, with its seams elsewhere, is for the vertices at the
  // seams of the first; what is left lies where seams meet, and needs ever
  // fewer parts.
  static constexpr std::size_t kRestShare = 16;
  auto n_parts = static_cast<unsigned>(
      std::min(round.size() / min_vertices_, inserters_.size()));
  for (unsigned pass = 0; n_parts > 1; ++pass) {
    round = insert_in_parts(round, n_parts, pass == 0 ? 0 : 1.0 / (pass + 1));
    if (pass > 0) n_parts /= 2;
    while (kRestShare * round.size() < n_parts * min_vertices_) n_parts /= 2;
  }
  insert_alone(round);
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

/// The cells at a part's first vertices may cross a seam, so vertices farther
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
                               unsigned n_parts, double shift) {
  const auto boundary = [&](unsigned i) {
    return static_cast<std::uint32_t>(static_cast<double>(mesh_.sites.size()) *
                                      (i % n_parts + shift) / n_parts);
  };
  const auto inserters = least_used();
  Vertices put_off;
  std::vector<Task> tasks;
  for (unsigned i = 0; i < n_parts; ++i) {
    const Part part(boundary(i), boundary(i + 1));
    Vertices mine = part.select(vertices);
    if (enter(*inserters[i], part, mine))
      tasks.push_back({*inserters[i], std::move(mine)});
    else
      put_off.insert(put_off.end(), mine.begin(), mine.end());
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
  for (BowyerWatson3& i : inserters_) i.remove_unused(end);
  return mesh_.compact(end);
}

}  // namespace

std::size_t insert_all(Mesh3& mesh, const std::array<VertexId, 4>& first,
                       std::span<const VertexId> order,
                       const InsertionOptions& options) {
  Crew crew(mesh, options);
  crew.start(first);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::is_sorted_until(begin, order.end());
    Vertices round(begin, end);
    std::erase_if(round, [&](VertexId v) {
      return std::ranges::find(first, v) != first.end();
    });
    crew.insert(std::move(round));
    begin = end;
  }
  return crew.finish();
}

}  // namespace delaunay
