// Everything is read off two lists: the sides of the triangles by edge, and
// their corners by vertex, both put into buckets first. Degenerate and repeated
// triangles are counted, and take part in all the rest as they are.
#include "umbrella/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <compare>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace umbrella {
namespace {

class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// @return whether they were apart
  bool join(std::uint32_t i, std::uint32_t k) {
    const std::uint32_t a = root(i), b = root(k);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

template <std::size_t kCorners>
void require_rows(
    std::span<const std::array<std::uint32_t, kCorners>> simplices,
    std::size_t n_vertices) {
  for (std::size_t i = 0; i < simplices.size(); ++i)
    for (const std::uint32_t row : simplices[i])
      if (row >= n_vertices)
        throw std::invalid_argument("simplex " + std::to_string(i) +
                                    " names vertex " + std::to_string(row) +
                                    " of " + std::to_string(n_vertices));
}

/// Puts items into buckets by a key below n_keys, ascending within each.
/// @return where each bucket begins, and the end
template <class Item, class Key>
std::vector<std::uint32_t> sort_into_buckets(std::vector<Item>& items,
                                             std::size_t n_keys, Key key) {
  std::vector<std::uint32_t> first(n_keys + 1);
  for (const Item& item : items) ++first[key(item)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[--first[key(item)]] = item;
  for (std::size_t k = 0; k < n_keys; ++k)
    std::sort(sorted.begin() + first[k], sorted.begin() + first[k + 1]);
  items = std::move(sorted);
  return first;
}

/// How often a simplex has the corners of an earlier one.
template <std::size_t kCorners>
std::size_t n_repeated(
    std::span<const std::array<std::uint32_t, kCorners>> simplices,
    std::size_t n_vertices) {
  std::vector<std::array<std::uint32_t, kCorners>> sorted(simplices.begin(),
                                                          simplices.end());
  for (auto& s : sorted) std::sort(s.begin(), s.end());
  sort_into_buckets(sorted, n_vertices, [](const auto& s) { return s[0]; });
  std::size_t n = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    n += sorted[i] == sorted[i - 1] ? 1 : 0;
  return n;
}

std::vector<std::uint32_t> rows_without(const std::vector<bool>& is_used) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (!is_used[v]) rows.push_back(v);
  return rows;
}

/// A triangle's way along one of its edges.
struct Side {
  std::uint32_t low, high;  // ends of the edge
  std::uint32_t triangle;
  bool upward;  // from low to high

  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(std::span<const IndexedTriangle> triangles,
                               std::size_t n_vertices) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  sort_into_buckets(sides, n_vertices, [](const Side& s) { return s.low; });
  return sides;
}

/// Calls visit(sides of one edge) for each edge.
template <class Visit>
void for_each_edge(std::span<const Side> sides, Visit visit) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low &&
           sides[end].high == sides[i].high)
      ++end;
    visit(sides.subspan(i, end - i));
    i = end;
  }
}

/// Whether the triangles can be turned so that neighbours run along each edge
/// opposite ways: no odd cycle among 2 n nodes, t as it is and t turned.
bool can_be_oriented(std::size_t n_triangles, std::span<const Side> sides) {
  const auto n = static_cast<std::uint32_t>(n_triangles);
  Components turns(2 * n_triangles);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const std::uint32_t a = edge[0].triangle, b = edge[1].triangle;
    const std::uint32_t shift = edge[0].upward == edge[1].upward ? n : 0;
    turns.join(a, b + shift);
    turns.join(a + n, b + n - shift);
  });
  for (std::uint32_t t = 0; t < n; ++t)
    if (turns.root(t) == turns.root(t + n)) return false;
  return true;
}

/// Whether the edges, each opposite one vertex in a triangle, are one path or
/// one cycle.
/// @param ends  scratch
bool is_fan_or_umbrella(std::span<const IndexedEdge> link,
                        std::vector<std::uint32_t>& ends) {
  ends.clear();
  for (const auto& [p, q] : link) {
    if (p == q) return false;
    ends.push_back(p);
    ends.push_back(q);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 2; i < ends.size(); ++i)
    if (ends[i] == ends[i - 2]) return false;  // three triangles at an edge
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

  // No node has three edges, so it is one part exactly if it is connected.
  const auto position = [&](std::uint32_t node) {
    return static_cast<std::uint32_t>(
        std::lower_bound(ends.begin(), ends.end(), node) - ends.begin());
  };
  Components parts(ends.size());
  std::size_t n_parts = ends.size();
  for (const auto& [p, q] : link)
    n_parts -= parts.join(position(p), position(q)) ? 1 : 0;
  return n_parts == 1;
}

struct Corner {
  std::uint32_t vertex;
  IndexedEdge opposite;

  friend auto operator<=>(const Corner&, const Corner&) = default;
};

