#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "umbrella/essential_loops_internal.h"
#include "umbrella/sort_unique_internal.h"
#include "umbrella/widened_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The short ones first.
bool is_before(const std::vector<VertexId>& a, const std::vector<VertexId>& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

/// All sums of some labels. In each row the first bit stands that no row before
/// has left there.
class Sums {
 public:
  using Label = std::vector<EdgeLabels::Word>;

  /// @return whether the label is no sum of those added before
  bool add(Label label) {
    for (const auto& [first, row] : rows_)
      if (has_bit(label, first))
        for (std::size_t w = 0; w < label.size(); ++w) label[w] ^= row[w];
    const std::size_t n_bits = EdgeLabels::kBits * label.size();
    std::size_t first = 0;
    while (first < n_bits && !has_bit(label, first)) ++first;
    if (first == n_bits) return false;
    rows_.push_back({first, std::move(label)});
    return true;
  }

 private:
  struct Row {
    std::size_t first;
    Label label;
  };
  static bool has_bit(const Label& label, std::size_t i) {
    return (label[i / EdgeLabels::kBits] >> (i % EdgeLabels::kBits) & 1U) != 0;
  }

  std::vector<Row> rows_;
};

}  // namespace

EssentialLoops::EssentialLoops(std::size_t n_vertices,
                               std::span<const Triangle> triangles,
                               std::span<const Seam> boundary)
    : labels_(n_vertices, triangles, boundary),
      step_of_vertex_(n_vertices, kNone) {}

bool EssentialLoops::has_loop(unsigned max_edges) {
  const std::vector<VertexId> starts = labels_.labelled_ends();
  return std::any_of(starts.begin(), starts.end(), [&](VertexId v) {
    return !shortest_through(v, max_edges).vertices.empty();
  });
}

/// An essential loop has a labelled edge. So it goes through the smaller end of
/// one.
std::vector<VertexId> EssentialLoops::starts(unsigned max_edges) {
  std::vector<VertexId> starts = labels_.labelled_ends();
  std::erase_if(starts, [&](VertexId v) {
    return shortest_through(v, max_edges).vertices.empty();
  });
  return starts;
}

/// No vertex of a loop is more than half its length away from where it starts.
EssentialLoops::Found EssentialLoops::shortest(unsigned max_edges) {
  const std::vector<VertexId> ends = starts(max_edges);
  if (ends.empty()) return {};
  const auto near = widened(labels_.n_vertices(), ends, max_edges / 2,
                            [this](VertexId v, const auto& enter) {
                              for (const Spoke& spoke : labels_.spokes(v))
                                enter(spoke.end);
                            });
  return shortest(near, max_edges);
}

EssentialLoops::Found EssentialLoops::shortest(std::span<const VertexId> starts,
                                               unsigned max_edges) {
  return sort_out(shortest_through(starts, max_edges));
}

std::vector<EssentialLoops::Loops> EssentialLoops::independent(
    unsigned max_edges, std::size_t n_alike) {
  std::vector<Loop> loops =
      shortest_through(labels_.labelled_ends(), max_edges);
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return is_before(a.vertices, b.vertices);
  });
  std::vector<Loops> result;
  std::map<std::vector<Word>, std::size_t> place;  // by label, in the result
  Sums sums;
  for (Loop& loop : loops) {
    if (sums.add(loop.label)) {
      place.emplace(loop.label, result.size());
      result.emplace_back();
    }
    const auto found = place.find(loop.label);
    if (found == place.end()) continue;
    Loops& alike = result[found->second];
    if (alike.size() < n_alike &&
        (alike.empty() || alike.back() != loop.vertices))
      alike.push_back(std::move(loop.vertices));
  }
  return result;
}

EssentialLoops::Found EssentialLoops::sort_out(std::vector<Loop> loops) {
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    if (a.label != b.label) return a.label < b.label;
    return is_before(a.vertices, b.vertices);
  });
  Found found;
  for (const Loop& loop : loops)
    found.vertices.insert(found.vertices.end(), loop.vertices.begin(),
                          loop.vertices.end());
  for (auto first = loops.begin(); first != loops.end();) {
    const auto last = std::find_if(first, loops.end(), [&](const Loop& loop) {
      return loop.label != first->label;
    });
    if (!go_round_tube({first, last}))
      for (auto loop = first; loop != last; ++loop)
        found.loops.push_back(std::move(loop->vertices));
    first = last;
  }
  sort_unique(found.loops, is_before);
  sort_unique(found.vertices);
  return found;
}

