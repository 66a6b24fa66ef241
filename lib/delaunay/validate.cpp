// One set of checks for both dimensions: the combinatorial ones are written
// over the number of corners, the geometric ones through a few overloads. Local
// conditions imply the global ones: positive cells that close up around every
// ridge and have a convex hull tile that hull, and a tiling whose lifted
// surface is convex across each facet is convex, that is Delaunay
// [Devillers98]. With the perturbation the convexity is strict, hence the
// triangulation unique.
#include "delaunay/validate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "predicates/predicates.h"

namespace delaunay {
namespace {

using std::to_string;

constexpr unsigned dimension_of(const Claim2&) { return 2; }
constexpr unsigned dimension_of(const Claim3&) { return 3; }

const double* at(const auto& claim, VertexId v) {
  return claim.points[index(v)].data();
}

// Sign of a simplex, of a point beyond a facet (+1 outside), of a point in the
// perturbed circumsphere (+1 inside).
int orientation(const Claim2& s, const std::array<VertexId, 3>& v) {
  return predicates::orient2d(at(s, v[0]), at(s, v[1]), at(s, v[2]));
}
int orientation(const Claim3& s, const std::array<VertexId, 4>& v) {
  return predicates::orient3d(at(s, v[0]), at(s, v[1]), at(s, v[2]),
                              at(s, v[3]));
}
int in_ball(const Claim2& s, const std::array<VertexId, 3>& v, VertexId p) {
  return predicates::incircle_perturbed(at(s, v[0]), at(s, v[1]), at(s, v[2]),
                                        at(s, p));
}
int in_ball(const Claim3& s, const std::array<VertexId, 4>& v, VertexId p) {
  return predicates::insphere_perturbed(at(s, v[0]), at(s, v[1]), at(s, v[2]),
                                        at(s, v[3]), at(s, p));
}

std::array<VertexId, 2> facet(const Cell2& c, unsigned i) {
  const auto& k = kSideCorners[i];
  return {c.vertex[k[0]], c.vertex[k[1]]};
}
std::array<VertexId, 3> facet(const Cell& c, unsigned i) {
  const auto& k = kFacetCorners[i];
  return {c.vertex[k[0]], c.vertex[k[1]], c.vertex[k[2]]};
}

bool lexicographic(const auto& a, const auto& b) {
  return std::lexicographical_compare(a.data(), a.data() + a.size(), b.data(),
                                      b.data() + b.size());
}

bool collinear(const Point2& a, const Point2& b, const Point2& c) {
  return predicates::orient2d(a.data(), b.data(), c.data()) == 0;
}
// Collinear in space is collinear in the three coordinate planes.
bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  for (const int i : {0, 1, 2}) {
    const int j = (i + 1) % 3;
    if (!collinear(Point2(a[i], a[j]), Point2(b[i], b[j]),
                   Point2(c[i], c[j]))) {
      return false;
    }
  }
  return true;
}

// Dimension of the affine hull of distinct points.
template <class AnyClaim>
int affine_dimension(const AnyClaim& s) {
  const auto& p = s.points;
  if (p.size() < 3) return static_cast<int>(p.size()) - 1;
  const auto third = std::find_if(p.begin() + 2, p.end(), [&](const auto& q) {
    return !collinear(p[0], p[1], q);
  });
  if (third == p.end()) return 1;
  if constexpr (std::is_same_v<AnyClaim, Claim3>) {
    const bool flat = std::all_of(third, p.end(), [&](const Point3& q) {
      return predicates::orient3d(p[0].data(), p[1].data(), third->data(),
                                  q.data()) == 0;
    });
    return flat ? 2 : 3;
  }
  return 2;
}

std::string points_violation(const auto& s) {
  auto sorted = std::vector(s.points.begin(), s.points.end());
  std::ranges::sort(
      sorted, [](const auto& a, const auto& b) { return lexicographic(a, b); });
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    return "two vertices have the same coordinates";

  std::vector<bool> named(s.points.size());
  for (const VertexId v : s.vertex_of_row) {
    if (index(v) >= named.size())
      return "a row names vertex " + to_string(index(v)) + " of " +
             to_string(named.size());
    named[index(v)] = true;
  }
  const auto orphan = std::ranges::find(named, false);
  if (orphan != named.end())
    return "no row names vertex " + to_string(orphan - named.begin());

  const int dimension = affine_dimension(s);
  if (dimension != s.dimension)
    return "dimension is " + to_string(s.dimension) + ", the points span " +
           to_string(dimension);
  return {};
}

// Checks one cell against itself: ranges, place of kInfinite, orientation.
std::string cell_violation(const auto& s, std::size_t c) {
  const auto& cell = s.cells[c];
  const std::string name = "cell " + to_string(c);
  const bool is_finite = c < s.n_finite_cells;
  if (cell.is_infinite() == is_finite)
    return name + (is_finite ? " should be finite" : " should be infinite");

  const std::size_t corners = cell.vertex.size();
  for (unsigned i = 0; i < corners; ++i) {
    if (i + 1 < corners || is_finite) {
      if (index(cell.vertex[i]) >= s.points.size())
        return name + " has a corner out of range";
    }
    if (index(cell.neighbor[i].cell()) >= s.cells.size() ||
        cell.neighbor[i].index() >= corners)
      return name + " has a neighbour out of range";
  }
  if (is_finite && orientation(s, cell.vertex) <= 0)
    return name + " is not positive";
  return {};
}

// True if b lists the same vertices as a in the opposite sense.
template <std::size_t kSize>
bool opposite(std::array<VertexId, kSize> a,
              const std::array<VertexId, kSize>& b) {
  bool odd = false;
  for (std::size_t i = 0; i < kSize; ++i) {
    const auto j = std::find(a.begin() + i, a.end(), b[i]);
    if (j == a.end()) return false;
    odd ^= (j != a.begin() + i);
    std::iter_swap(a.begin() + i, j);
  }
  return odd;
}

// The shared ridge lies between the hull's corner `own` and `far`; exact on
// collinear (2D) or coplanar (3D) points.
bool unfolded(const Claim2& s, const Cell2& cell, unsigned i, VertexId far) {
  const Point2& own = s.points[index(cell.vertex[i])];
  const Point2& ridge = s.points[index(cell.vertex[1 - i])];
  const Point2& other = s.points[index(far)];
  return lexicographic(own, ridge) == lexicographic(ridge, other);
}
bool unfolded(const Claim3& s, const Cell& cell, unsigned i, VertexId far) {
  const auto sign = [&](VertexId v, int x, int y) {
    const auto flat = [&](VertexId u) {
      return Point2(s.points[index(u)][x], s.points[index(u)][y]);
    };
    return predicates::orient2d(flat(cell.vertex[(i + 1) % 3]).data(),
                                flat(cell.vertex[(i + 2) % 3]).data(),
                                flat(v).data());
  };
  for (const int x : {0, 1, 2}) {
    const int own = sign(cell.vertex[i], x, (x + 1) % 3);
    if (own != 0) return sign(far, x, (x + 1) % 3) == -own;
  }
  return false;  // the hull facet is collinear
}

// Convexity of the hull where infinite cells c and its neighbour i meet.
std::string ridge_violation(const auto& s, std::size_t c, unsigned i) {
  const auto& cell = s.cells[c];
  const auto& next = s.cells[index(cell.neighbor[i].cell())];
  const VertexId far = next.vertex[cell.neighbor[i].index()];
  auto beyond = cell.vertex;
  beyond.back() = far;
  const int sign = orientation(s, beyond);
  if (sign > 0) return "the hull is not convex at cell " + to_string(c);
  if (sign == 0 && !unfolded(s, cell, i, far))
    return "the hull folds back at cell " + to_string(c);
  return {};
}

// Everything two neighbours owe each other.
std::string facet_violation(const auto& s, std::size_t c, unsigned i) {
  const auto& cell = s.cells[c];
  const auto across = cell.neighbor[i];
  const auto& next = s.cells[index(across.cell())];
  const std::string name = "facet " + to_string(i) + " of cell " + to_string(c);

  using Across = std::decay_t<decltype(across)>;
  if (!(next.neighbor[across.index()] ==
        Across(CellId{static_cast<std::uint32_t>(c)}, i)))
    return name + " is not its neighbour's neighbour";
  if (!opposite(facet(cell, i), facet(next, across.index())))
    return name + " has other corners on its other side";

  const unsigned apex = dimension_of(s);
  if (!cell.is_infinite() && !next.is_infinite()) {
    if (in_ball(s, cell.vertex, next.vertex[across.index()]) > 0)
      return name + " is not locally Delaunay";
  } else if (cell.is_infinite() && next.is_infinite()) {
    // With i == apex two infinite cells would meet in a hull facet.
    if (i == apex || across.index() == apex)
      return name + " has no finite cell on either side";
    return ridge_violation(s, c, i);
  }
  return {};
}

// Each edge of the complex with kInfinite, once.
template <class AnyClaim>
std::size_t n_edges(const AnyClaim& s) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  edges.reserve(s.cells.size() * (dimension_of(s) == 2 ? 3 : 6));
  for (const auto& cell : s.cells) {
    for (unsigned i = 0; i < cell.vertex.size(); ++i) {
      for (unsigned j = 0; j < i; ++j)
        edges.emplace_back(std::minmax(cell.vertex[i], cell.vertex[j]));
    }
  }
  std::ranges::sort(edges);
  const auto end = std::unique(edges.begin(), edges.end());
  return static_cast<std::size_t>(end - edges.begin());
}

