/// @file
/// A set of vertices, and what is near it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "umbrella/triangle.h"

namespace umbrella {

/// With all vertices within so many edges; ascending.
///
/// @param for_each_neighbor  calls its second argument for each vertex that an
///   edge joins to the first; more than once, and with that itself, if it likes
template <class ForEachNeighbor>
std::vector<VertexId> widened(std::size_t n_vertices,
                              std::span<const VertexId> vertices,
                              unsigned n_edges,
                              const ForEachNeighbor& for_each_neighbor) {
  std::vector<bool> is_met(n_vertices);
  std::vector<VertexId> result;
  const auto enter = [&](VertexId v) {
    if (!is_met[index(v)]) result.push_back(v);
    is_met[index(v)] = true;
  };
  for (const VertexId v : vertices) enter(v);
  std::size_t next = 0;
  for (unsigned ring = 0; ring < n_edges; ++ring)
    for (const std::size_t end = result.size(); next < end; ++next)
      for_each_neighbor(result[next], enter);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace umbrella
