#include <algorithm>

#include "umbrella/incidence_internal.h"
#include "umbrella/labelling_internal.h"

namespace umbrella {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

void StarParts::clear() {
  cells_.clear();
  begin_.clear();
  is_inside_.clear();
  n_inside_ = 0;
}

void StarParts::begin_part(bool is_inside) {
  begin_.push_back(cells_.size());
  is_inside_.push_back(is_inside);
  n_inside_ += is_inside ? 1 : 0;
}

Labelling::Labelling(const Triangulation3& triangulation)
    : triangulation_(triangulation),
      is_inside_(triangulation.cells().size()),
      n_triangles_(triangulation.points().size()),
      cell_of_vertex_(triangulation.points().size()),
      seen_(triangulation.cells().size()) {
  for (std::size_t c = triangulation.n_finite_cells(); c-- > 0;)
    for (const VertexId v : triangulation.cells()[c].vertex)
      cell_of_vertex_[index(v)] = CellId{static_cast<std::uint32_t>(c)};
}

void Labelling::set_border(std::span<const VertexId> vertices) {
  constexpr std::uint32_t kElsewhere = 1U << 30U;
  is_border_.assign(n_triangles_.size(), 0);
  for (const VertexId v : vertices) {
    is_border_[index(v)] = 1;
    n_triangles_[index(v)] += kElsewhere;
  }
}

bool Labelling::is_at_border(CellId c) const {
  const auto& corners = cell(c).vertex;
  return std::any_of(corners.begin(), corners.end(),
                     [this](VertexId v) { return is_at_border(v); });
}

unsigned Labelling::surface_facets(CellId c) const {
  unsigned facets = 0;
  for (unsigned i = 0; i < 4; ++i)
    if (is_on_surface(Facet(c, i))) facets |= 1U << i;
  return facets;
}

void Labelling::flip(CellId c) {
  const Cell& cell = triangulation_.cell(c);
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t change = is_on_surface(Facet(c, i)) ? ~0U : 1U;
    for (const unsigned k : delaunay::kFacetCorners[i])
      n_triangles_[index(cell.vertex[k])] += change;  // wraps: minus one
  }
  n_inside_ += is_inside(c) ? ~std::size_t{0} : std::size_t{1};
  is_inside_[index(c)] ^= 1U;
}

void Labelling::find_parts(VertexId v, StarParts& parts) {
  if (is_at_border(v)) leave_window();
  ++n_walks_;
  parts.clear();
  pending_ = {cell_of_vertex_[index(v)]};
  auto& cells = parts.cells_;
  const auto enter = [&](CellId c) {
    seen_[index(c)] = n_walks_;
    cells.push_back(c);
  };
  while (!pending_.empty()) {
    const CellId start = pending_.back();
    pending_.pop_back();
    if (seen_[index(start)] == n_walks_) continue;
    const bool side = is_inside(start);
    parts.begin_part(side);
    enter(start);
    for (std::size_t next = cells.size() - 1; next < cells.size(); ++next) {
      const Cell& cell = triangulation_.cell(cells[next]);
      for (unsigned i = 0; i < 4; ++i) {
        const CellId beyond = cell.neighbor[i].cell();
        if (cell.vertex[i] == v || seen_[index(beyond)] == n_walks_) continue;
        if (is_inside(beyond) == side)
          enter(beyond);
        else
          pending_.push_back(beyond);
      }
    }
  }
}

bool Labelling::is_edge_used(CellId c, unsigned i, unsigned k) const {
  const Cell& start = triangulation_.cell(c);
  const VertexId a = start.vertex[i], b = start.vertex[k];
  // Around the edge, leaving each cell by the facet it was not entered by.
  VertexId pivot = start.vertex[i == 0 || k == 0 ? (i + k == 1 ? 2 : 1) : 0];
  CellId at = c;
  do {
    const Cell& cell = triangulation_.cell(at);
    unsigned out = 0;
    while (cell.vertex[out] != pivot) ++out;
    if (is_on_surface(Facet(at, out))) return true;
    // The corner of this cell that is neither on the edge nor across.
    for (const VertexId v : cell.vertex)
      if (v != a && v != b && v != cell.vertex[out]) pivot = v;
    at = cell.neighbor[out].cell();
  } while (at != c);
  return false;
}

/// Calls visit(facet) for each triangle, by the lower of its cells.
template <class Visit>
void Labelling::for_each_on_surface(Visit visit) const {
  for (std::uint32_t c = 0; c < triangulation_.n_finite_cells(); ++c)
    for (unsigned i = 0; i < 4; ++i) {
      const Facet facet(CellId{c}, i);
      if (is_on_surface(facet) && c < index(cell(CellId{c}).neighbor[i].cell()))
        visit(facet);
    }
}

std::vector<LocatedTriangle> Labelling::surface() const {
  std::vector<LocatedTriangle> result;
  for_each_on_surface([&](Facet facet) {
    result.push_back({corners(triangulation_, facet), facet});
  });
  std::sort(result.begin(), result.end(), by_corners);
  return result;
}

namespace {

/// Few edges, or false.
bool are_one_cycle(std::vector<LinkEdge>& edges) {
  constexpr std::size_t kMany = 32;  // time goes with the square
  if (edges.size() > kMany) return false;
  const VertexId start = edges.front()[0];
  VertexId at = edges.front()[1];
  for (auto rest = edges.begin() + 1; rest != edges.end(); ++rest) {
    const auto goes_on = [at](const LinkEdge& e) {
      return e[0] == at || e[1] == at;
    };
    const auto next = std::find_if(rest, edges.end(), goes_on);
    if (at == start || next == edges.end() ||
        std::any_of(next + 1, edges.end(), goes_on))
      return false;
    std::swap(*rest, *next);
    at = (*rest)[0] == at ? (*rest)[1] : (*rest)[0];
  }
  return at == start;
}

}  // namespace

/// The triangles of the surface are few, and tell most often: if their edges
/// opposite the vertex are one cycle, it parts the star in two. So are none. At
/// the border of a window there are no faults.
std::vector<VertexId> Labelling::faulty_vertices() {
  std::vector<Triangle> surface;
  for_each_on_surface(
      [&](Facet facet) { surface.push_back(corners(triangulation_, facet)); });
  const Incidence incidence(n_triangles_.size(), surface.size(),
                            [&](TriangleIndex t) { return surface[t]; });
  std::vector<VertexId> result;
  std::vector<LinkEdge> edges;
  StarParts parts;
  for (std::uint32_t i = 0; i < n_triangles_.size(); ++i) {
    const VertexId v{i};
    if (is_at_border(v)) continue;
    edges.clear();
    for (const TriangleIndex t : incidence.at(v))
      edges.push_back(opposite_edge(surface[t], v));
    if (edges.empty() || are_one_cycle(edges)) continue;
    find_parts(v, parts);
    if (parts.n_faults() > 0) result.push_back(v);
  }
  return result;
}

}  // namespace umbrella
