#include <algorithm>
#include <limits>

#include "umbrella/circumradius_internal.h"
#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/point_groups_internal.h"

namespace umbrella {
namespace {

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

/// Of each vertex: how far it is to those it hangs together with.
std::vector<double> PointGroups::squared_reach() const {
  constexpr double kReach = 2;  // of the longest edge
  const Distances distance(triangulation_);
  std::vector<double> reach(triangulation_.points().size());
  for (const RankedTriangle& t : triangles_)
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = t.corners[i], b = t.corners[(i + 1) % 3];
      const double longest = kReach * kReach * distance.squared(a, b);
      reach[index(a)] = std::max(reach[index(a)], longest);
      reach[index(b)] = std::max(reach[index(b)], longest);
    }
  std::replace(reach.begin(), reach.end(), 0.0,
               std::numeric_limits<double>::infinity());
  return reach;
}

void PointGroups::find() {
  const Distances distance(triangulation_);
  const std::vector<double> reach = squared_reach();
  DisjointSets sets(reach.size());
  for (const delaunay::Cell& cell :
       triangulation_.cells().first(triangulation_.n_finite_cells()))
    for (unsigned i = 0; i < 4; ++i)
      for (unsigned k = 0; k < i; ++k) {
        const VertexId a = cell.vertex[i], b = cell.vertex[k];
        if (distance.squared(a, b) <=
            std::min(reach[index(a)], reach[index(b)]))
          sets.unite(index(a), index(b));
      }
  group_.resize(reach.size());
  n_points_.resize(reach.size());
  for (std::size_t v = 0; v < group_.size(); ++v) {
    group_[v] = static_cast<std::uint32_t>(sets.root(v));
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
