#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kUnmet = kNone - 1;
constexpr std::size_t kBits = 64;

/// By insertion, one after another: it is a handful most often.
template <class Item, class Before>
void sort_few(std::span<Item> items, Before before) {
  constexpr std::size_t kMany = 32;
  if (items.size() > kMany) {
    std::sort(items.begin(), items.end(), before);
    return;
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Item item = items[i];
    std::size_t place = i;
    for (; place > 0 && before(item, items[place - 1]); --place)
      items[place] = items[place - 1];
    items[place] = item;
  }
}

/// The short ones first.
bool is_before(const std::vector<VertexId>& a, const std::vector<VertexId>& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

EssentialLoops::EssentialLoops(std::size_t n_vertices,
                               std::span<const Triangle> triangles,
                               std::span<const Seam> boundary) {
  begin_.assign(n_vertices + 1, 0);
  find_edges(triangles, boundary);
  find_spokes();
  const DualForest entry = dual_forest();
  label_edges(entry, generators(entry));
  step_of_vertex_.assign(n_vertices, kNone);
}

/// By their smaller end, then by the other. The edges of a triangle, ab, ac,
/// bc, come in this order.
void EssentialLoops::find_edges(std::span<const Triangle> triangles,
                                std::span<const Seam> boundary) {
  struct Side {
    VertexId end;
    std::uint32_t face;
  };
  const auto for_each_side = [&](auto visit) {
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
      const auto& [a, b, c] = triangles[f];  // ascending
      visit(a, Side{b, f});
      visit(a, Side{c, f});
      visit(b, Side{c, f});
    }
  };
  std::vector<std::uint32_t> last(begin_.size());
  for_each_side([&](VertexId v, const Side&) { ++last[index(v) + 1]; });
  std::partial_sum(last.begin(), last.end(), last.begin());
  std::vector<Side> sides(3 * triangles.size());
  for_each_side(
      [&](VertexId v, const Side& s) { sides[last[index(v)]++] = s; });

  const auto n_triangles = static_cast<std::uint32_t>(triangles.size());
  edges_of_triangle_.assign(n_triangles, {kNone, kNone, kNone});
  edges_.reserve((sides.size() + boundary.size()) / 2 + 1);
  auto seam = boundary.begin();
  const auto beyond = [&] {
    return n_triangles + (seam == boundary.end() ? 0 : (seam++)->piece);
  };
  std::size_t i = 0;
  for (std::uint32_t v = 0; v + 1 < begin_.size(); ++v) {
    sort_few(std::span(sides).subspan(i, last[v] - i),
             [](const Side& a, const Side& b) { return a.end < b.end; });
    while (i < last[v]) {
      const auto [end, face] = sides[i++];
      const bool is_inner = i < last[v] && sides[i].end == end;
      add_edge(
          {{VertexId{v}, end}, {face, is_inner ? sides[i++].face : beyond()}});
    }
  }
}

void EssentialLoops::add_edge(const Edge& edge) {
  const auto e = static_cast<std::uint32_t>(edges_.size());
  const std::size_t n_triangles = edges_of_triangle_.size();
  for (const std::uint32_t f : edge.faces) {
    if (f < n_triangles) {
      auto& [ab, ac, bc] = edges_of_triangle_[f];
      (ab == kNone ? ab : ac == kNone ? ac : bc) = e;
      continue;
    }
    if (f >= n_faces()) edges_of_piece_.resize(f - n_triangles + 1);
    edges_of_piece_[f - n_triangles].push_back(e);
  }
  edges_.push_back(edge);
}

void EssentialLoops::find_spokes() {
  for (const Edge& edge : edges_)
    for (const VertexId v : edge.ends) ++begin_[index(v) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  spokes_.resize(2 * edges_.size());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const auto& [a, b] = edges_[e].ends;
    spokes_[next[index(a)]++] = {b, e};
    spokes_[next[index(b)]++] = {a, e};
  }
}

/// By face: the edge towards the root, or none.
EssentialLoops::DualForest EssentialLoops::dual_forest() const {
  DualForest entry(n_faces(), kUnmet);
  for (std::uint32_t f = 0; f < n_faces(); ++f)
    if (entry[f] == kUnmet) grow_dual_tree(f, entry);
  return entry;
}

