// A mesh is judged star by star. Most are sound, which a walk around each
// vertex shows. If not, the edges at a vertex, sorted by their other end, tell
// how many triangles lie on each and how the triangles follow one another
// around the vertex. Degenerate and repeated triangles are counted, and take
// part in all the rest as they are.
#include "umbrella/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

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
  void join(std::uint32_t i, std::uint32_t k) { parent_[root(i)] = root(k); }
  /// The same, quicker where it is known to be joined.
  /// @param k  a root, and one afterwards
  void join_root(std::uint32_t i, std::uint32_t k) {
    if (parent_[i] != k) parent_[root(i)] = k;
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

/// How many items equal an earlier one. Sorts them.
template <class Item>
std::size_t count_repeated(std::vector<Item>& items) {
  std::sort(items.begin(), items.end());
  std::size_t n = 0;
  for (std::size_t i = 1; i < items.size(); ++i)
    n += items[i] == items[i - 1] ? 1 : 0;
  return n;
}

std::vector<std::uint32_t> rows_without(const std::vector<bool>& is_used) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (!is_used[v]) rows.push_back(v);
  return rows;
}

/// A side of a triangle that ends at the vertex looked at.
class Spoke {
 public:
  /// @param end   the other end of the edge
  /// @param slot  2 k: the k-th triangle at the vertex leaves it here; 2 k + 1:
  ///   it comes back here
  Spoke(std::uint32_t end, std::size_t slot)
      : key_(std::uint64_t{end} << 32U | slot) {}

  std::uint32_t end() const { return static_cast<std::uint32_t>(key_ >> 32U); }
  std::uint32_t slot() const { return static_cast<std::uint32_t>(key_); }
  bool leaves() const { return slot() % 2 == 0; }

  friend bool operator<(Spoke a, Spoke b) { return a.key_ < b.key_; }

 private:
  std::uint64_t key_;
};

/// The triangles at one vertex.
struct Star {
  std::uint32_t vertex;
  std::span<const std::uint32_t> corners;  // 3 t + i: entry i of triangle t
  std::span<const Spoke> spokes;           // ascending

  std::uint32_t triangle(Spoke s) const { return corners[s.slot() / 2] / 3; }
};

/// All stars of a mesh.
class Stars {
 public:
  Stars(std::size_t n_vertices, std::span<const IndexedTriangle> triangles)
      : triangles_(triangles),
        first_(n_vertices + 1),
        corners_(3 * triangles.size()) {
    for (const IndexedTriangle& t : triangles)
      for (const std::uint32_t v : t) ++first_[v];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (auto t = static_cast<std::uint32_t>(triangles.size()); t-- > 0;)
      for (std::uint32_t i = 3; i-- > 0;)
        corners_[--first_[triangles[t][i]]] = 3 * t + i;
  }

  std::size_t n_vertices() const { return first_.size() - 1; }