std::size_t count_nonmanifold_vertices(
    std::span<const IndexedTriangle> triangles, std::size_t n_vertices) {
  std::vector<Corner> corners;
  corners.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    corners.push_back({a, {b, c}});
    corners.push_back({b, {c, a}});
    corners.push_back({c, {a, b}});
  }
  const auto first = sort_into_buckets(
      corners, n_vertices, [](const Corner& c) { return c.vertex; });
  std::size_t n = 0;
  std::vector<IndexedEdge> link;
  std::vector<std::uint32_t> ends;
  for (std::size_t v = 0; v < n_vertices; ++v) {
    if (first[v] == first[v + 1]) continue;
    link.clear();
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i)
      link.push_back(corners[i].opposite);
    n += is_fan_or_umbrella(link, ends) ? 0 : 1;
  }
  return n;
}

/// Counts of edges and components, and the orientation.
void judge_edges(std::span<const IndexedTriangle> triangles,
                 std::span<const Side> sides, SurfaceReport& report,
                 Components& components) {
  std::size_t n_edges = 0;
  report.oriented = true;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    ++n_edges;
    report.boundary_edges += edge.size() == 1 ? 1 : 0;
    report.nonmanifold_edges += edge.size() > 2 ? 1 : 0;
    if (edge.size() == 2 && edge[0].upward == edge[1].upward)
      report.oriented = false;
    for (const Side& side : edge)
      components.join(side.triangle, edge[0].triangle);
  });
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    report.components += components.root(t) == t ? 1 : 0;
  report.euler = static_cast<std::int64_t>(report.vertices) -
                 static_cast<std::int64_t>(n_edges) +
                 static_cast<std::int64_t>(triangles.size());
  report.orientable = can_be_oriented(triangles.size(), sides);
}

/// Area, volume, and whether each component's volume is positive.
void measure(std::span<const Eigen::Vector3d> vertices,
             std::span<const IndexedTriangle> triangles, SurfaceReport& report,
             Components& components) {
  std::vector<double> volume(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t component = components.root(t);
    // Seen from a point of the component, so that little cancels.
    const Eigen::Vector3d& origin = vertices[triangles[component][0]];
    const Eigen::Vector3d a = vertices[triangles[t][0]] - origin;
    const Eigen::Vector3d b = vertices[triangles[t][1]] - origin;
    const Eigen::Vector3d c = vertices[triangles[t][2]] - origin;
    report.area += (b - a).cross(c - a).norm() / 2;
    volume[component] += a.dot(b.cross(c)) / 6;
  }
  if (!report.closed || !report.oriented) return;
  report.outward = true;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (components.root(t) != t) continue;
    report.volume += volume[t];
    report.outward = report.outward && volume[t] > 0;
  }
}

}  // namespace

SurfaceReport check_surface(std::span<const Eigen::Vector3d> vertices,
                            std::span<const IndexedTriangle> triangles) {
  require_rows(triangles, vertices.size());
  SurfaceReport report;
  report.triangles = triangles.size();
  std::vector<bool> is_used(vertices.size());
  for (const auto& [a, b, c] : triangles) {
    is_used[a] = is_used[b] = is_used[c] = true;
    report.degenerate_triangles += a == b || b == c || c == a ? 1 : 0;
  }
  report.unused_vertices = rows_without(is_used);
  report.vertices = vertices.size() - report.unused_vertices.size();
  report.duplicate_triangles = n_repeated(triangles, vertices.size());

  Components components(triangles.size());
  judge_edges(triangles, sorted_sides(triangles, vertices.size()), report,
              components);
  report.nonmanifold_vertices =
      count_nonmanifold_vertices(triangles, vertices.size());
  report.closed = !triangles.empty() && report.boundary_edges == 0 &&
                  report.nonmanifold_edges == 0 &&
                  report.degenerate_triangles == 0;
  report.manifold =
      report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0 &&
      report.degenerate_triangles == 0 && report.duplicate_triangles == 0;
  if (report.closed && report.manifold && report.orientable)
    report.genus =
        static_cast<std::int64_t>(report.components) - report.euler / 2;
  measure(vertices, triangles, report, components);
  return report;
}

CurveReport check_curve(std::size_t n_vertices,
                        std::span<const IndexedEdge> edges) {
  require_rows(edges, n_vertices);
  CurveReport report;
  report.edges = edges.size();
  std::vector<std::size_t> degree(n_vertices);
  Components components(n_vertices);
  for (const auto& [a, b] : edges) {
    report.degenerate_edges += a == b ? 1 : 0;
    ++degree[a];
    ++degree[b];
    components.join(a, b);
  }
  report.duplicate_edges = n_repeated(edges, n_vertices);

  std::vector<bool> is_used(n_vertices), is_counted(n_vertices);
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    if (degree[v] == 0) continue;
    is_used[v] = true;
    report.ends += degree[v] == 1 ? 1 : 0;
    report.branchings += degree[v] > 2 ? 1 : 0;
    const std::uint32_t component = components.root(v);
    report.components += is_counted[component] ? 0 : 1;
    is_counted[component] = true;
  }
  report.unused_vertices = rows_without(is_used);
  report.vertices = n_vertices - report.unused_vertices.size();
  report.manifold = report.branchings == 0 && report.degenerate_edges == 0 &&
                    report.duplicate_edges == 0;
  report.closed = !edges.empty() && report.ends == 0 &&
                  report.branchings == 0 && report.degenerate_edges == 0;
  return report;
}

}  // namespace umbrella
