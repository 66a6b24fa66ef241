#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/new_handles_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

/// Vertices, numbered as they come.
class Numbering {
 public:
  explicit Numbering(std::size_t n_vertices) : number_(n_vertices, kNone) {}

  std::uint32_t number(VertexId v) {
    std::uint32_t& number = number_[index(v)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(v);
    }
    return number;
  }
  Triangle numbers(const Triangle& t) {
    Triangle result;
    for (unsigned i = 0; i < 3; ++i) result[i] = VertexId{number(t[i])};
    std::sort(result.begin(), result.end());
    return result;
  }
  std::span<const VertexId> vertices() const { return vertices_; }

 private:
  static constexpr std::uint32_t kNone =
      std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> number_;
  std::vector<VertexId> vertices_;
};

std::vector<std::uint64_t> edges_of(std::span<const Triangle> triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  const auto add = [&](VertexId low, VertexId high) {
    edges.push_back(std::uint64_t{index(low)} << 32U | index(high));
  };
  for (const auto& [a, b, c] : triangles) {
    add(a, b);
    add(a, c);
    add(b, c);
  }
  sort_unique(edges);
  return edges;
}

/// By vertex: whether it is in a component that is not made of discs, each
/// joined to the others at single vertices. As V - E + F = 1 - b_1 for all but
/// closed components, it tells.
std::vector<bool> in_no_disc(std::size_t n_vertices,
                             std::span<const Triangle> triangles) {
  DisjointSets sets(n_vertices);
  for (const auto& [a, b, c] : triangles) {
    sets.unite(index(a), index(b));
    sets.unite(index(a), index(c));
  }
  std::vector<std::int64_t> euler(n_vertices);
  for (std::size_t v = 0; v < n_vertices; ++v) ++euler[sets.root(v)];
  for (const std::uint64_t edge : edges_of(triangles))
    --euler[sets.root(edge >> 32U)];
  for (const Triangle& t : triangles) ++euler[sets.root(index(t[0]))];
  std::vector<bool> result(n_vertices);
  for (std::size_t v = 0; v < n_vertices; ++v)
    result[v] = euler[sets.root(v)] != 1;
  return result;
}

/// Vertices of added triangles that are not discs.
std::vector<VertexId> doubtful_vertices(const WorkingSurface& surface) {
  Numbering all(surface.n_vertices());
  std::vector<Triangle> triangles;
  surface.for_each_added([&](TriangleIndex t) {
    triangles.push_back(all.numbers(surface.corners(t)));
  });
  const auto vertices = all.vertices();
  const std::vector<bool> is_doubtful = in_no_disc(vertices.size(), triangles);
  std::vector<VertexId> result;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (is_doubtful[i]) result.push_back(vertices[i]);
  return result;
}

/// Triangles with a corner at most so many edges from some vertices.
struct Neighborhood {
  std::size_t n_vertices;
  std::vector<Triangle> triangles;
};

Neighborhood neighborhood(const WorkingSurface& surface,
                          std::span<const VertexId> vertices,
                          unsigned n_edges) {
  Numbering near(surface.n_vertices());
  for (const VertexId v : vertices) near.number(v);
  std::vector<Triangle> triangles;
  std::size_t next = 0;
  for (unsigned ring = 0; ring <= n_edges; ++ring)
    for (const std::size_t end = near.vertices().size(); next < end; ++next)
      surface.for_each_at(near.vertices()[next], [&](TriangleIndex t) {
        const Triangle numbers = near.numbers(surface.corners(t));
        // The first of its corners whose turn it is has the least number.
        if (index(numbers[0]) == next) triangles.push_back(numbers);
      });
  return {near.vertices().size(), std::move(triangles)};
}

}  // namespace

/// A loop of so many edges stays within half of them of each of its vertices.
/// One that does not bound in a neighborhood may do so in a larger one.
bool may_have_new_handle(const WorkingSurface& surface, unsigned max_edges) {
  constexpr std::size_t kLargestPart = 8;  // one in so many vertices
  const std::vector<VertexId> doubtful = doubtful_vertices(surface);
  if (doubtful.empty()) return false;
  std::size_t n_before = 0;
  for (unsigned n_edges = max_edges / 2;; n_edges *= 2) {
    const auto [n, near] = neighborhood(surface, doubtful, n_edges);
    if (!EssentialLoops(n, near).has_loop(max_edges)) return false;
    if (n == n_before || kLargestPart * n > surface.n_vertices()) return true;
    n_before = n;
  }
}

}  // namespace umbrella