  /// 3 t + i for entry i of triangle t, ascending.
  std::span<const std::uint32_t> corners_at(std::uint32_t v) const {
    return std::span(corners_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  /// Calls visit(Star) for each vertex; the star is gone after the call.
  template <class Visit>
  void for_each(Visit visit) const {
    std::vector<Spoke> spokes;
    for (std::uint32_t v = 0; v < n_vertices(); ++v) {
      const auto at_v = corners_at(v);
      spokes.clear();
      for (std::size_t k = 0; k < at_v.size(); ++k) {
        const IndexedTriangle& t = triangles_[at_v[k] / 3];
        const std::uint32_t i = at_v[k] % 3;
        spokes.emplace_back(t[i == 2 ? 0 : i + 1], 2 * k);
        spokes.emplace_back(t[i == 0 ? 2 : i - 1], 2 * k + 1);
      }
      std::sort(spokes.begin(), spokes.end());
      visit(Star{v, at_v, spokes});
    }
  }

 private:
  std::span<const IndexedTriangle> triangles_;
  std::vector<std::uint32_t> first_;  // of a vertex: its part of corners_
  std::vector<std::uint32_t> corners_;
};

/// Calls visit(spokes on one edge) for each edge at the vertex.
template <class Visit>
void for_each_edge(const Star& star, Visit visit) {
  const auto& spokes = star.spokes;
  for (std::size_t i = 0; i < spokes.size();) {
    std::size_t end = i + 1;
    while (end < spokes.size() && spokes[end].end() == spokes[i].end()) ++end;
    visit(spokes.subspan(i, end - i));
    i = end;
  }
}

/// Calls visit(Star, spokes on one edge) for each edge of the mesh, at its
/// lower end.
template <class Visit>
void for_each_edge(const Stars& stars, Visit visit) {
  stars.for_each([&](const Star& star) {
    for_each_edge(star, [&](std::span<const Spoke> edge) {
      if (star.vertex < edge[0].end()) visit(star, edge);
    });
  });
}

/// Whether the triangles can be turned so that neighbours run along each edge
/// opposite ways: no odd cycle among 2 n nodes, t as it is and t turned.
bool can_be_oriented(std::size_t n_triangles, const Stars& stars) {
  const auto n = static_cast<std::uint32_t>(n_triangles);
  Components turns(2 * n_triangles);
  for_each_edge(stars, [&](const Star& star, std::span<const Spoke> edge) {
    if (edge.size() != 2) return;
    const std::uint32_t a = star.triangle(edge[0]), b = star.triangle(edge[1]);
    const std::uint32_t shift = edge[0].leaves() == edge[1].leaves() ? n : 0;
    turns.join(a, b + shift);
    turns.join(a + n, b + n - shift);
  });
  for (std::uint32_t t = 0; t < n; ++t)
    if (turns.root(t) == turns.root(t + n)) return false;
  return true;
}

/// Counts what is wrong with each star.
class StarJudge {
 public:
  StarJudge(std::span<const IndexedTriangle> triangles, SurfaceReport& report,
            Components& components)
      : triangles_(triangles), report_(report), components_(components) {}

  void operator()(const Star& star) {
    if (star.corners.empty()) {
      report_.unused_vertices.push_back(star.vertex);
      return;
    }
    for_each_edge(star, [&](std::span<const Spoke> edge) {
      if (star.vertex < edge[0].end()) judge_edge(star, edge);
    });
    report_.nonmanifold_vertices += is_fan_or_umbrella(star) ? 0 : 1;
    report_.duplicate_triangles += count_repeated_at(star);
  }

  std::size_t n_edges() const { return n_edges_; }

 private:
  void judge_edge(const Star& star, std::span<const Spoke> edge) {
    ++n_edges_;
    report_.boundary_edges += edge.size() == 1 ? 1 : 0;
    report_.nonmanifold_edges += edge.size() > 2 ? 1 : 0;
    if (edge.size() == 2 && edge[0].leaves() == edge[1].leaves())
      report_.oriented = false;
    for (const Spoke side : edge.subspan(1))
      components_.join(star.triangle(side), star.triangle(edge[0]));
  }

  /// Walks from triangle to triangle around the vertex, from where the first
  /// one begins if there is such a place: one fan or umbrella meets all.
  bool is_fan_or_umbrella(const Star& star) {
    partner_.assign(star.spokes.size(), kNone);
    bool is_simple = true;
    std::uint32_t start = 0;
    for_each_edge(star, [&](std::span<const Spoke> edge) {
      const std::uint32_t a = edge.front().slot(), b = edge.back().slot();
      if (edge.size() == 1) {
        start = a;
        return;
      }
      is_simple = is_simple && edge.size() == 2 && a / 2 != b / 2;
      partner_[a] = b;
      partner_[b] = a;
    });
    if (!is_simple) return false;
    std::size_t n_met = 0;
    std::uint32_t slot = start;
    do {
      ++n_met;
      slot = partner_[slot ^ 1U];
    } while (slot != kNone && slot != start);
    return n_met == star.corners.size();
  }

  /// Among the triangles whose lowest corner this is.
  std::size_t count_repeated_at(const Star& star) {
    others_.clear();
    for (std::size_t k = 0; k < star.corners.size(); ++k) {
      IndexedTriangle t = triangles_[star.corners[k] / 3];
      const bool is_met_again =
          k > 0 && star.corners[k] / 3 == star.corners[k - 1] / 3;
      if (is_met_again || std::min({t[0], t[1], t[2]}) != star.vertex) continue;
      std::sort(t.begin(), t.end());
      others_.push_back({t[1], t[2]});
    }
    return count_repeated(others_);
  }

  static constexpr std::uint32_t kNone =
      std::numeric_limits<std::uint32_t>::max();

  std::span<const IndexedTriangle> triangles_;
  SurfaceReport& report_;
  Components& components_;
  std::size_t n_edges_ = 0;
  std::vector<std::uint32_t> partner_;  // of a slot: the one across the edge
  std::vector<IndexedEdge> others_;
};

/// Whether the triangles at each vertex that has any are one umbrella, of three
/// at least, and run around it one way. This says that the mesh is closed,
/// manifold and oriented without a look at its edges.
class UmbrellaCheck {
 public:
  UmbrellaCheck(const Stars& stars, std::span<const IndexedTriangle> triangles)
      : stars_(stars), triangles_(triangles), links_(stars.n_vertices()) {}

  bool operator()() {
    for (std::uint32_t v = 0; v < stars_.n_vertices(); ++v)
      if (!stars_.corners_at(v).empty() && !is_umbrella(v)) return false;
    return true;
  }

 private:
  /// A triangle at `center` leads from one neighbour to the next.
  struct Link {
    std::uint32_t center = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t next = 0;
  };

  bool is_umbrella(std::uint32_t v) {
    constexpr std::size_t kLeast = 3;
    const auto corners = stars_.corners_at(v);
    std::uint32_t start = v;
    for (const std::uint32_t c : corners) {
      const IndexedTriangle& t = triangles_[c / 3];
      const std::uint32_t i = c % 3;
      start = t[i == 2 ? 0 : i + 1];
      if (start == v || links_[start].center == v) return false;
      links_[start] = {v, t[i == 0 ? 2 : i - 1]};
    }
    // No two triangles leave towards one neighbour: back at the start after
    // all of them, the walk has met each once.
    std::uint32_t w = start;
    for (std::size_t n = 1; n <= corners.size(); ++n) {
      w = links_[w].next;
      if (links_[w].center != v) return false;
      if (w == start) return n == corners.size() && n >= kLeast;
    }
    return false;
  }

  const Stars& stars_;
  std::span<const IndexedTriangle> triangles_;
  std::vector<Link> links_;  // by neighbour
};

/// What judge_all() finds where the UmbrellaCheck passes.
/// @return the number of edges
std::size_t judge_sound(const Stars& stars, std::size_t n_triangles,
                        SurfaceReport& report, Components& components) {
  for (std::uint32_t v = 0; v < stars.n_vertices(); ++v) {
    const auto corners = stars.corners_at(v);
    if (corners.empty()) {
      report.unused_vertices.push_back(v);
      continue;
    }
    const std::uint32_t first = components.root(corners.front() / 3);
    for (const std::uint32_t c : corners) components.join_root(c / 3, first);
  }
  report.oriented = report.orientable = true;
  return 3 * n_triangles / 2;
}

/// @return the number of edges
std::size_t judge_all(const Stars& stars,
                      std::span<const IndexedTriangle> triangles,
                      SurfaceReport& report, Components& components) {
  report.oriented = true;
  StarJudge judge(triangles, report, components);
  stars.for_each([&](const Star& star) { judge(star); });
  report.orientable =
      report.oriented || can_be_oriented(triangles.size(), stars);
  return judge.n_edges();
}

/// All counts, and the orientation.
void judge_stars(const Stars& stars, std::span<const IndexedTriangle> triangles,
                 SurfaceReport& report, Components& components) {
  const std::size_t n_edges =
      UmbrellaCheck(stars, triangles)()
          ? judge_sound(stars, triangles.size(), report, components)
          : judge_all(stars, triangles, report, components);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    report.components += components.root(t) == t ? 1 : 0;
  report.vertices = stars.n_vertices() - report.unused_vertices.size();
  report.euler = static_cast<std::int64_t>(report.vertices) -
                 static_cast<std::int64_t>(n_edges) +
                 static_cast<std::int64_t>(triangles.size());
}

/// The exponent of a power of two that brings the largest coordinate so near 1
/// that its square and cube neither overflow nor vanish.
int scaling_exponent(std::span<const Eigen::Vector3d> vertices,
                     std::span<const IndexedTriangle> triangles) {
  double largest = 0;
  for (const IndexedTriangle& t : triangles)
    for (const std::uint32_t v : t)
      largest = std::max(largest, vertices[v].lpNorm<Eigen::Infinity>());
  return largest > 0 ? std::clamp(-std::ilogb(largest), -1000, 1000) : 0;
}

/// Area, volume, and whether each component's volume is positive.
void measure(std::span<const Eigen::Vector3d> vertices,
             std::span<const IndexedTriangle> triangles, SurfaceReport& report,
             Components& components) {
  const int exponent = scaling_exponent(vertices, triangles);
  const double scale = std::ldexp(1, exponent);
  const auto at = [&](std::uint32_t v) -> Eigen::Vector3d {
    return scale * vertices[v];
  };
  std::vector<double> volume(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t component = components.root(t);
    // Seen from a point of the component, so that little cancels.
    const Eigen::Vector3d origin = at(triangles[component][0]);
    const Eigen::Vector3d a = at(triangles[t][0]) - origin;
    const Eigen::Vector3d b = at(triangles[t][1]) - origin;
    const Eigen::Vector3d c = at(triangles[t][2]) - origin;
    report.area += (b - a).cross(c - a).norm() / 2;
    volume[component] += a.dot(b.cross(c)) / 6;
  }
  report.area = std::ldexp(report.area, -2 * exponent);
  if (!report.closed || !report.oriented) return;
  report.outward = true;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (components.root(t) != t) continue;
    report.volume += volume[t];
    report.outward = report.outward && volume[t] > 0;
  }
  report.volume = std::ldexp(report.volume, -3 * exponent);
}

}  // namespace

SurfaceReport check_surface(std::span<const Eigen::Vector3d> vertices,
                            std::span<const IndexedTriangle> triangles) {
  require_rows(triangles, vertices.size());
  SurfaceReport report;
  report.triangles = triangles.size();
  for (const auto& [a, b, c] : triangles)
    report.degenerate_triangles += a == b || b == c || c == a ? 1 : 0;

  Components components(triangles.size());
  judge_stars(Stars(vertices.size(), triangles), triangles, report, components);
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
  std::vector<IndexedEdge> upward(edges.begin(), edges.end());
  for (IndexedEdge& e : upward) std::sort(e.begin(), e.end());
  report.duplicate_edges = count_repeated(upward);

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