// The complex with kInfinite is a sphere of the dimension: V - E + F = 2 in
// the plane, V - E + F - C = 0 in space.
std::string euler_violation(const auto& s) {
  std::vector<bool> used(s.points.size());
  for (const auto& cell : s.cells) {
    for (const VertexId v : cell.vertex)
      if (v != kInfinite) used[index(v)] = true;
  }
  const auto hidden = std::ranges::find(used, false);
  if (hidden != used.end())
    return "no cell uses vertex " + to_string(hidden - used.begin());

  const auto vertices = static_cast<std::ptrdiff_t>(s.points.size() + 1);
  const auto edges = static_cast<std::ptrdiff_t>(n_edges(s));
  const auto cells = static_cast<std::ptrdiff_t>(s.cells.size());
  // In space F = 2 C: four facets a cell, each shared by two.
  const std::ptrdiff_t excess =
      vertices - edges + cells - (dimension_of(s) == 2 ? 2 : 0);
  if (excess != 0) return "Euler's relation is off by " + to_string(excess);
  return {};
}

template <class AnyClaim>
std::string violation(const AnyClaim& s) {
  if (std::string what = points_violation(s); !what.empty()) return what;
  if (s.n_finite_cells > s.cells.size()) return "more finite cells than cells";
  if (s.dimension < static_cast<int>(dimension_of(s)))
    return s.cells.empty() ? "" : "a flat set of points has cells";

  for (std::size_t c = 0; c < s.cells.size(); ++c)
    if (std::string what = cell_violation(s, c); !what.empty()) return what;
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    for (unsigned i = 0; i <= dimension_of(s); ++i) {
      std::string what = facet_violation(s, c, i);
      if (!what.empty()) return what;
    }
  }
  return euler_violation(s);
}

}  // namespace

std::string first_violation(const Claim2& claim) { return violation(claim); }
std::string first_violation(const Claim3& claim) { return violation(claim); }

std::string first_violation(const Triangulation2& t) {
  return violation(Claim2{t.dimension(), t.points(), t.vertex_of_row(),
                          t.cells(), t.n_finite_cells()});
}
std::string first_violation(const Triangulation3& t) {
  return violation(Claim3{t.dimension(), t.points(), t.vertex_of_row(),
                          t.cells(), t.n_finite_cells()});
}

}  // namespace delaunay
