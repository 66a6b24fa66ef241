#include <algorithm>
#include <limits>
#include <numeric>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/edge_labels_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kUnmet = kNone - 1;

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

}  // namespace

EdgeLabels::EdgeLabels(std::size_t n_vertices,
                       std::span<const Triangle> triangles,
                       std::span<const Seam> boundary) {
  begin_.assign(n_vertices + 1, 0);
  find_edges(triangles, boundary);
  find_spokes();
  const DualForest entry = dual_forest();
  label_edges(entry, generators(entry));
}

/// By their smaller end, then by the other. The edges of a triangle, ab, ac,
/// bc, come in this order.
void EdgeLabels::find_edges(std::span<const Triangle> triangles,
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

void EdgeLabels::add_edge(const Edge& edge) {
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

void EdgeLabels::find_spokes() {
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
EdgeLabels::DualForest EdgeLabels::dual_forest() const {
  DualForest entry(n_faces(), kUnmet);
  for (std::uint32_t f = 0; f < n_faces(); ++f)
    if (entry[f] == kUnmet) grow_dual_tree(f, entry);
  return entry;
}

void EdgeLabels::grow_dual_tree(std::uint32_t root, DualForest& entry) const {
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
std::vector<std::uint32_t> EdgeLabels::generators(
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
void EdgeLabels::prune(std::vector<bool>& is_left) const {
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
void EdgeLabels::label_edges(const DualForest& entry,
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

void EdgeLabels::toggle_way_up(std::uint32_t face, const DualForest& entry,
                               std::size_t generator) {
  for (; entry[face] != kNone; face = across(face, entry[face]))
    toggle(entry[face], generator);
}

void EdgeLabels::toggle(std::uint32_t edge, std::size_t generator) {
  std::uint32_t& row = row_of_edge_[edge];
  if (row == kNoLabel) {
    row = static_cast<std::uint32_t>(labelled_.size());
    labelled_.push_back(edge);
    label_.resize(label_.size() + n_words_);
  }
  label_[row * n_words_ + generator / kBits] ^= Word{1} << (generator % kBits);
}

std::vector<VertexId> EdgeLabels::labelled_ends() const {
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

}  // namespace umbrella
