#include "umbrella/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "umbrella/criteria.h"
#include "umbrella/criterion.h"
#include "umbrella/disjoint_sets_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

/// The facets between cells that are inside and others, as seen from the cell
/// with the smaller id.
template <class IsInside>
std::vector<LocatedTriangle> boundary(const Triangulation3& triangulation,
                                      const Circumspheres& spheres,
                                      IsInside is_inside) {
  std::vector<LocatedTriangle> result;
  for (const Facet facet : facets(triangulation)) {
    const DelaunayTriangle t(triangulation, spheres, facet);
    const auto [here, there] = t.cells();
    if (is_inside(here) != is_inside(there))
      result.push_back({t.corners(), facet});
  }
  std::sort(result.begin(), result.end(), by_corners);
  return result;
}

/// A cell waiting to be carved off. Priorities change as its facets come to the
/// boundary: then it is queued anew, and this entry is out of date.
struct Candidate {
  double priority;
  std::array<VertexId, 4> corners;  // ascending; breaks ties
  CellId cell;
  unsigned facets;  // on the boundary, as bits

  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.priority != b.priority ? a.priority < b.priority
                                    : a.corners > b.corners;
  }
};

class Sculptor {
 public:
  Sculptor(const Triangulation3& triangulation, const Circumspheres& spheres,
           CarveOrder order)
      : triangulation_(triangulation),
        spheres_(spheres),
        order_(order),
        is_inside_(triangulation.cells().size(), true),
        triangles_at_(triangulation.points().size(), 0),
        n_buried_(triangulation.points().size()) {
    for (std::size_t c = triangulation.n_finite_cells(); c < is_inside_.size();
         ++c)
      is_inside_[c] = false;
    for (const Facet facet : facets(triangulation)) note(facet);
    for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c)
      enqueue(CellId{c});
  }

  void carve() {
    while (n_buried_ > 0 && !queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (is_inside_[index(next.cell)] &&
          facets_on_boundary(next.cell) == next.facets &&
          may_go(next.cell, next.facets))
        remove(next.cell);
    }
  }

  bool is_inside(CellId c) const { return is_inside_[index(c)]; }

 private:
  CellId beyond(CellId c, unsigned i) const {
    return triangulation_.cell(c).neighbor[i].cell();
  }
  bool is_boundary(CellId c, unsigned i) const {
    return is_inside(c) != is_inside(beyond(c, i));
  }
  unsigned facets_on_boundary(CellId c) const {
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= is_boundary(c, i) ? 1U << i : 0U;
    return bits;
  }

  /// Counts the facet at its corners if it is on the boundary.
  void note(Facet facet) {
    if (is_boundary(facet.cell(), facet.index()))
      count(facet.cell(), facet.index(), 1);
  }
  void count(CellId c, unsigned i, int change) {
    for (const unsigned k : delaunay::kFacetCorners[i]) {
      int& n = triangles_at_[index(triangulation_.cell(c).vertex[k])];
      n_buried_ -= n == 0 ? 1 : 0;
      n += change;
      n_buried_ += n == 0 ? 1 : 0;
    }
  }
  bool is_buried(VertexId v) const { return triangles_at_[index(v)] == 0; }

  bool may_go(CellId c, unsigned bits) const {
    const auto& v = triangulation_.cell(c).vertex;
    for (unsigned i = 0; i < 4; ++i) {
      if (bits == 1U << i) return is_buried(v[i]);
      for (unsigned k = i + 1; k < 4; ++k)
        if (bits == (1U << i | 1U << k)) return !edge_is_bare(c, i, k);
    }
    return false;
  }

  /// Whether the edge between corners i and k of an inner cell is on the
  /// boundary: some cell around it is outside. The facets opposite to the other
  /// two corners hold the edge.
  bool edge_is_bare(CellId c, unsigned i, unsigned k) const {
    const VertexId a = triangulation_.cell(c).vertex[i];
    const VertexId b = triangulation_.cell(c).vertex[k];
    unsigned through = 0;
    while (through == i || through == k) ++through;
    CellId at = c;
    do {
      const Facet entry = triangulation_.cell(at).neighbor[through];
      at = entry.cell();
      if (!is_inside(at)) return true;
      // On through the other facet at the edge.
      const auto& v = triangulation_.cell(at).vertex;
      through = 0;
      while (through == entry.index() || v[through] == a || v[through] == b)
        ++through;
    } while (at != c);
    return false;
  }

  void enqueue(CellId c) {
    const unsigned bits = facets_on_boundary(c);
    if (bits == 0) return;
    double priority = -std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 4; ++i)
      if ((bits >> i & 1U) != 0)
        priority = std::max(priority, priority_at(Facet(c, i)));
    std::array<VertexId, 4> corners = triangulation_.cell(c).vertex;
    std::sort(corners.begin(), corners.end());
    queue_.push({priority, corners, c, bits});
  }

  /// With h the height of the centre over the facet, on either side of it.
  double priority_at(Facet facet) const {
    const DelaunayTriangle t(triangulation_, spheres_, facet);
    const bool is_inner = t.centers_on_own_side()[0];
    const double r2 = t.squared_circumradius();
    const double R2 = t.squared_cell_radii()[0];
    const double R = std::sqrt(R2);
    if (order_ == CarveOrder::Gamma) {
      const double gamma = 1 - std::min(std::sqrt(r2) / R, 1.0);
      return is_inner ? -gamma : gamma;
    }
    const double h = std::sqrt(std::max(R2 - r2, 0.0));
    return is_inner ? r2 / (R + h) : R + h;
  }

  void remove(CellId c) {
    for (unsigned i = 0; i < 4; ++i) count(c, i, is_boundary(c, i) ? -1 : 1);
    is_inside_[index(c)] = false;
    for (unsigned i = 0; i < 4; ++i)
      if (is_inside(beyond(c, i))) enqueue(beyond(c, i));
  }

  const Triangulation3& triangulation_;
  const Circumspheres& spheres_;
  CarveOrder order_;
  std::vector<bool> is_inside_;    // by cell
  std::vector<int> triangles_at_;  // on the boundary, by vertex
  std::size_t n_buried_;           // vertices without such triangles
  std::priority_queue<Candidate> queue_;
};

}  // namespace

