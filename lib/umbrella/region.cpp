#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/region_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;
using delaunay::kFacetCorners;

// Marks of vertices: sums of them over three corners count both.
constexpr std::uint8_t kInRegion = 1;
constexpr std::uint8_t kStuck = 4;

}  // namespace

std::vector<VertexId> united(std::span<const VertexId> a,
                             std::span<const VertexId> b) {
  std::vector<VertexId> result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(),
                 std::back_inserter(result));
  return result;
}

std::vector<VertexId> vertices_of(const Region& region,
                                  std::span<const LocatedTriangle> candidates) {
  std::vector<VertexId> result = region.vertices;
  if (region.stuck.empty()) return result;
  for (const LocatedTriangle& c : candidates)
    result.insert(result.end(), c.corners.begin(), c.corners.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Region> merge_holes(std::span<const Hole> holes,
                                const WorkingSurface& surface) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  DisjointSets sets(holes.size());
  std::vector<std::size_t> hole_of_vertex(surface.n_vertices(), kNone);
  for (std::size_t h = 0; h < holes.size(); ++h)
    for (const VertexId v : holes[h].vertices) {
      std::size_t& known = hole_of_vertex[index(v)];
      if (known == kNone)
        known = h;
      else
        sets.unite(known, h);
    }
  for (TriangleIndex t = 0; t < surface.n_indices(); ++t) {
    std::array<std::size_t, 3> hole;
    for (unsigned i = 0; i < 3; ++i)
      hole[i] = hole_of_vertex[index(surface.corners(t)[i])];
    if (!surface.contains(t) || std::count(hole.begin(), hole.end(), kNone) > 0)
      continue;
    sets.unite(hole[0], hole[1]);
    sets.unite(hole[0], hole[2]);
  }

  std::vector<Region> regions;
  std::vector<std::size_t> region_of_set(holes.size(), kNone);
  for (std::size_t v = 0; v < hole_of_vertex.size(); ++v) {
    if (hole_of_vertex[v] == kNone) continue;
    std::size_t& region = region_of_set[sets.root(hole_of_vertex[v])];
    if (region == kNone) {
      region = regions.size();
      regions.emplace_back();
    }
    regions[region].vertices.push_back(VertexId{static_cast<std::uint32_t>(v)});
  }
  return regions;
}

CellSet::CellSet(const delaunay::Triangulation3& triangulation)
    : triangulation_(triangulation),
      cell_of_vertex_(triangulation.points().size()),
      place_(triangulation.n_finite_cells()),
      is_wanted_(triangulation.points().size()) {
  for (std::size_t c = 0; c < triangulation.n_finite_cells(); ++c)
    for (const VertexId v : triangulation.cells()[c].vertex)
      cell_of_vertex_[index(v)] = CellId{static_cast<std::uint32_t>(c)};
}

std::uint32_t CellSet::position(CellId c) const {
  if (index(c) >= place_.size())
    return static_cast<std::uint32_t>(cells_.size());
  return is_there(c) ? place_[index(c)]
                     : std::numeric_limits<std::uint32_t>::max();
}

/// The finite cells at a vertex hang together by facets there, so it is enough
/// to go on from one of them.
void CellSet::collect(std::span<const VertexId> vertices) {
  cells_.clear();
  for (const VertexId v : vertices) is_wanted_[index(v)] = 1;
  std::size_t next = 0;
  for (const VertexId v : vertices) {
    enter(cell_of_vertex_[index(v)]);
    while (next < cells_.size())
      enter_neighbors(triangulation_.cell(cells_[next++]));
  }
  for (const VertexId v : vertices) is_wanted_[index(v)] = 0;
}

void CellSet::enter(CellId c) {
  if (index(c) >= place_.size() || is_there(c)) return;
  __builtin_prefetch(&triangulation_.cell(c));
  place_[index(c)] = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(c);
}

/// Those across a facet with a wanted corner.
void CellSet::enter_neighbors(const Cell& cell) {
  unsigned n_wanted = 0;
  for (const VertexId v : cell.vertex) n_wanted += is_wanted_[index(v)];
  for (unsigned i = 0; i < 4; ++i)
    if (n_wanted > is_wanted_[index(cell.vertex[i])])
      enter(cell.neighbor[i].cell());
}

Neighborhoods::Neighborhoods(const delaunay::Triangulation3& triangulation)
    : triangulation_(triangulation),
      cells_(triangulation),
      mark_(triangulation.points().size()) {}

std::vector<LocatedTriangle> Neighborhoods::candidates(const Region& region) {
  for (const VertexId v : region.vertices) mark_[index(v)] |= kInRegion;
  for (const VertexId v : region.stuck) mark_[index(v)] |= kStuck;
  cells_.collect(united(region.vertices, region.stuck));

  std::vector<LocatedTriangle> result;
  for (const CellId c : cells_.cells()) {
    const Cell& cell = triangulation_.cell(c);
    std::array<unsigned, 4> mark;  // of corners
    unsigned sum = 0;
    for (unsigned k = 0; k < 4; ++k)
      sum += mark[k] = mark_[index(cell.vertex[k])];
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned marks = sum - mark[i];
      if (marks % kStuck < 3 && marks / kStuck < region.reach) continue;
      // A candidate has a corner here, so both its cells were collected.
      if (cell.neighbor[i].cell() < c) continue;
      Triangle t;
      for (unsigned k = 0; k < 3; ++k) t[k] = cell.vertex[kFacetCorners[i][k]];
      std::sort(t.begin(), t.end());
      result.push_back({t, Facet(c, i)});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const LocatedTriangle& a, const LocatedTriangle& b) {
              return a.corners < b.corners;
            });
  for (const VertexId v : region.vertices) mark_[index(v)] = 0;
  for (const VertexId v : region.stuck) mark_[index(v)] = 0;
  return result;
}

std::vector<VertexId> Neighborhoods::ring(std::span<const VertexId> vertices) {
  cells_.collect(vertices);
  std::vector<VertexId> result(vertices.begin(), vertices.end());
  for (std::uint32_t p = 0; p < cells_.cells().size(); ++p)
    for (const VertexId v : cells_.cell(p).vertex) result.push_back(v);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace umbrella
