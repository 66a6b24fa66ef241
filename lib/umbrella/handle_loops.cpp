// About a few places of a closed surface: the rest of it falls into pieces, and
// the boundary of each piece bounds. By the exact sequence of the pair these
// are all relations that the triangles here do not know of themselves.
#include <algorithm>
#include <iterator>
#include <utility>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/handle_loops_internal.h"
#include "umbrella/sort_unique_internal.h"
#include "umbrella/widened_internal.h"

namespace umbrella {
namespace {

using Seam = EssentialLoops::Seam;
using Vertices = std::vector<VertexId>;

Vertices widened(const WorkingSurface& surface,
                 std::span<const VertexId> vertices, unsigned n_edges) {
  return umbrella::widened(surface.n_vertices(), vertices, n_edges,
                           [&](VertexId v, const auto& enter) {
                             surface.for_each_at(v, [&](TriangleIndex t) {
                               for (const VertexId corner : surface.corners(t))
                                 enter(corner);
                             });
                           });
}

/// Triangles of which each has a corner among some vertices.
struct Near {
  Vertices inner;   // these; ascending
  Vertices border;  // their other corners; ascending
  std::vector<Triangle> triangles;
};

Near near_triangles(const WorkingSurface& surface, Vertices inner) {
  Near near = {std::move(inner), {}, {}};
  const auto is_inner = [&](VertexId v) {
    return std::binary_search(near.inner.begin(), near.inner.end(), v);
  };
  for (const VertexId v : near.inner)
    surface.for_each_at(v, [&](TriangleIndex t) {
      const Triangle& corners = surface.corners(t);
      const auto first = std::find_if(corners.begin(), corners.end(), is_inner);
      if (*first == v) near.triangles.push_back(corners);
      for (const VertexId corner : corners)
        if (!is_inner(corner)) near.border.push_back(corner);
    });
  sort_unique(near.border);
  return near;
}

/// The pieces of all other triangles, which hang together by edges.
class Beyond {
 public:
  Beyond(const WorkingSurface& surface, const Near& near)
      : surface_(surface),
        near_(near),
        place_(surface.n_vertices(), Place::Beyond),
        sets_(surface.n_vertices()) {
    for (const VertexId v : near.inner) place_[index(v)] = Place::Inner;
    for (const VertexId v : near.border) place_[index(v)] = Place::Border;
    join_at_vertices();
    join_at_border();
  }

  /// Edges of a triangle here and one beyond, ascending.
  std::vector<Seam> seams() {
    std::sort(seams_.begin(), seams_.end(),
              [](const Seam& a, const Seam& b) { return a.ends < b.ends; });
    std::vector<std::uint32_t> roots;
    for (const Seam& seam : seams_) roots.push_back(sets_.root(seam.piece));
    std::vector<std::uint32_t> pieces = roots;
    sort_unique(pieces);
    for (std::size_t i = 0; i < seams_.size(); ++i)
      seams_[i].piece = static_cast<std::uint32_t>(
          std::lower_bound(pieces.begin(), pieces.end(), roots[i]) -
          pieces.begin());
    return seams_;
  }

 private:
  enum class Place : std::uint8_t { Beyond, Border, Inner };

  bool is_at(VertexId v, Place place) const {
    return place_[index(v)] == place;
  }
  bool is_near(const Triangle& t) const {
    return std::any_of(t.begin(), t.end(),
                       [this](VertexId v) { return is_at(v, Place::Inner); });
  }

  /// A vertex beyond stands for all triangles at it. One that has none gets a
  /// set of its own.
  void join_at_vertices() {
    std::uint32_t n_sets = static_cast<std::uint32_t>(surface_.n_vertices());
    for (TriangleIndex t = 0; t < surface_.n_indices(); ++t) {
      if (!surface_.contains(t)) continue;
      const Triangle& corners = surface_.corners(t);
      const auto first =
          std::find_if(corners.begin(), corners.end(),
                       [this](VertexId v) { return is_at(v, Place::Beyond); });
      for (auto v = first; v != corners.end(); ++v)
        if (is_at(*v, Place::Beyond)) sets_.unite(index(*first), index(*v));
      if (first != corners.end() || is_near(corners)) continue;
      sets_.add();
      own_sets_.emplace_back(t, n_sets++);
    }
  }

  std::uint32_t set_of(TriangleIndex t) const {
    for (const VertexId v : surface_.corners(t))
      if (is_at(v, Place::Beyond)) return static_cast<std::uint32_t>(index(v));
    return std::lower_bound(own_sets_.begin(), own_sets_.end(),
                            std::pair(t, std::uint32_t{0}))
        ->second;
  }

