/// @file
/// Bowyer-Watson insertion [Bowyer81; Watson81]: find the cells whose open
/// circumball holds the new point (the cavity), and star its boundary from
/// the point. The hull is closed by cells with an infinite vertex, so that
/// every facet has two sides.
///
/// Departures. A cell is one cache line and caches its circumsphere as two
/// squared radii, one certainly inside and one certainly outside for every
/// query point (docs/math.md, "Cached circumsphere"): one distance decides
/// almost every test without touching a vertex. Only a query between the two
/// goes on to the exact, symbolically perturbed predicate. Cells already
/// known to be in the cavity or next to it carry that mark in the sign bits
/// of these two numbers, so no cell is tested twice and no mark has to be
/// cleared: cavity cells are overwritten, outer ones are linked anyway.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "delaunay/bowyer_watson3_internal.h"
#include "delaunay/cavity_search_internal.h"
#include "predicates/predicates.h"

namespace delaunay {
namespace {

struct Vector {
  double x, y, z;
};

Vector cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

BowyerWatson3::BowyerWatson3(Mesh3& mesh, unsigned number, unsigned n_inserters)
    : mesh_(mesh),
      sites_(mesh.sites.data()),
      cells_(mesh.cells.data()),
      fresh_(number, n_inserters),
      link_table_(kLinkTableSide * kLinkTableSide) {
  lengthen_lists(64);
}

void BowyerWatson3::start(const std::array<VertexId, 4>& first) {
  auto [a, b, c, d] = first;
  const int sign = predicates::orient3d(at(a), at(b), at(c), at(d));
  assert(sign != 0);
  if (sign < 0) std::swap(a, b);

  // Cell 0 is abcd, cell i + 1 lies beyond its facet i.
  beyond_hull_ = CellId{1};
  const std::array<VertexId, 4> v = {a, b, c, d};
  for (unsigned i = 0; i < 5; ++i) fresh_.take();
  cells_[0].vertex = v;
  const std::array spokes = {relative(a, at(d)), relative(b, at(d)),
                             relative(c, at(d))};
  const SpokeTriple base = {0, 1, 2};
  const CellId cell{0};
  set_star_spheres(at(d), {spokes, {&base, 1}, {&cell, 1}}, cells_);
  for (unsigned i = 0; i < 4; ++i) {
    const auto& corner = kFacetCorners[i];
    Cell& outer = cells_[i + 1];
    outer.vertex = {v[corner[0]], v[corner[1]], v[corner[2]], kInfinite};
    forget_sphere(outer);
    link(Facet(CellId{0}, i), Facet(CellId{i + 1}, 3));
    // Across the edge opposite corner[k] lies the facet opposite corner[k].
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned j = corner[k];
      const auto& other = kFacetCorners[j];
      const auto at_i = static_cast<unsigned>(
          std::find(other.begin(), other.end(), i) - other.begin());
      outer.neighbor[k] = Facet(CellId{j + 1}, at_i);
    }
  }
}

void BowyerWatson3::insert(VertexId v) {
  const double* p = at(v);
  find_cavity(locate(hint_, p), v, Everything{});
  mesh_.make_room(fresh_.end_after(n_fresh_cells()));
  cells_ = mesh_.cells.data();
  fill_cavity(v);
}

void BowyerWatson3::resume(CellId near) {
  cells_ = mesh_.cells.data();
  hint_ = finite(near);
  n_star_ = 0;
}

bool BowyerWatson3::enter(const Part& part, VertexId v, CellId near) {
  resume(near);
  lacks_room_ = false;
  part_ = part;
  hint_ = finite(locate(hint_, at(v)));
  return part_.may_visit(cells_[index(hint_)]);
}

bool BowyerWatson3::insert_within_part(VertexId v) {
  if (lacks_room_) return false;
  const double* p = at(v);
  const CellId seed = walk<false>(hint_, p, part_);
  const Cell& found = cells_[index(seed)];
  if (!part_.owns(found)) return false;
  if (!found.is_infinite()) hint_ = seed;
  if (!in_conflict(found, p)) return false;
  const bool is_within = find_cavity(seed, v, part_);
  lacks_room_ = fresh_.end_after(n_fresh_cells()) > mesh_.cells.size();
  if (is_within && !lacks_room_)
    fill_cavity(v);
  else
    forget_cavity();
  return is_within && !lacks_room_;
}

// ---- Location ----

template <bool kExact>
bool BowyerWatson3::is_beyond(const Cell& cell, unsigned facet,
                              const double* p) const {
  const auto& corner = kFacetCorners[facet];
  const double* a = at(cell.vertex[corner[0]]);
  const double* b = at(cell.vertex[corner[1]]);
  const double* c = at(cell.vertex[corner[2]]);
  if constexpr (kExact) {
    return predicates::orient3d(a, b, c, p) > 0;
  } else {
    const std::array<double, 3> u = {a[0] - p[0], a[1] - p[1], a[2] - p[2]};
    const std::array<double, 3> v = {b[0] - p[0], b[1] - p[1], b[2] - p[2]};
    const std::array<double, 3> w = {c[0] - p[0], c[1] - p[1], c[2] - p[2]};
    const Vector vw = cross(v, w);
    return u[0] * vw.x + u[1] * vw.y + u[2] * vw.z < 0;
  }
}

// A cell made last whose cached sphere holds p. There is one where p becomes a
// neighbour of the vertex inserted last, but for ties.
std::optional<CellId> BowyerWatson3::near_in_star(const double* p) const {
  for (const CellId c : std::span(star_).first(n_star_)) {
    const Cell& cell = cells_[index(c)];
    if (squared_distance(cell, p) < cell.inside2) return c;
  }
  return std::nullopt;
}

// Visibility walk. Any cell in conflict will do, so it stops at the first
// whose cached sphere holds p. Rounded signs may mislead it or make it
// circle, never to a wrong result: they get a bounded number of steps, and
// the exact walk ends on every Delaunay triangulation [Devillers02].
// Most walks are short. Where stars are large, as on surfaces of revolution,
// whose points share spheres with circles of others, each leads through one:
// so after a few steps all cells of the star are asked at once.
// Of cells that the region does not own it reads the corners only, and it ends
// where no facet is left that it may cross.
template <bool kExact, class Region>
CellId BowyerWatson3::walk(CellId start, const double* p,
                           const Region& region) const {
  CellId current = start;
  unsigned entry = 4;
  constexpr std::size_t kFewSteps = 8;
  const std::size_t max_steps =
      kExact ? std::numeric_limits<std::size_t>::max() : 4096;
  for (std::size_t step = 0; step < max_steps; ++step) {
    const Cell& cell = cells_[index(current)];
    if (cell.is_infinite()) return current;
    count(counters_.walk_steps);
    const bool is_own = region.owns(cell);
    if (is_own && squared_distance(cell, p) < cell.inside2) return current;
    if (!kExact && step == kFewSteps)
      if (const auto found = near_in_star(p)) return *found;
    unsigned exit = 4;
    for (unsigned k = 0; k < 4 && exit == 4; ++k) {
      const auto i = static_cast<unsigned>((k + step) % 4);
      if (i != entry && (is_own || region.may_cross(cell, i)) &&
          is_beyond<kExact>(cell, i, p))
        exit = i;
    }
    if (exit == 4) return current;
    entry = cell.neighbor[exit].index();
    current = cell.neighbor[exit].cell();
  }
  return current;
}

/// The cell itself, or of an infinite one its neighbour inside the hull.
CellId BowyerWatson3::finite(CellId c) const {
  const Cell& cell = cells_[index(c)];
  return cell.is_infinite() ? cell.neighbor[3].cell() : c;
}

CellId BowyerWatson3::locate(CellId start, const double* p) const {
  const CellId near = walk<false>(start, p, Everything{});
  if (in_conflict(cells_[index(near)], p)) return near;
  const CellId found = walk<true>(finite(near), p, Everything{});
  assert(in_conflict(cells_[index(found)], p));
  return found;
}

// ---- Cavity ----

bool BowyerWatson3::in_conflict(const Cell& cell, const double* p) const {
  const double d2 = squared_distance(cell, p);
  if (d2 < cell.inside2) return true;
  if (d2 > cell.outside2) return false;
  count(counters_.exact_tests);
  return in_conflict_exact(cell, p);
}

bool BowyerWatson3::in_conflict_exact(const Cell& cell, const double* p) const {
  const auto& v = cell.vertex;
  if (!cell.is_infinite())
    return mesh_.lattice.insphere_perturbed(at(v[0]), at(v[1]), at(v[2]),
                                            at(v[3]), p) > 0;
  const int side = mesh_.lattice.orient3d(at(v[0]), at(v[1]), at(v[2]), p);
  if (side != 0) return side > 0;
  // In the plane of a hull facet, the ball beyond it is the disc that the
  // ball on its inner side cuts out, perturbed alike.
  const Cell& inner = cells_[index(cell.neighbor[3].cell())];
  return mesh_.lattice.insphere_perturbed(
             at(inner.vertex[0]), at(inner.vertex[1]), at(inner.vertex[2]),
             at(inner.vertex[3]), p) > 0;
}

// The boundary is a triangulated sphere: n facets have n / 2 + 2 corners. One
// more is written, and not counted.
void BowyerWatson3::lengthen_lists(std::size_t n) {
  cavity_.resize(n);
  boundary_.resize(n);
  open_.resize(n);
  open_inside_.resize(n);
  star_.resize(n);
  corners_.resize(n);
  rim_.resize(n / 2 + 3);
  spokes_.resize(n / 2 + 3);
}

// Breadth first, through all facets of each cell but the one it was entered
// by; cells that need the exact predicate wait until no other is left. Ends
// with false, and marks in place, where the cavity leaves the region.
template <class Region>
bool BowyerWatson3::find_cavity(CellId seed, VertexId v, const Region& region) {
  const double* p = at(v);
  CavitySearch search{.cells = cells_,
                      .cavity = cavity_.data(),
                      .boundary = boundary_.data(),
                      .open = open_.data(),
                      .p = {p[0], p[1], p[2]}};
  search.add_seed(seed);
  search.look(cells_[index(seed)].neighbor[0]);
  count(counters_.sphere_tests);
  std::size_t k = 0;
  while (k < search.n_cavity) {
    if (search.needed_room() > cavity_.size()) [[unlikely]] {
      lengthen_lists(2 * cavity_.size());
      search.cavity = cavity_.data();
      search.boundary = boundary_.data();
      search.open = open_.data();
    }
    const Facet entry = search.cavity[k];
    const Cell& cell = cells_[index(entry.cell())];
    if (!region.owns(cell)) break;
    for (unsigned i = 1; i < 4; ++i)
      search.look(cell.neighbor[(entry.index() + i) % 4]);
    count(counters_.sphere_tests, 3);
    ++k;
    if (k == search.n_cavity && search.n_open > 0) [[unlikely]]
      search = with_open_decided(search, v);
  }
  n_cavity_ = search.n_cavity;
  n_boundary_ = search.n_boundary;
  return k == search.n_cavity;
}

/// Ties on a lattice are broken first, all of them, so that none waits for
/// another. What else there is takes longer, and a cell met twice is open
/// twice: so it is tested when its turn comes, if it was not seen meanwhile. By
/// value, so that the search that calls it can stay in registers.
CavitySearch BowyerWatson3::with_open_decided(CavitySearch search, VertexId v) {
  constexpr std::uint8_t kNoTie = 2;
  const predicates::LatticePoint* const points = mesh_.lattice_points.data();
  const float reach2 = mesh_.tie_reach2;
  const predicates::LatticeTies ties(reach2 > 0 ? points[index(v)]
                                                : predicates::LatticePoint{});
  for (std::size_t i = 0; i < search.n_open; ++i) {
    const Cell& cell = cells_[index(search.open[i].cell())];
    const auto& [a, b, c, d] = cell.vertex;
    open_inside_[i] = cell.outside2 <= reach2
                          ? ties.is_inside(points[index(a)], points[index(b)],
                                           points[index(c)], points[index(d)])
                          : kNoTie;
  }
  for (std::size_t i = 0; i < search.n_open; ++i) {
    const Facet f = search.open[i];
    bool inside = open_inside_[i] == 1;
    if (open_inside_[i] == kNoTie && !search.has_seen(f))
      inside = in_conflict_exact(cells_[index(f.cell())], search.p.data());
    search.add_unless_seen(f, inside);
  }
  count(counters_.exact_tests, search.n_open);
  search.n_open = 0;
  return search;
}

void BowyerWatson3::forget_cavity() {
  for (const Facet f : cavity()) unmark(cells_[index(f.cell())].inside2);
  for (const Facet f : boundary()) unmark(cells_[index(f.cell())].outside2);
}

// ---- End ----

const std::vector<CellId>& BowyerWatson3::gaps(std::size_t end) {
  while (fresh_.end_after(1) <= end) {
    free_.push_back(fresh_.take());
    Mesh3::remove(mesh_.cells[index(free_.back())]);
  }
  return free_;
}

}  // namespace delaunay
