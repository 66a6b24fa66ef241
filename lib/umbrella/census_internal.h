/// @file
/// What the triangles of a surface make of the points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/triangle.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Two triangles with a common vertex are in one component.
class Census {
 public:
  Census(std::size_t n_vertices, std::span<const LocatedTriangle> triangles)
      : sets_(n_vertices), is_used_(n_vertices) {
    for (const auto& [t, facet] : triangles) {
      for (const VertexId v : t) is_used_[index(v)] = 1;
      sets_.unite(index(t[0]), index(t[1]));
      sets_.unite(index(t[0]), index(t[2]));
    }
  }

  /// On no triangle; ascending.
  std::vector<VertexId> unused() const {
    std::vector<VertexId> result;
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (is_used_[v] == 0) result.push_back(VertexId{v});
    return result;
  }
  std::size_t n_components() {
    std::size_t n = 0;
    for (std::size_t v = 0; v < is_used_.size(); ++v)
      n += is_used_[v] != 0 && sets_.root(v) == v ? 1 : 0;
    return n;
  }
  /// The vertices of each component, ascending.
  std::vector<std::vector<VertexId>> components() {
    std::vector<std::vector<VertexId>> of_root(is_used_.size());
    for (std::uint32_t v = 0; v < is_used_.size(); ++v)
      if (is_used_[v] != 0) of_root[sets_.root(v)].push_back(VertexId{v});
    std::erase_if(of_root, [](const auto& part) { return part.empty(); });
    return of_root;
  }

 private:
  DisjointSets sets_;
  std::vector<std::uint8_t> is_used_;
};

/// By vertex: whether it is in the component of one of these.
inline std::vector<bool> on_components_of(const WorkingSurface& surface,
                                          std::span<const VertexId> vertices) {
  DisjointSets sets(surface.n_vertices());
  for (TriangleIndex t = 0; t < surface.n_indices(); ++t) {
    if (!surface.contains(t)) continue;
    const auto& [a, b, c] = surface.corners(t);
    sets.unite(index(a), index(b));
    sets.unite(index(a), index(c));
  }
  std::vector<bool> result(surface.n_vertices());
  for (const VertexId v : vertices) result[sets.root(index(v))] = true;
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = result[sets.root(v)];
  return result;
}

}  // namespace umbrella