std::vector<LocatedTriangle> sculpture(const Triangulation3& triangulation,
                                       const Circumspheres& spheres,
                                       CarveOrder order) {
  Sculptor sculptor(triangulation, spheres, order);
  sculptor.carve();
  return boundary(triangulation, spheres,
                  [&](CellId c) { return sculptor.is_inside(c); });
}

std::vector<LocatedTriangle> ball_merge(const Triangulation3& triangulation,
                                        const Circumspheres& spheres,
                                        double ratio) {
  const std::size_t outside = triangulation.n_finite_cells();
  const auto node = [&](CellId c) { return std::min(index(c), outside); };
  DisjointSets bodies(outside + 1);
  for (const Facet facet : facets(triangulation)) {
    const DelaunayTriangle t(triangulation, spheres, facet);
    const auto [here, there] = t.cells();
    if (intersection_ratio(t.squared_lambdas(), t.is_gabriel()) > ratio)
      bodies.unite(node(here), node(there));
  }

  std::vector<std::size_t> n_cells(outside + 1);
  for (std::size_t c = 0; c < outside; ++c) ++n_cells[bodies.root(c)];
  n_cells[bodies.root(outside)] = 0;
  const auto largest = static_cast<std::size_t>(
      std::max_element(n_cells.begin(), n_cells.end()) - n_cells.begin());
  if (n_cells[largest] == 0) return {};
  return boundary(triangulation, spheres,
                  [&](CellId c) { return bodies.root(node(c)) == largest; });
}

}  // namespace umbrella
