// A mesh is judged star by star. Most are sound, which a walk around each
// vertex shows; then what shares a vertex shares an edge. If not, the edges at
// a vertex, sorted by their other end, tell how many triangles lie on each and
// how the triangles follow one another around the vertex. Degenerate and
// repeated triangles are counted, and take part in all the rest as they are.
#include "umbrella/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "umbrella/certificate_internal.h"

namespace umbrella {
namespace {

using certificate::Components;

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
    return certificate::count_repeated(others_);
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
  UmbrellaCheck(std::size_t n_vertices,
                std::span<const IndexedTriangle> triangles)
      : first_(n_vertices + 1),
        sides_(std::make_unique_for_overwrite<IndexedEdge[]>(
            3 * triangles.size())) {
    for (const IndexedTriangle& t : triangles)
      for (const std::uint32_t v : t) ++first_[v];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (const auto& [a, b, c] : triangles) {
      sides_[--first_[a]] = {b, c};
      sides_[--first_[b]] = {c, a};
      sides_[--first_[c]] = {a, b};
    }
  }

  std::size_t n_vertices() const { return first_.size() - 1; }
  bool is_used(std::uint32_t v) const { return first_[v] < first_[v + 1]; }

  bool operator()() const {
    std::vector<Link> links(first_.size() - 1);
    for (std::uint32_t v = 0; v < links.size(); ++v)
      if (is_used(v) && !is_umbrella(v, links)) return false;
    return true;
  }

 private:
  /// A triangle at `center` leads from one neighbour to the next.
  struct Link {
    std::uint32_t center = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t next = 0;
  };

  /// @param links  by neighbour
  bool is_umbrella(std::uint32_t v, std::vector<Link>& links) const {
    constexpr std::size_t kLeast = 3;
    const std::span sides(&sides_[first_[v]], first_[v + 1] - first_[v]);
    for (const auto& [from, to] : sides) {
      if (from == v || links[from].center == v) return false;
      links[from] = {v, to};
    }
    // No two triangles leave towards one neighbour: back at the start after
    // all of them and not before, the walk has met each once. It takes as many
    // steps however soon it is back, so that nothing waits for its end.
    const std::uint32_t start = sides.front()[0];
    std::uint32_t w = start;
    std::size_t n_at_start = 0;
    bool has_left = false;
    for (std::size_t n = 0; n < sides.size(); ++n) {
      w = links[w].next;
      has_left |= links[w].center != v;
      n_at_start += w == start ? 1 : 0;
    }
    return w == start && n_at_start == 1 && !has_left && sides.size() >= kLeast;
  }

  std::vector<std::uint32_t> first_;      // of a vertex: its part of sides_
  std::unique_ptr<IndexedEdge[]> sides_;  // opposite the vertex
};

/// Of each triangle: its component, counted from 0.
///
/// @param root  of each triangle: the same for all of a component, and below
///   n_roots
template <class Root>
std::vector<std::uint32_t> name_components(std::size_t n_triangles,
                                           std::size_t n_roots, Root root,
                                           SurfaceReport& report) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> name(n_roots, kNone), result(n_triangles);
  for (std::uint32_t t = 0; t < n_triangles; ++t) {
    std::uint32_t& known = name[root(t)];
    if (known == kNone) known = static_cast<std::uint32_t>(report.components++);
    result[t] = known;
  }
  return result;
}

/// Of each vertex: where a way down from row to row ends that goes to the
/// lowest one by some triangle each time. Most vertices of a component share an
/// end, so few are left to be joined.
std::vector<std::uint32_t> valley_bottoms(
    std::size_t n_vertices, std::span<const IndexedTriangle> triangles) {
  std::vector<std::uint32_t> down(n_vertices);
  std::iota(down.begin(), down.end(), std::uint32_t{0});
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t lowest = std::min(a, std::min(b, c));
    for (const std::uint32_t v : {a, b, c}) down[v] = std::min(down[v], lowest);
  }
  for (std::uint32_t& next : down) next = down[next];
  return down;
}

