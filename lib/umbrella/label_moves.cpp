#include <algorithm>
#include <array>
#include <bit>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/label_moves_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;

std::vector<VertexId> unused_vertices(const Labelling& labels) {
  std::vector<VertexId> result;
  const std::size_t n = labels.triangulation().points().size();
  for (std::uint32_t v = 0; v < n; ++v)
    if (!labels.is_used(VertexId{v})) result.push_back(VertexId{v});
  return result;
}

void LabelMoves::flip(CellId c) {
  labels_.flip(c);
  flipped_.push_back(c);
}

/// Whether the corner opposite the facet could come to the surface.
void LabelMoves::consider(Facet facet) {
  const Cell& cell = labels_.cell(facet.cell());
  if (cell.is_infinite() || labels_.is_used(cell.vertex[facet.index()]) ||
      !labels_.is_on_surface(facet))
    return;
  double worst = 0;
  for (unsigned i = 0; i < 4; ++i)
    if (i != facet.index())
      worst = std::max(worst, frame_.badness(Facet(facet.cell(), i)));
  gains_.push({frame_.is_kept(facet), worst - frame_.badness(facet), facet});
}

std::size_t LabelMoves::bring_in(std::span<const VertexId> vertices) {
  gains_ = {};
  for (const VertexId v : vertices) {
    labels_.find_parts(v, parts_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const CellId c : parts_[p].cells) {
        const auto& corner = labels_.cell(c).vertex;
        const auto at = std::find(corner.begin(), corner.end(), v);
        consider(Facet(c, static_cast<unsigned>(at - corner.begin())));
      }
  }
  std::size_t n = 0;
  while (!gains_.empty()) {
    const Facet facet = gains_.top().facet;
    gains_.pop();
    const CellId c = facet.cell();
    if (labels_.is_used(labels_.cell(c).vertex[facet.index()]) ||
        !labels_.is_on_surface(facet))
      continue;
    ++n;
    flip(c);
    for (unsigned i = 0; i < 4; ++i)
      if (i != facet.index()) consider(labels_.cell(c).neighbor[i]);
  }
  return n;
}

void LabelMoves::take_back() {
  for (; !flipped_.empty(); flipped_.pop_back()) labels_.flip(flipped_.back());
}

std::size_t LabelMoves::reach(std::span<const VertexId> vertices) {
  std::size_t n = 0;
  for (const VertexId v : vertices)
    if (!labels_.is_used(v)) n += reach(v);
  return n;
}

std::size_t LabelMoves::reach(VertexId v) {
  find_surroundings(v);
  if (labels_.has_left_window()) return 0;
  const bool side = labels_.is_inside(near_.front());
  flipped_.clear();
  std::size_t n = 0;
  for (std::size_t next = 0; next < near_.size() && !labels_.is_used(v);) {
    const CellId c = near_[next++];
    if (labels_.is_inside(c) != side || !can_switch(c)) continue;
    n += std::popcount(labels_.surface_facets(c)) == 1 ? 1 : 0;
    flip(c);
    next = 0;  // nearer cells may have become free
  }
  if (labels_.is_used(v)) return n;
  take_back();
  return 0;
}

/// The star of v and cells about it up to the surface, none beyond the hull.
void LabelMoves::find_surroundings(VertexId v) {
  constexpr std::size_t kMaxCells = 200;
  ++n_searches_;
  near_.clear();
  const auto enter = [this](CellId c) {
    if (labels_.cell(c).is_infinite() || met_[index(c)] == n_searches_) return;
    met_[index(c)] = n_searches_;
    near_.push_back(c);
    if (labels_.is_at_border(c)) labels_.leave_window();
  };
  labels_.find_parts(v, parts_);
  for (const CellId c : parts_[0].cells) enter(c);
  const std::size_t most = near_.size() + kMaxCells;
  for (std::size_t next = 0; next < near_.size() && near_.size() < most; ++next)
    for (unsigned i = 0; i < 4; ++i)
      if (!labels_.is_on_surface(Facet(near_[next], i)))
        enter(labels_.cell(near_[next]).neighbor[i].cell());
}

/// Whether the surface stays manifold, and no point leaves it.
bool LabelMoves::can_switch(CellId c) const {
  const unsigned facets = labels_.surface_facets(c);
  const auto i = static_cast<unsigned>(std::countr_zero(facets));
  const auto k = static_cast<unsigned>(std::bit_width(facets)) - 1;
  switch (std::popcount(facets)) {
    case 1:
      return !labels_.is_used(labels_.cell(c).vertex[i]);
    case 2:  // opposite their common edge are the corners that they lack
      return !labels_.is_edge_used(c, i, k);
    default:
      return false;
  }
}