/// Counts loops of one class that have no vertex in common: the first, and each
/// that does not meet one counted before.
bool EssentialLoops::go_round_tube(std::span<const Loop> loops) {
  std::size_t n = 0;
  const auto is_met = [this](VertexId v) {
    return step_of_vertex_[index(v)] != kNone;
  };
  for (const auto& [vertices, label] : loops) {
    if (std::any_of(vertices.begin(), vertices.end(), is_met)) continue;
    ++n;
    for (const VertexId v : vertices) step_of_vertex_[index(v)] = 0;
  }
  for (const auto& [vertices, label] : loops)
    for (const VertexId v : vertices) step_of_vertex_[index(v)] = kNone;
  return n >= kTube;
}

std::vector<EssentialLoops::Loop> EssentialLoops::shortest_through(
    std::span<const VertexId> starts, unsigned max_edges) {
  std::vector<Loop> loops;
  for (const VertexId v : starts) {
    loops.push_back(shortest_through(v, max_edges));
    if (loops.back().vertices.empty()) loops.pop_back();
  }
  return loops;
}

EssentialLoops::Loop EssentialLoops::shortest_through(VertexId start,
                                                      unsigned max_edges) {
  const Closing closing = walk(start, max_edges);
  Loop loop;
  if (closing.n_edges <= max_edges) {
    std::vector<VertexId>& vertices = loop.vertices;
    for (std::uint32_t at : closing.steps) {
      for (; at != 0; at = steps_[at].from)
        vertices.push_back(steps_[at].vertex);
    }
    vertices.push_back(start);
    sort_unique(vertices);
    const auto [a, b] = closing.steps;
    loop.label = label_of_loop(a, b, closing.edge);
  }
  for (const Step& step : steps_) step_of_vertex_[index(step.vertex)] = kNone;
  return loop;
}

/// From the start, which is step 0, no farther than a loop leads that is
/// shorter than those found. The first of the shortest ones is kept.
EssentialLoops::Closing EssentialLoops::walk(VertexId start,
                                             unsigned max_edges) {
  Closing best = {{0, 0}, 0, max_edges + 1};
  steps_ = {{start, 0, 0}};
  label_of_step_.assign(labels_.n_words(), 0);
  step_of_vertex_[index(start)] = 0;
  for (std::uint32_t a = 0; a < steps_.size(); ++a) {
    const unsigned depth = steps_[a].depth;
    if (2 * depth + 1 >= best.n_edges) break;
    for (const Spoke& spoke : labels_.spokes(steps_[a].vertex)) {
      const std::uint32_t b = step_of_vertex_[index(spoke.end)];
      if (b == kNone) {
        if (2 * depth + 2 < best.n_edges) enter(a, spoke);
        continue;
      }
      const unsigned n_edges = depth + steps_[b].depth + 1;
      if (b > a && n_edges < best.n_edges && is_essential(a, b, spoke.edge))
        best = {{a, b}, spoke.edge, n_edges};
    }
  }
  return best;
}

/// A vertex not met before, along an edge from a step.
void EssentialLoops::enter(std::uint32_t from, const Spoke& spoke) {
  step_of_vertex_[index(spoke.end)] = static_cast<std::uint32_t>(steps_.size());
  steps_.push_back({spoke.end, from, steps_[from].depth + 1});
  const std::size_t n_words = labels_.n_words();
  for (std::size_t w = 0; w < n_words; ++w)
    label_of_step_.push_back(label_of_step_[from * n_words + w]);
  const auto words = labels_.label(spoke.edge);
  for (std::size_t w = 0; w < words.size(); ++w)
    label_of_step_[label_of_step_.size() - n_words + w] ^= words[w];
}

/// The label of the loop that the edge between two steps closes.
std::vector<EssentialLoops::Word> EssentialLoops::label_of_loop(
    std::size_t a, std::size_t b, std::uint32_t edge) const {
  std::vector<Word> result(labels_.n_words());
  const auto words = labels_.label(edge);
  for (std::size_t w = 0; w < labels_.n_words(); ++w)
    result[w] = label_of_step_[a * labels_.n_words() + w] ^
                label_of_step_[b * labels_.n_words() + w] ^
                (words.empty() ? 0 : words[w]);
  return result;
}

/// Whether the loop that the edge between two steps closes does not bound.
bool EssentialLoops::is_essential(std::size_t a, std::size_t b,
                                  std::uint32_t edge) const {
  const auto words = labels_.label(edge);
  for (std::size_t w = 0; w < labels_.n_words(); ++w)
    if ((label_of_step_[a * labels_.n_words() + w] ^
         label_of_step_[b * labels_.n_words() + w]) !=
        (words.empty() ? 0 : words[w]))
      return true;
  return false;
}

}  // namespace umbrella
