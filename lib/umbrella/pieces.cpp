#include <algorithm>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/pieces_internal.h"

namespace umbrella {

std::vector<Piece> PieceFinder::find(const Change& change,
                                     const std::vector<bool>& is_open) {
  const auto& [freed, chosen, vertices] = change;
  if (is_in_patch_.empty()) find_large_patches(is_open);
  if (breaks_patch(freed)) is_in_patch_.assign(surface_.n_vertices(), false);
  is_freed_.resize(surface_.n_indices());
  for (const TriangleIndex t : freed) is_freed_[t] = true;
  corners_.clear();
  for (std::uint32_t t = 0; t < chosen.size(); ++t)
    for (const VertexId v : chosen[t].corners) corners_.push_back({v, t});
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) {
              return a.vertex != b.vertex ? a.vertex < b.vertex
                                          : a.triangle < b.triangle;
            });

  std::vector<Piece> pieces;
  n_pieces_ = kLarge;
  for (const LocatedTriangle& t : chosen) {
    const VertexId start = t.corners[0];
    if (piece_of_[index(start)] != kNotReached) continue;
    Piece piece;
    if (explore(start, change, is_open, piece)) pieces.push_back(piece);
  }
  for (const VertexId v : reached_) piece_of_[index(v)] = kNotReached;
  reached_.clear();
  for (const TriangleIndex t : freed) is_freed_[t] = false;
  return pieces;
}

void PieceFinder::find_large_patches(const std::vector<bool>& is_open) {
  const std::size_t n = surface_.n_vertices();
  DisjointSets sets(n);
  std::vector<std::uint32_t> n_triangles(n);  // at the corner, then in the set
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t) {
    const auto& [a, b, c] = surface_.corners(t);
    if (!surface_.contains(t) || is_open[index(a)] || is_open[index(b)] ||
        is_open[index(c)])
      continue;
    sets.unite(index(a), index(b));
    sets.unite(index(a), index(c));
    ++n_triangles[index(a)];
  }
  sets.add_at_roots(n_triangles);
  is_in_patch_.resize(n);
  for (std::size_t v = 0; v < n; ++v)
    is_in_patch_[v] = n_triangles[sets.root(v)] > limit_;
}

bool PieceFinder::breaks_patch(std::span<const TriangleIndex> freed) const {
  return std::any_of(freed.begin(), freed.end(), [this](TriangleIndex t) {
    return is_in_patch_[index(surface_.corners(t)[0])];
  });
}

/// Calls visit for each triangle at v on the changed surface. @return whether a
///   chosen one is among them
template <class Visit>
bool PieceFinder::for_each_at(VertexId v, const Change& change,
                              Visit visit) const {
  surface_.for_each_at(v, [&](TriangleIndex t) {
    if (!is_freed_[t]) visit(surface_.corners(t));
  });
  const auto first = std::lower_bound(
      corners_.begin(), corners_.end(), v,
      [](const Corner& c, VertexId wanted) { return c.vertex < wanted; });
  auto at = first;
  for (; at != corners_.end() && at->vertex == v; ++at)
    visit(change.chosen[at->triangle].corners);
  return at != first;
}

/// Walks over all triangles that hang together with `start`; stops as soon as
/// they are too many, or are known to be. @return whether the piece is small
bool PieceFinder::explore(VertexId start, const Change& change,
                          const std::vector<bool>& is_open, Piece& piece) {
  const std::uint32_t name = ++n_pieces_;
  const std::size_t first = reached_.size();
  bool is_large = false;
  const auto enter = [&](VertexId v) {
    std::uint32_t& known = piece_of_[index(v)];
    const bool waits =
        is_open[index(v)] &&
        !std::binary_search(change.vertices.begin(), change.vertices.end(), v);
    is_large = is_large || known == kLarge || is_in_patch_[index(v)] || waits;
    if (known != kNotReached) return;
    known = name;
    reached_.push_back(v);
  };
  enter(start);
  for (std::size_t i = first; i < reached_.size() && !is_large; ++i) {
    const VertexId v = reached_[i];
    const bool has_chosen = for_each_at(v, change, [&](const Triangle& t) {
      for (const VertexId corner : t) enter(corner);
      if (t[0] == v) ++piece.n_triangles;  // each is met at three corners
    });
    if (has_chosen) piece.vertices.push_back(v);
    is_large = is_large || piece.n_triangles > limit_;
  }
  if (is_large)
    for (std::size_t i = first; i < reached_.size(); ++i)
      piece_of_[index(reached_[i])] = kLarge;
  std::sort(piece.vertices.begin(), piece.vertices.end());
  if (!is_large)
    piece.all_vertices.assign(
        reached_.begin() + static_cast<std::ptrdiff_t>(first), reached_.end());
  return !is_large;
}

}  // namespace umbrella
