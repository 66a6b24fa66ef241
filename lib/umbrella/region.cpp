#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "predicates/predicates.h"
#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/region_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;

// Marks of vertices: sums of them over three corners count both.
constexpr std::uint8_t kInRegion = 1;
constexpr std::uint8_t kStuck = 4;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool has_vertex(const Cell& cell, VertexId v) {
  return std::find(cell.vertex.begin(), cell.vertex.end(), v) !=
         cell.vertex.end();
}

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
  if (region.stuck.empty()) return region.vertices;
  std::size_t n = 0;  // vertices of the triangulation that matter
  for (const VertexId v : region.vertices) n = std::max(n, index(v) + 1);
  for (const LocatedTriangle& c : candidates)
    n = std::max(n, index(c.corners[2]) + 1);
  std::vector<bool> is_met(n);
  std::vector<VertexId> result = region.vertices;
  for (const VertexId v : result) is_met[index(v)] = true;
  for (const LocatedTriangle& c : candidates)
    for (const VertexId v : c.corners) {
      if (is_met[index(v)]) continue;
      is_met[index(v)] = true;
      result.push_back(v);
    }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Region> merge_holes(std::span<const Hole> holes,
                                const WorkingSurface& surface) {
  DisjointSets sets(holes.size());
  std::vector<std::uint32_t> hole_of_vertex(surface.n_vertices(), kNone);
  for (std::uint32_t h = 0; h < holes.size(); ++h)
    for (const VertexId v : holes[h].vertices) {
      std::uint32_t& known = hole_of_vertex[index(v)];
      if (known == kNone)
        known = h;
      else
        sets.unite(known, h);
    }
  const auto join_corners = [&](TriangleIndex t) {
    std::array<std::uint32_t, 3> hole;
    for (unsigned i = 0; i < 3; ++i)
      hole[i] = hole_of_vertex[index(surface.corners(t)[i])];
    if (std::count(hole.begin(), hole.end(), kNone) > 0) return;
    sets.unite(hole[0], hole[1]);
    sets.unite(hole[0], hole[2]);
  };
  for (const Hole& hole : holes)
    for (const VertexId v : hole.vertices) surface.for_each_at(v, join_corners);

  std::vector<Region> regions;
  std::vector<std::uint32_t> region_of_set(holes.size(), kNone);
  for (std::size_t v = 0; v < hole_of_vertex.size(); ++v) {
    if (hole_of_vertex[v] == kNone) continue;
    std::uint32_t& region = region_of_set[sets.root(hole_of_vertex[v])];
    if (region == kNone) {
      region = static_cast<std::uint32_t>(regions.size());
      regions.emplace_back();
    }
    regions[region].vertices.push_back(VertexId{static_cast<std::uint32_t>(v)});
  }
  return regions;
}

CellSet::CellSet(const delaunay::Triangulation3& triangulation,
                 const WorkingSurface& surface)
    : triangulation_(triangulation),
      surface_(surface),
      marks_(triangulation.points().size()) {}

/// Where the cell is found, or would be put.
std::size_t CellSet::slot(CellId c) const {
  constexpr std::uint64_t kGolden = 0x9e37'79b9'7f4a'7c15;  // 2^64 / 1.618
  std::size_t s = (index(c) * kGolden >> 32U) & (slots_.size() - 1);
  while (slots_[s] != kNone && cells_[slots_[s]] != c)
    s = (s + 1) & (slots_.size() - 1);
  return s;
}

std::uint32_t CellSet::position(CellId c) const {
  return is_finite(c) ? slots_[slot(c)]
                      : static_cast<std::uint32_t>(cells_.size());
}

/// The finite cells at a vertex hang together by facets there, so it is enough
/// to go on from one of them.
template <class Visit>
void CellSet::collect(std::span<const VertexId> vertices, Visit visit) {
  constexpr std::size_t kLeastSlots = 256;  // a power of two
  cells_.clear();
  from_.clear();
  n_done_ = 0;
  slots_.assign(kLeastSlots, kNone);
  for (const VertexId v : vertices) marks_[index(v)] = Mark::Wanted;
  for (const VertexId v : vertices)
    if (marks_[index(v)] != Mark::Met)
      if (const auto c = cell_on_surface(v)) enter_all_from(*c, visit);
  for (const VertexId v : vertices)
    if (marks_[index(v)] != Mark::Met) enter_all_from(cell_by_walk(v), visit);
  for (const VertexId v : vertices) marks_[index(v)] = Mark::None;
}

void CellSet::collect(std::span<const VertexId> vertices) {
  collect(vertices, [](CellId, const Cell&) {});
}

/// Each cell is read once: it is far away in memory.
template <class Visit>
void CellSet::enter_all_from(CellId c, Visit visit) {
  enter(c, kNowhere);
  for (; n_done_ < cells_.size(); ++n_done_) {
    const Cell& cell = triangulation_.cell(cells_[n_done_]);
    visit(cells_[n_done_], cell);
    enter_neighbors(cell, from_[n_done_]);
  }
}