std::size_t LabelMoves::dissolve(std::size_t largest) {
  const std::vector<LocatedTriangle> surface = labels_.surface();
  DisjointSets sets(labels_.triangulation().points().size());
  for (const LocatedTriangle& t : surface) {
    sets.unite(index(t.corners[0]), index(t.corners[1]));
    sets.unite(index(t.corners[0]), index(t.corners[2]));
  }
  std::vector<std::size_t> size(labels_.triangulation().points().size());
  for (const LocatedTriangle& t : surface)
    ++size[sets.root(index(t.corners[0]))];
  // Small pieces are few: sorted by their root, then by corners.
  std::vector<std::pair<std::uint32_t, LocatedTriangle>> small;
  for (const LocatedTriangle& t : surface) {
    const std::uint32_t root = sets.root(index(t.corners[0]));
    if (size[root] <= largest) small.emplace_back(root, t);
  }
  std::stable_sort(
      small.begin(), small.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t n = 0;
  std::vector<LocatedTriangle> piece;
  for (std::size_t i = 0; i < small.size(); ++i) {
    piece.push_back(small[i].second);
    if (i + 1 < small.size() && small[i + 1].first == small[i].first) continue;
    if (dissolve(piece)) n += piece.size();
    piece.clear();
  }
  return n;
}

bool LabelMoves::dissolve(std::span<const LocatedTriangle> piece) {
  std::vector<VertexId> corners;
  for (const LocatedTriangle& t : piece) {
    // It may have grown or be gone since it was found.
    if (!frame_.is_open(t.facet) || !labels_.is_on_surface(t.facet))
      return false;
    corners.insert(corners.end(), t.corners.begin(), t.corners.end());
  }
  sort_unique(corners);
  const Facet facet = piece.front().facet;
  const CellId beyond =
      labels_.cell(facet.cell()).neighbor[facet.index()].cell();
  if (!find_enclosed(facet.cell(), piece.size()) &&
      !find_enclosed(beyond, piece.size()))
    return false;
  flipped_.clear();
  for (const CellId c : enclosed_) flip(c);
  bring_in(corners);
  const bool all_are_back =
      std::all_of(corners.begin(), corners.end(),
                  [this](VertexId v) { return labels_.is_used(v); });
  if (all_are_back) return true;
  take_back();
  return false;
}

/// The cells about `start` up to the surface; whether they are few, and the
/// surface about them is a piece of n_walls triangles. A piece that can be
/// taken away has open corners only; with one at the border there are others as
/// well.
bool LabelMoves::find_enclosed(CellId start, std::size_t n_walls) {
  constexpr std::size_t kMaxCells = 64;
  enclosed_ = {start};
  std::size_t n_met = 0;
  for (std::size_t next = 0; next < enclosed_.size(); ++next) {
    const CellId c = enclosed_[next];
    if (labels_.cell(c).is_infinite() || next >= kMaxCells ||
        labels_.is_at_border(c))
      return false;
    for (unsigned i = 0; i < 4; ++i) {
      const CellId beyond = labels_.cell(c).neighbor[i].cell();
      if (labels_.is_on_surface(Facet(c, i)))
        ++n_met;
      else if (std::find(enclosed_.begin(), enclosed_.end(), beyond) ==
               enclosed_.end())
        enclosed_.push_back(beyond);
    }
  }
  return n_met == n_walls;
}

std::size_t LabelMoves::exchange() {
  std::vector<CellId> work;
  for (auto c =
           static_cast<std::uint32_t>(labels_.triangulation().n_finite_cells());
       c-- > 0;)
    if (frame_.is_open(CellId{c}) &&
        std::popcount(labels_.surface_facets(CellId{c})) == 2)
      work.push_back(CellId{c});
  std::size_t n = 0;
  while (!work.empty()) {
    const CellId c = work.back();
    work.pop_back();
    if (!try_exchange(c)) continue;
    ++n;
    for (const Facet f : labels_.cell(c).neighbor) work.push_back(f.cell());
  }
  return n;
}

bool LabelMoves::try_exchange(CellId c) {
  const unsigned facets = labels_.surface_facets(c);
  if (std::popcount(facets) != 2 || !frame_.is_open(c)) return false;
  for (unsigned i = 0; i < 4; ++i)
    if ((facets >> i & 1U) != 0 && frame_.is_kept(Facet(c, i))) return false;
  if (!is_better(c, facets) || !can_switch(c)) return false;
  labels_.flip(c);
  return true;
}

/// The other two facets instead of these, by the worse, then by the better.
bool LabelMoves::is_better(CellId c, unsigned facets) const {
  std::array<double, 2> old{}, fresh{};
  std::size_t n_old = 0, n_fresh = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const double badness = frame_.badness(Facet(c, i));
    if ((facets >> i & 1U) != 0)
      old[n_old++] = badness;
    else
      fresh[n_fresh++] = badness;
  }
  std::sort(old.rbegin(), old.rend());
  std::sort(fresh.rbegin(), fresh.rend());
  return fresh < old;
}

}  // namespace umbrella