void EssentialLoops::grow_dual_tree(std::uint32_t root,
                                    DualForest& entry) const {
  std::vector<std::uint32_t> queue = {root};
  entry[root] = kNone;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const std::uint32_t e : edges_of(queue[next])) {
      const std::uint32_t beyond = across(queue[next], e);
      if (entry[beyond] != kUnmet) continue;
      entry[beyond] = e;
      queue.push_back(beyond);
    }
}

/// The edges that the dual forest does not cross are a graph that goes wherever
/// the surface does. Without its dangling trees few are left of it, and those
/// in no spanning forest of these are the generators.
std::vector<std::uint32_t> EssentialLoops::generators(
    const DualForest& entry) const {
  std::vector<bool> is_left(edges_.size(), true);
  for (const std::uint32_t e : entry)
    if (e != kNone) is_left[e] = false;
  prune(is_left);
  DisjointSets sets(begin_.size() - 1);
  std::vector<std::uint32_t> result;
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    if (is_left[e] &&
        !sets.unite(index(edges_[e].ends[0]), index(edges_[e].ends[1])))
      result.push_back(e);
  return result;
}

/// Takes the last edge at a vertex off, as long as there is one. The XOR of the
/// edges at a vertex tells which it is.
void EssentialLoops::prune(std::vector<bool>& is_left) const {
  struct Edges {
    std::uint32_t count = 0, sum = 0;
  };
  std::vector<Edges> at(begin_.size() - 1);
  const auto toggle = [&](std::uint32_t e, std::uint32_t change) {
    for (const VertexId v : edges_[e].ends) {
      at[index(v)].count += change;  // wraps: minus one
      at[index(v)].sum ^= e;
    }
  };
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    if (is_left[e]) toggle(e, 1);
  for (std::size_t start = 0; start < at.size(); ++start)
    for (std::size_t v = start; at[v].count == 1;) {
      const std::uint32_t e = at[v].sum;
      is_left[e] = false;
      toggle(e, ~0U);
      const auto& [a, b] = edges_[e].ends;
      v = index(a) == v ? index(b) : index(a);
    }
}

/// The cycle of a generator's dual edge: the ways from its faces to the root.
/// What both have in common they take back.
void EssentialLoops::label_edges(const DualForest& entry,
                                 std::span<const std::uint32_t> generators) {
  n_generators_ = generators.size();
  n_words_ = (n_generators_ + kBits - 1) / kBits;
  row_of_edge_.assign(edges_.size(), kNoLabel);
  for (std::size_t g = 0; g < n_generators_; ++g) {
    toggle(generators[g], g);
    for (const std::uint32_t f : edges_[generators[g]].faces)
      toggle_way_up(f, entry, g);
  }
}

void EssentialLoops::toggle_way_up(std::uint32_t face, const DualForest& entry,
                                   std::size_t generator) {
  for (; entry[face] != kNone; face = across(face, entry[face]))
    toggle(entry[face], generator);
}

void EssentialLoops::toggle(std::uint32_t edge, std::size_t generator) {
  std::uint32_t& row = row_of_edge_[edge];
  if (row == kNoLabel) {
    row = static_cast<std::uint32_t>(labelled_.size());
    labelled_.push_back(edge);
    label_.resize(label_.size() + n_words_);
  }
  label_[row * n_words_ + generator / kBits] ^= Word{1} << (generator % kBits);
}

/// The smaller ends of labelled edges, ascending.
std::vector<VertexId> EssentialLoops::labelled_ends() const {
  std::vector<VertexId> result;
  for (const std::uint32_t e : labelled_) {
    const auto words = label(e);
    if (std::any_of(words.begin(), words.end(),
                    [](Word word) { return word != 0; }))
      result.push_back(edges_[e].ends[0]);
  }
  sort_unique(result);
  return result;
}

/// With all vertices within so many edges; ascending.
std::vector<VertexId> EssentialLoops::widened(
    std::span<const VertexId> vertices, unsigned n_edges) const {
  std::vector<bool> is_met(begin_.size() - 1);
  std::vector<VertexId> result;
  const auto enter = [&](VertexId v) {
    if (!is_met[index(v)]) result.push_back(v);
    is_met[index(v)] = true;
  };
  for (const VertexId v : vertices) enter(v);
  std::size_t next = 0;
  for (unsigned ring = 0; ring < n_edges; ++ring)
    for (const std::size_t end = result.size(); next < end; ++next)
      for (const Spoke& spoke : spokes(result[next])) enter(spoke.end);
  std::sort(result.begin(), result.end());
  return result;
}