/// What judge_all() finds where the UmbrellaCheck passes: of `euler` the edges.
/// @return of each triangle: its component
std::vector<std::uint32_t> judge_sound(
    const UmbrellaCheck& check, std::span<const IndexedTriangle> triangles,
    SurfaceReport& report) {
  Components valleys(check.n_vertices());
  const std::vector<std::uint32_t> bottom =
      valley_bottoms(check.n_vertices(), triangles);
  for (const auto& [a, b, c] : triangles) {
    valleys.join(bottom[a], bottom[b]);
    valleys.join(bottom[a], bottom[c]);
  }
  for (std::uint32_t v = 0; v < check.n_vertices(); ++v)
    if (!check.is_used(v)) report.unused_vertices.push_back(v);
  report.oriented = report.orientable = true;
  report.euler = -static_cast<std::int64_t>(3 * triangles.size() / 2);
  return name_components(
      triangles.size(), check.n_vertices(),
      [&](std::uint32_t t) { return valleys.root(bottom[triangles[t][0]]); },
      report);
}

/// All counts, of `euler` the edges, and the orientation.
/// @return of each triangle: its component
std::vector<std::uint32_t> judge_all(std::size_t n_vertices,
                                     std::span<const IndexedTriangle> triangles,
                                     SurfaceReport& report) {
  const Stars stars(n_vertices, triangles);
  Components components(triangles.size());
  report.oriented = true;
  StarJudge judge(triangles, report, components);
  stars.for_each([&](const Star& star) { judge(star); });
  report.orientable =
      report.oriented || can_be_oriented(triangles.size(), stars);
  report.euler = -static_cast<std::int64_t>(judge.n_edges());
  return name_components(
      triangles.size(), triangles.size(),
      [&](std::uint32_t t) { return components.root(t); }, report);
}

/// The exponent of a power of two that brings the largest coordinate so near 1
/// that its square and cube neither overflow nor vanish.
///
/// @param unused  rows that do not count, ascending
int scaling_exponent(std::span<const Eigen::Vector3d> vertices,
                     std::span<const std::uint32_t> unused) {
  double largest = 0;
  auto next = unused.begin();
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (next != unused.end() && *next == v)
      ++next;
    else
      largest = std::max(largest, vertices[v].lpNorm<Eigen::Infinity>());
  return largest > 0 ? std::clamp(-std::ilogb(largest), -1000, 1000) : 0;
}

/// Area, volume, and whether each component's volume is positive.
/// @param component  of each triangle
void measure(std::span<const Eigen::Vector3d> vertices,
             std::span<const IndexedTriangle> triangles,
             std::span<const std::uint32_t> component, SurfaceReport& report) {
  struct Part {
    std::optional<Eigen::Vector3d> origin;  // its own, so that little cancels
    double volume = 0;
  };
  const int exponent = scaling_exponent(vertices, report.unused_vertices);
  const double scale = std::ldexp(1, exponent);
  std::vector<Part> parts(report.components);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    auto& [origin, volume] = parts[component[t]];
    const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
      return scale * vertices[triangles[t][i]];
    };
    if (!origin) origin = corner(0);
    const Eigen::Vector3d a = corner(0) - *origin;
    const Eigen::Vector3d b = corner(1) - *origin;
    const Eigen::Vector3d c = corner(2) - *origin;
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    report.area += normal.norm() / 2;
    volume += a.dot(normal) / 6;
  }
  report.area = std::ldexp(report.area, -2 * exponent);
  if (!report.closed || !report.oriented) return;
  report.outward = true;
  for (const Part& part : parts) {
    report.volume += part.volume;
    report.outward = report.outward && part.volume > 0;
  }
  report.volume = std::ldexp(report.volume, -3 * exponent);
}

}  // namespace

SurfaceReport check_surface(std::span<const Eigen::Vector3d> vertices,
                            std::span<const IndexedTriangle> triangles) {
  certificate::require_rows(triangles, vertices.size());
  SurfaceReport report;
  report.triangles = triangles.size();
  for (const auto& [a, b, c] : triangles)
    report.degenerate_triangles += a == b || b == c || c == a ? 1 : 0;

  const UmbrellaCheck check(vertices.size(), triangles);
  const std::vector<std::uint32_t> component =
      check() ? judge_sound(check, triangles, report)
              : judge_all(vertices.size(), triangles, report);
  report.vertices = vertices.size() - report.unused_vertices.size();
  report.euler += static_cast<std::int64_t>(report.vertices) +
                  static_cast<std::int64_t>(triangles.size());
  report.closed = !triangles.empty() && report.boundary_edges == 0 &&
                  report.nonmanifold_edges == 0 &&
                  report.degenerate_triangles == 0;
  report.manifold =
      report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0 &&
      report.degenerate_triangles == 0 && report.duplicate_triangles == 0;
  if (report.closed && report.manifold && report.orientable)
    report.genus =
        static_cast<std::int64_t>(report.components) - report.euler / 2;
  measure(vertices, triangles, component, report);
  return report;
}

}  // namespace umbrella