  /// Two triangles beyond with a common edge hang together; one alone has a
  /// seam there.
  void join_at_border() {
    std::vector<std::pair<VertexId, std::uint32_t>> sides;  // other end, set
    for (const VertexId v : near_.border) {
      sides.clear();
      surface_.for_each_at(v, [&](TriangleIndex t) {
        if (is_near(surface_.corners(t))) return;
        for (const VertexId end : surface_.corners(t))
          if (end != v) sides.emplace_back(end, set_of(t));
      });
      std::sort(sides.begin(), sides.end());
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto& [end, set] = sides[i];
        if (i + 1 < sides.size() && sides[i + 1].first == end)
          sets_.unite(set, sides[++i].second);
        else if (v < end)
          seams_.push_back({{v, end}, set});
      }
    }
  }

  const WorkingSurface& surface_;
  const Near& near_;
  std::vector<Place> place_;
  DisjointSets sets_;  // of vertices, then of triangles
  std::vector<std::pair<TriangleIndex, std::uint32_t>> own_sets_;
  std::vector<Seam> seams_;
};

/// Vertices by their place among these; so ids keep their order.
class Places {
 public:
  explicit Places(const Near& near) {
    std::merge(near.inner.begin(), near.inner.end(), near.border.begin(),
               near.border.end(), std::back_inserter(vertices_));
  }

  std::size_t size() const { return vertices_.size(); }
  template <class Ids>
  void replace(Ids& ids) const {
    for (VertexId& v : ids)
      v = VertexId{static_cast<std::uint32_t>(
          std::lower_bound(vertices_.begin(), vertices_.end(), v) -
          vertices_.begin())};
  }
  template <class Ids>
  void restore(Ids& ids) const {
    for (VertexId& v : ids) v = vertices_[index(v)];
  }

 private:
  Vertices vertices_;
};

/// The triangles with a corner among some vertices, and the loops of theirs
/// that do not bound on the whole surface.
struct Window {
  Window(const WorkingSurface& surface, Vertices inner)
      : Window(surface, near_triangles(surface, std::move(inner))) {}

  Places places;
  EssentialLoops loops;

 private:
  Window(const WorkingSurface& surface, Near near)
      : places(near), loops(loops_of(Beyond(surface, near).seams(), near)) {}

  EssentialLoops loops_of(std::vector<Seam> seams, Near& near) const {
    for (Triangle& t : near.triangles) places.replace(t);
    for (Seam& seam : seams) places.replace(seam.ends);
    return {places.size(), near.triangles, seams};
  }
};

}  // namespace

HandleLoops::Loops HandleLoops::all(
    std::size_t n_vertices, std::span<const LocatedTriangle> triangles) {
  std::vector<Triangle> corners(triangles.size());
  std::transform(triangles.begin(), triangles.end(), corners.begin(),
                 [](const LocatedTriangle& t) { return t.corners; });
  at_first_.emplace(n_vertices, corners);
  EssentialLoops::Found found = at_first_->shortest(max_edges_);
  on_loops_ = std::move(found.vertices);
  return std::move(found.loops);
}

void HandleLoops::set_max_edges(unsigned max_edges) {
  max_edges_ = max_edges;
  on_loops_ = at_first_->shortest(max_edges).vertices;
}

/// A loop through a new triangle has all its vertices within half its length of
/// that; the walks that find it go as far again.
HandleLoops::Loops HandleLoops::about(const WorkingSurface& surface,
                                      std::span<const VertexId> changed) {
  const unsigned reach = max_edges_ / 2;
  Vertices starts = widened(surface, changed, reach);
  starts.insert(starts.end(), on_loops_.begin(), on_loops_.end());
  sort_unique(starts);
  Window window(surface, widened(surface, starts, reach));
  window.places.replace(starts);
  EssentialLoops::Found found = window.loops.shortest(starts, max_edges_);
  for (Vertices& loop : found.loops) window.places.restore(loop);
  window.places.restore(found.vertices);
  on_loops_ = std::move(found.vertices);
  return std::move(found.loops);
}

/// A loop that goes through no new triangle was there at first, and did not
/// bound then either.
std::vector<HandleLoops::Loops> HandleLoops::independent(
    const WorkingSurface& surface, std::span<const VertexId> changed,
    unsigned max_edges, std::size_t n_alike) {
  if (!starts_at_first_) starts_at_first_ = at_first_->starts(max_edges);
  Vertices starts = *starts_at_first_;
  starts.insert(starts.end(), changed.begin(), changed.end());
  sort_unique(starts);
  Window window(surface, widened(surface, std::move(starts), max_edges / 2));
  std::vector<Loops> result = window.loops.independent(max_edges, n_alike);
  for (Loops& loops : result)
    for (Vertices& loop : loops) window.places.restore(loop);
  return result;
}

}  // namespace umbrella