bool EssentialLoops::has_loop(unsigned max_edges) {
  const std::vector<VertexId> starts = labelled_ends();
  return std::any_of(starts.begin(), starts.end(), [&](VertexId v) {
    return !shortest_through(v, max_edges).vertices.empty();
  });
}

/// An essential loop has a labelled edge. So it goes through the smaller end of
/// one, and no vertex of it is more than half its length away from that end.
EssentialLoops::Found EssentialLoops::shortest(unsigned max_edges) {
  std::vector<VertexId> starts = labelled_ends();
  std::erase_if(starts, [&](VertexId v) {
    return shortest_through(v, max_edges).vertices.empty();
  });
  if (starts.empty()) return {};
  return shortest(widened(starts, max_edges / 2), max_edges);
}

EssentialLoops::Found EssentialLoops::shortest(std::span<const VertexId> starts,
                                               unsigned max_edges) {
  return sort_out(shortest_through(starts, max_edges));
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
  walk(start, max_edges / 2);
  unsigned best = max_edges + 1;
  std::array<std::uint32_t, 2> last = {0, 0};
  std::uint32_t last_edge = 0;
  for (std::uint32_t a = 0; a < steps_.size(); ++a)
    for (const auto& [end, edge] : spokes(steps_[a].vertex)) {
      const std::uint32_t b = step_of_vertex_[index(end)];
      if (b == kNone || b <= a) continue;
      const unsigned length = steps_[a].depth + steps_[b].depth + 1;
      if (length >= best || !is_essential(a, b, edge)) continue;
      best = length;
      last = {a, b};
      last_edge = edge;
    }
  Loop loop;
  if (best <= max_edges) {
    std::vector<VertexId>& vertices = loop.vertices;
    for (std::uint32_t at : last) {
      for (; at != 0; at = steps_[at].from)
        vertices.push_back(steps_[at].vertex);
    }
    vertices.push_back(start);
    sort_unique(vertices);
    loop.label = label_of_loop(last[0], last[1], last_edge);
  }
  for (const Step& step : steps_) step_of_vertex_[index(step.vertex)] = kNone;
  return loop;
}

/// To all vertices within so many edges; the start is step 0.
void EssentialLoops::walk(VertexId start, unsigned max_depth) {
  steps_ = {{start, 0, 0}};
  label_of_step_.assign(n_words_, 0);
  step_of_vertex_[index(start)] = 0;
  for (std::uint32_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].depth == max_depth) break;
    for (const auto& [end, edge] : spokes(steps_[i].vertex)) {
      if (step_of_vertex_[index(end)] != kNone) continue;
      step_of_vertex_[index(end)] = static_cast<std::uint32_t>(steps_.size());
      steps_.push_back({end, i, steps_[i].depth + 1});
      for (std::size_t w = 0; w < n_words_; ++w)
        label_of_step_.push_back(label_of_step_[i * n_words_ + w]);
      const auto words = label(edge);
      for (std::size_t w = 0; w < words.size(); ++w)
        label_of_step_[label_of_step_.size() - n_words_ + w] ^= words[w];
    }
  }
}

/// The label of the loop that the edge between two steps closes.
std::vector<EssentialLoops::Word> EssentialLoops::label_of_loop(
    std::size_t a, std::size_t b, std::uint32_t edge) const {
  std::vector<Word> result(n_words_);
  const auto words = label(edge);
  for (std::size_t w = 0; w < n_words_; ++w)
    result[w] = label_of_step_[a * n_words_ + w] ^
                label_of_step_[b * n_words_ + w] ^
                (words.empty() ? 0 : words[w]);
  return result;
}

/// Whether the loop that the edge between two steps closes does not bound.
bool EssentialLoops::is_essential(std::size_t a, std::size_t b,
                                  std::uint32_t edge) const {
  const auto words = label(edge);
  for (std::size_t w = 0; w < n_words_; ++w)
    if ((label_of_step_[a * n_words_ + w] ^ label_of_step_[b * n_words_ + w]) !=
        (words.empty() ? 0 : words[w]))
      return true;
  return false;
}

}  // namespace umbrella
