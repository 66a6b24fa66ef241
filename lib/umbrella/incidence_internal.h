/// @file
/// Triangles at each vertex, as flat arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/lazy_vector.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// The triangle seen from its corner v: the edge of the link graph G_v.
using LinkEdge = std::array<VertexId, 2>;

inline LinkEdge opposite_edge(const Triangle& t, VertexId v) {
  // Selected, not jumped to: which corner v is, no processor can guess.
  const auto unless_v = [v, &t](VertexId end) {
    const auto middle = static_cast<std::uint32_t>(t[1]);
    const auto other = static_cast<std::uint32_t>(end);
    const std::uint32_t mask = 0U - static_cast<std::uint32_t>(end == v);
    return VertexId{other ^ ((other ^ middle) & mask)};
  };
  return {unless_v(t[0]), unless_v(t[2])};
}

/// For each vertex the triangles at it, ascending.
class Incidence {
 public:
  /// @tparam Corners  callable: Triangle of a TriangleIndex below n_triangles
  template <class Corners>
  Incidence(std::size_t n_vertices, std::size_t n_triangles, Corners corners)
      : first_(n_vertices + 1), triangles_(3 * n_triangles) {
    for (TriangleIndex t = 0; t < n_triangles; ++t)
      for (const VertexId v : corners(t)) ++first_[index(v)];
    for (std::size_t v = 0, sum = 0; v <= n_vertices; ++v)
      first_[v] = static_cast<std::uint32_t>(sum += first_[v]);
    for (auto t = static_cast<TriangleIndex>(n_triangles); t-- > 0;)
      for (const VertexId v : corners(t)) triangles_[--first_[index(v)]] = t;
  }

  std::span<const TriangleIndex> at(VertexId v) const {
    return std::span(triangles_)
        .subspan(first_[index(v)], first_[index(v) + 1] - first_[index(v)]);
  }

 private:
  std::vector<std::uint32_t> first_;
  delaunay::UnsetVector<TriangleIndex> triangles_;
};

}  // namespace umbrella