void CellSet::enter(CellId c, unsigned from) {
  if (!is_finite(c)) return;
  const std::size_t s = slot(c);
  if (slots_[s] != kNone) return;
  __builtin_prefetch(&triangulation_.cell(c));
  slots_[s] = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(c);
  from_.push_back(static_cast<std::uint8_t>(from));
  if (2 * cells_.size() > slots_.size()) widen();
}

void CellSet::widen() {
  slots_.assign(2 * slots_.size(), kNone);
  for (std::uint32_t p = 0; p < cells_.size(); ++p) slots_[slot(cells_[p])] = p;
}

/// Those across a facet with a wanted corner, but for the one it came from.
void CellSet::enter_neighbors(const Cell& cell, unsigned from) {
  std::array<bool, 4> is_wanted;
  unsigned n_wanted = 0;
  for (unsigned i = 0; i < 4; ++i) {
    Mark& mark = marks_[index(cell.vertex[i])];
    is_wanted[i] = mark != Mark::None;
    n_wanted += is_wanted[i] ? 1 : 0;
    if (is_wanted[i]) mark = Mark::Met;
  }
  for (unsigned i = 0; i < 4; ++i)
    if (i != from && n_wanted > (is_wanted[i] ? 1U : 0U))
      enter(cell.neighbor[i].cell(), cell.neighbor[i].index());
}

std::optional<CellId> CellSet::cell_on_surface(VertexId v) const {
  std::optional<CellId> result;
  surface_.for_each_at(v, [&](TriangleIndex t) {
    const CellId c = surface_.triangle(t).facet.cell();
    if (has_vertex(triangulation_.cell(c), v)) result = c;
  });
  return result;
}

/// At a vertex with triangles whose id is near: it is near in space, too.
CellId CellSet::cell_near(VertexId v) const {
  const std::size_t n = marks_.size();
  for (std::size_t step = 1; step < n; ++step)
    for (const std::size_t u : {index(v) - step, index(v) + step}) {
      if (u >= n) continue;
      if (const auto c =
              cell_on_surface(VertexId{static_cast<std::uint32_t>(u)}))
        return *c;
    }
  return CellId{0};
}

/// Across facets with v beyond, which never leads in a circle in a Delaunay
/// triangulation [Devillers02]. In a flat cell that has v in its plane there
/// may be none: then all cells are looked at.
CellId CellSet::cell_by_walk(VertexId v) const {
  CellId at = cell_near(v);
  while (!has_vertex(triangulation_.cell(at), v)) {
    const Cell& cell = triangulation_.cell(at);
    unsigned i = 0;
    while (i < 4 && !is_beyond(cell, i, v)) ++i;
    if (i == 4) break;
    at = cell.neighbor[i].cell();
  }
  for (std::uint32_t c = 0; !has_vertex(triangulation_.cell(at), v); ++c)
    at = CellId{c};
  return at;
}

/// Whether v is strictly beyond facet i.
bool CellSet::is_beyond(const Cell& cell, unsigned i, VertexId v) const {
  std::array<const double*, 4> corners;
  for (unsigned k = 0; k < 4; ++k)
    corners[k] = triangulation_.point(k == i ? v : cell.vertex[k]).data();
  return predicates::orient3d(corners[0], corners[1], corners[2], corners[3]) <
         0;
}

Neighborhoods::Neighborhoods(const delaunay::Triangulation3& triangulation,
                             const WorkingSurface& surface)
    : triangulation_(triangulation),
      cells_(triangulation, surface),
      mark_(triangulation.points().size()) {}

std::vector<LocatedTriangle> Neighborhoods::candidates(const Region& region) {
  for (const VertexId v : region.vertices) mark_[index(v)] |= kInRegion;
  for (const VertexId v : region.stuck) mark_[index(v)] |= kStuck;
  std::vector<LocatedTriangle> result;
  const auto add_facets = [&](CellId c, const Cell& cell) {
    std::array<unsigned, 4> mark;  // of corners
    unsigned sum = 0;
    for (unsigned k = 0; k < 4; ++k)
      sum += mark[k] = mark_[index(cell.vertex[k])];
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned marks = sum - mark[i];
      if (marks % kStuck < 3 && marks / kStuck < region.reach) continue;
      // A candidate has a corner here, so both its cells are met.
      if (cell.neighbor[i].cell() < c) continue;
      const Facet facet(c, i);
      result.push_back({corners(triangulation_, facet), facet});
    }
  };
  cells_.collect(united(region.vertices, region.stuck), add_facets);
  std::sort(result.begin(), result.end(), by_corners);
  for (const VertexId v : region.vertices) mark_[index(v)] = 0;
  for (const VertexId v : region.stuck) mark_[index(v)] = 0;
  return result;
}

std::vector<VertexId> Neighborhoods::ring(std::span<const VertexId> vertices) {
  cells_.collect(vertices);
  std::vector<VertexId> result(vertices.begin(), vertices.end());
  for (std::uint32_t p = 0; p < cells_.cells().size(); ++p)
    for (const VertexId v : cells_.cell(p).vertex) result.push_back(v);
  sort_unique(result);
  return result;
}

}  // namespace umbrella
