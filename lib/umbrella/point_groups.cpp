#include <algorithm>
#include <limits>

#include "umbrella/circumradius_internal.h"
#include "umbrella/point_groups_internal.h"
#include "umbrella/region_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;

class Distances {
 public:
  explicit Distances(const delaunay::Triangulation3& triangulation)
      : triangulation_(triangulation),
        scale_(power_of_two_scale(triangulation.points())) {}

  double squared(VertexId a, VertexId b) const {
    const auto d = scaled_difference(triangulation_.point(a),
                                     triangulation_.point(b), scale_);
    return dot(d, d);
  }

 private:
  const delaunay::Triangulation3& triangulation_;
  double scale_;
};

}  // namespace

/// The corners of a triangle always hang together.
DisjointSets PointGroups::corner_sets() const {
  DisjointSets sets(surface_.n_vertices());
  for (const RankedTriangle& t : triangles_) {
    sets.unite(index(t.corners[0]), index(t.corners[1]));
    sets.unite(index(t.corners[0]), index(t.corners[2]));
  }
  sets.flatten();
  return sets;
}

/// All cells with a corner outside the largest set: no others can join any.
std::vector<CellId> PointGroups::cells_between(DisjointSets& sets) const {
  constexpr std::size_t kMany = 8;  // one vertex in so many
  const std::size_t n = surface_.n_vertices();
  std::vector<std::uint32_t> size(n, 1);
  sets.add_at_roots(size);
  const auto largest = static_cast<std::size_t>(
      std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<VertexId> others;
  for (std::uint32_t v = 0; v < n; ++v)
    if (sets.root(v) != largest) others.push_back(VertexId{v});
  std::vector<CellId> result;
  if (kMany * others.size() > n) {
    result.resize(triangulation_.n_finite_cells());
    for (std::uint32_t c = 0; c < result.size(); ++c) result[c] = CellId{c};
  } else if (!others.empty()) {
    CellSet cells(triangulation_, surface_);
    cells.collect(others);
    result.assign(cells.cells().begin(), cells.cells().end());
  }
  return result;
}

/// Of the corners of these cells: how far it is to those they hang together
/// with.
std::vector<double> PointGroups::squared_reach(
    std::span<const CellId> cells) const {
  constexpr double kReach = 2;  // of the longest edge
  const Distances distance(triangulation_);
  std::vector<std::uint8_t> is_asked(surface_.n_vertices());
  for (const CellId c : cells)
    for (const VertexId v : triangulation_.cell(c).vertex)
      is_asked[index(v)] = 1;
  std::vector<double> reach(surface_.n_vertices());
  double farthest = 0;
  for (const RankedTriangle& t : triangles_)
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = t.corners[i], b = t.corners[(i + 1) % 3];
      const double longest = kReach * kReach * distance.squared(a, b);
      farthest = std::max(farthest, longest);
      if ((is_asked[index(a)] | is_asked[index(b)]) == 0) continue;
      reach[index(a)] = std::max(reach[index(a)], longest);
      reach[index(b)] = std::max(reach[index(b)], longest);
    }
  std::replace(
      reach.begin(), reach.end(), 0.0,
      farthest > 0 ? farthest : std::numeric_limits<double>::infinity());
  return reach;
}

void PointGroups::find() {
  const Distances distance(triangulation_);
  DisjointSets sets = corner_sets();
  const std::vector<CellId> cells = cells_between(sets);
  const std::vector<double> reach = squared_reach(cells);
  for (const CellId c : cells) {
    const auto& vertex = triangulation_.cell(c).vertex;
    for (unsigned i = 0; i < 4; ++i)
      for (unsigned k = 0; k < i; ++k) {
        const VertexId a = vertex[i], b = vertex[k];
        if (distance.squared(a, b) <=
            std::min(reach[index(a)], reach[index(b)]))
          sets.unite(index(a), index(b));
      }
  }
  group_.resize(reach.size());
  n_points_.resize(reach.size());
  for (std::size_t v = 0; v < group_.size(); ++v) {
    group_[v] = sets.root(v);
    ++n_points_[group_[v]];
  }
}

std::size_t PointGroups::n_points_with(std::span<const VertexId> vertices) {
  std::call_once(is_found_, [this] { find(); });
  std::vector<std::uint32_t> groups(vertices.size());
  std::transform(vertices.begin(), vertices.end(), groups.begin(),
                 [this](VertexId v) { return group_[index(v)]; });
  std::sort(groups.begin(), groups.end());
  const auto last = std::unique(groups.begin(), groups.end());
  std::size_t n = 0;
  for (auto g = groups.begin(); g != last; ++g) n += n_points_[*g];
  return n;
}

}  // namespace umbrella
