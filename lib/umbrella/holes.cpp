#include "umbrella/holes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

using Edge = std::array<VertexId, 2>;

constexpr std::uint32_t kNoHole = std::numeric_limits<std::uint32_t>::max();

/// Edges between marked vertices at which exactly one triangle is left.
std::vector<Edge> open_edges(std::span<const RankedTriangle> triangles,
                             const std::vector<bool>& is_marked) {
  std::vector<Edge> edges;
  for (const RankedTriangle& t : triangles) {
    const auto& [a, b, c] = t.corners;
    for (const Edge& e : {Edge{a, b}, Edge{a, c}, Edge{b, c}})
      if (is_marked[index(e[0])] && is_marked[index(e[1])]) edges.push_back(e);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> open;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    if (last - first == 1) open.push_back(*first);
    first = last;
  }
  return open;
}

}  // namespace

std::vector<Hole> find_holes(std::size_t n_vertices,
                             std::span<const RankedTriangle> triangles,
                             std::span<const RankedTriangle> deleted,
                             std::span<const VertexId> without_umbrella) {
  std::vector<bool> is_bare(n_vertices);
  for (const VertexId v : without_umbrella) is_bare[index(v)] = true;
  DisjointSets cores(n_vertices);
  for (const auto& [a, b] : open_edges(triangles, is_bare))
    cores.unite(index(a), index(b));

  std::vector<Hole> holes;
  std::vector<std::uint32_t> hole_of_vertex(n_vertices, kNoHole);
  for (const VertexId v : without_umbrella) {
    const std::uint32_t first = cores.root(index(v));
    if (first == index(v)) {
      hole_of_vertex[first] = static_cast<std::uint32_t>(holes.size());
      holes.emplace_back();
    }
    hole_of_vertex[index(v)] = hole_of_vertex[first];
    holes[hole_of_vertex[first]].core.push_back(v);
  }

  for (Hole& hole : holes) hole.vertices = hole.core;
  for (const RankedTriangle& t : deleted)
    for (const VertexId v : t.corners)
      if (const auto h = hole_of_vertex[index(v)]; h != kNoHole)
        holes[h].vertices.insert(holes[h].vertices.end(), t.corners.begin(),
                                 t.corners.end());
  for (Hole& hole : holes) sort_unique(hole.vertices);
  return holes;
}

}  // namespace umbrella
