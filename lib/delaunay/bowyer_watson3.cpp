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
#include <stdexcept>

#include "delaunay/bowyer_watson3_internal.h"
#include "predicates/predicates.h"

namespace delaunay {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// Marks of the insertion under way.
bool is_in_cavity(const Cell& c) { return std::signbit(c.inside2); }
bool is_next_to_cavity(const Cell& c) { return std::signbit(c.outside2); }
void mark_in_cavity(Cell& c) { c.inside2 = -c.inside2; }
void unmark_in_cavity(Cell& c) { c.inside2 = -c.inside2; }
void mark_next_to_cavity(Cell& c) { c.outside2 = -std::abs(c.outside2); }
void unmark_next_to_cavity(Cell& c) { c.outside2 = std::abs(c.outside2); }

double squared_distance(const Cell& cell, const double* p) {
  const double x = p[0] - cell.center[0];
  const double y = p[1] - cell.center[1];
  const double z = p[2] - cell.center[2];
  return x * x + y * y + z * z;
}

/// No distance is certain: every test goes to the exact predicate.
void forget_sphere(Cell& cell) {
  cell.center = {0, 0, 0};
  cell.inside2 = 0;
  cell.outside2 = kNever;
}

struct Vector {
  double x, y, z;
};

Vector cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

// Circumsphere of 0, u, v, w, moved to p: centre o + p with
// o = (|u|^2 v x w + |v|^2 w x u + |w|^2 u x v) / (2 u.(v x w)).
// The bounds are certain under the four conditions (docs/math.md, "Cached
// circumsphere"); NaN and overflow fail them.
template <class Vertex>
void set_sphere(Cell& cell, const double* p, const Vertex& u, const Vertex& v,
                const Vertex& w) {
  static constexpr double kMaxFlatness2 = 0x1p41;
  static constexpr double kMaxOffset2 = 0x1p56;
  static constexpr double kMargin = 0x1p-22;

  const Vector vw = cross(v.offset, w.offset);
  const Vector wu = cross(w.offset, u.offset);
  const Vector uv = cross(u.offset, v.offset);
  const double det =
      u.offset[0] * vw.x + u.offset[1] * vw.y + u.offset[2] * vw.z;
  const double scale = 0.5 / det;
  const double x = (u.norm2 * vw.x + v.norm2 * wu.x + w.norm2 * uv.x) * scale;
  const double y = (u.norm2 * vw.y + v.norm2 * wu.y + w.norm2 * uv.y) * scale;
  const double z = (u.norm2 * vw.z + v.norm2 * wu.z + w.norm2 * uv.z) * scale;
  const double r2 = x * x + y * y + z * z;
  cell.center = {p[0] + x, p[1] + y, p[2] + z};
  const double size = std::abs(cell.center[0]) + std::abs(cell.center[1]) +
                      std::abs(cell.center[2]);
  const double l2 = std::max({u.norm2, v.norm2, w.norm2});

  if (l2 * l2 * l2 < kMaxFlatness2 * (det * det) &&
      size * size < kMaxOffset2 * r2 && 0x1p-120 < r2 && r2 < 0x1p120) {
    cell.inside2 = static_cast<float>(r2 * (1 - kMargin));
    cell.outside2 = static_cast<float>(r2 * (1 + kMargin));
  } else {
    forget_sphere(cell);
  }
}

}  // namespace

BowyerWatson3::BowyerWatson3(Mesh3& mesh, unsigned number, unsigned n_inserters)
    : mesh_(mesh),
      sites_(mesh.sites.data()),
      cells_(mesh.cells.data()),
      fresh_(number, n_inserters),
      link_table_(kLinkTableSide * kLinkTableSide) {}

void BowyerWatson3::start(const std::array<VertexId, 4>& first) {
  auto [a, b, c, d] = first;
  const int sign = predicates::orient3d(at(a), at(b), at(c), at(d));
  assert(sign != 0);
  if (sign < 0) std::swap(a, b);

  // Cell 0 is abcd, cell i + 1 lies beyond its facet i.
  const std::array<VertexId, 4> v = {a, b, c, d};
  for (unsigned i = 0; i < 5; ++i) fresh_.take();
  cells_[0].vertex = v;
  std::array<RimVertex, 3> rest;
  for (unsigned i = 0; i < 3; ++i) {
    rest[i] = relative(v[i], at(d));
  }
  set_sphere(cells_[0], at(d), rest[0], rest[1], rest[2]);
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
  find_cavity(locate(hint_, p), p, Everything{});
  mesh_.make_room(fresh_.end_after(n_fresh_cells()));
  cells_ = mesh_.cells.data();
  fill_cavity(v);
}

void BowyerWatson3::resume(CellId near) {
  cells_ = mesh_.cells.data();
  hint_ = finite(near);
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
  const bool is_within = find_cavity(seed, p, part_);
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

// Visibility walk. Any cell in conflict will do, so it stops at the first
// whose cached sphere holds p. Rounded signs may mislead it or make it
// circle, never to a wrong result: they get a bounded number of steps, and
// the exact walk ends on every Delaunay triangulation [Devillers02].
// Of cells that the region does not own it reads the corners only, and it ends
// where no facet is left that it may cross.
template <bool kExact, class Region>
CellId BowyerWatson3::walk(CellId start, const double* p,
                           const Region& region) const {
  CellId current = start;
  unsigned entry = 4;
  const std::size_t max_steps =
      kExact ? std::numeric_limits<std::size_t>::max() : 4096;
  for (std::size_t step = 0; step < max_steps; ++step) {
    const Cell& cell = cells_[index(current)];
    if (cell.is_infinite()) return current;
    const bool is_own = region.owns(cell);
    if (is_own && squared_distance(cell, p) < cell.inside2) return current;
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
  return in_conflict_exact(cell, p);
}

bool BowyerWatson3::in_conflict_exact(const Cell& cell, const double* p) const {
  const auto& v = cell.vertex;
  if (!cell.is_infinite())
    return predicates::insphere_perturbed(at(v[0]), at(v[1]), at(v[2]),
                                          at(v[3]), p) > 0;
  const int side = predicates::orient3d(at(v[0]), at(v[1]), at(v[2]), p);
  if (side != 0) return side > 0;
  // In the plane of a hull facet, the ball beyond it is the disc that the
  // ball on its inner side cuts out, perturbed alike.
  const Cell& inner = cells_[index(cell.neighbor[3].cell())];
  return predicates::insphere_perturbed(
             at(inner.vertex[0]), at(inner.vertex[1]), at(inner.vertex[2]),
             at(inner.vertex[3]), p) > 0;
}

// Ends with false, and marks in place, where the cavity leaves the region.
template <class Region>
bool BowyerWatson3::find_cavity(CellId seed, const double* p,
                                const Region& region) {
  cavity_.clear();
  boundary_.clear();
  const auto take = [this](CellId c, Cell& cell) {
    mark_in_cavity(cell);
    cavity_.push_back(c);
    for (const Facet f : cell.neighbor)
      __builtin_prefetch(&cells_[index(f.cell())]);
  };
  take(seed, cells_[index(seed)]);
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    if (!region.owns(cells_[index(cavity_[k])])) return false;
    const auto neighbor = cells_[index(cavity_[k])].neighbor;
    for (const Facet f : neighbor) {
      Cell& cell = cells_[index(f.cell())];
      if (is_in_cavity(cell)) continue;
      if (!is_next_to_cavity(cell)) {
        if (in_conflict(cell, p)) {
          __builtin_prefetch(&site(cell.vertex[f.index()]));
          take(f.cell(), cell);
          continue;
        }
        mark_next_to_cavity(cell);
      }
      boundary_.push_back(f);
    }
  }
  return true;
}

void BowyerWatson3::forget_cavity() {
  for (const CellId c : cavity_) unmark_in_cavity(cells_[index(c)]);
  for (const Facet f : boundary_)
    unmark_next_to_cavity(cells_[index(f.cell())]);
}

// ---- Star ----

void BowyerWatson3::link(Facet a, Facet b) {
  cells_[index(a.cell())].neighbor[a.index()] = b;
  cells_[index(b.cell())].neighbor[b.index()] = a;
}

BowyerWatson3::RimVertex BowyerWatson3::relative(VertexId v,
                                                 const double* p) const {
  const double* q = at(v);
  const double x = q[0] - p[0];
  const double y = q[1] - p[1];
  const double z = q[2] - p[2];
  return {v, {x, y, z}, x * x + y * y + z * z};
}

inline std::uint32_t BowyerWatson3::rim_position(VertexId v, VertexId apex) {
  Site& s = site(v);
  if (s.rim_of == apex) return s.rim_position;
  s.rim_of = apex;
  s.rim_position = n_rim_;
  rim_[n_rim_] =
      v == kInfinite ? RimVertex{v, {0, 0, 0}, 0} : relative(v, at(apex));
  return n_rim_++;
}

/// How many cells the star needs that were never used.
std::size_t BowyerWatson3::n_fresh_cells() const {
  const std::size_t n_known = cavity_.size() + free_.size();
  return boundary_.size() - std::min(boundary_.size(), n_known);
}

// The cells of the star: first those of the cavity, then freed ones, then new
// ones. After this nothing is allocated until the star is complete.
void BowyerWatson3::allocate_star() {
  const std::size_t n = boundary_.size();
  star_.resize(n);
  const std::size_t n_reused = std::min(n, cavity_.size());
  std::copy_n(cavity_.begin(), n_reused, star_.begin());
  std::size_t k = n_reused;
  for (; k < n && !free_.empty(); ++k) {
    star_[k] = free_.back();
    free_.pop_back();
  }
  for (; k < n; ++k) star_[k] = fresh_.take();
  for (k = n_reused; k < cavity_.size(); ++k) {
    Mesh3::remove(cells_[index(cavity_[k])]);
    free_.push_back(cavity_[k]);
  }
  // The rim is a triangulated sphere: n facets have n / 2 + 2 corners.
  if (rim_.size() < n / 2 + 2) rim_.resize(n + 2);
  if (facets_.size() < n) facets_.resize(2 * n);
}

// Slots of the corners and of the apex in the new cell: (a, b, c, apex), or,
// with c infinite, its even permutation (a, apex, b, infinite).
namespace {
constexpr std::array<std::array<std::uint8_t, 4>, 2> kSlots = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}}};
}  // namespace

inline void BowyerWatson3::make_star_cell(std::size_t k, VertexId apex) {
  const double* p = at(apex);
  const Facet outside = boundary_[k];
  Cell& outer = cells_[index(outside.cell())];
  unmark_next_to_cavity(outer);
  const auto& corner = kFacetCorners[outside.index()];
  std::array<VertexId, 3> v = {outer.vertex[corner[0]], outer.vertex[corner[1]],
                               outer.vertex[corner[2]]};
  const bool is_infinite = outer.is_infinite() && outside.index() != 3;
  if (is_infinite) [[unlikely]]
    while (v[2] != kInfinite) std::rotate(v.begin(), v.begin() + 1, v.end());

  const std::uint32_t a = rim_position(v[0], apex);
  const std::uint32_t b = rim_position(v[1], apex);
  const std::uint32_t c = rim_position(v[2], apex);
  facets_[k] = {{a, b, c}, is_infinite};
  const CellId star = star_[k];
  Cell& cell = cells_[index(star)];
  const unsigned apex_slot = kSlots[is_infinite ? 1 : 0][3];
  cell.neighbor[apex_slot] = outside;
  outer.neighbor[outside.index()] = Facet(star, apex_slot);
  if (is_infinite) [[unlikely]] {
    cell.vertex = {v[0], apex, v[1], kInfinite};
    forget_sphere(cell);
  } else {
    cell.vertex = {v[0], v[1], v[2], apex};
    set_sphere(cell, p, rim_[a], rim_[b], rim_[c]);
  }
}

void BowyerWatson3::fill_cavity(VertexId apex) {
  allocate_star();
  n_rim_ = 0;
  std::size_t n = boundary_.size();
  for (std::size_t k = 0; k < n; ++k) make_star_cell(k, apex);
  if (n_rim_ <= kLinkTableSide)
    link_star();
  else
    link_large_star();
  do hint_ = star_[--n];
  while (cells_[index(hint_)].is_infinite());
}

Facet BowyerWatson3::star_facet(std::size_t k, unsigned corner) const {
  return {star_[k], kSlots[facets_[k].is_infinite ? 1 : 0][corner]};
}

// Two star cells share a facet over each edge of the cavity's boundary, which
// is a sphere: its directed edges (i, j) and (j, i) lie on one rim facet each.
// Every entry that is read was written in this insertion, so none is cleared.
void BowyerWatson3::link_star() {
  constexpr std::size_t kSide = kLinkTableSide;
  Facet* const opposite = link_table_.data();
  const std::size_t n = boundary_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto [a, b, c] = facets_[k].corner;
    opposite[a * kSide + b] = star_facet(k, 2);
    opposite[b * kSide + c] = star_facet(k, 0);
    opposite[c * kSide + a] = star_facet(k, 1);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto [a, b, c] = facets_[k].corner;
    Cell& cell = cells_[index(star_[k])];
    const auto& slot = kSlots[facets_[k].is_infinite ? 1 : 0];
    cell.neighbor[slot[2]] = opposite[b * kSide + a];
    cell.neighbor[slot[0]] = opposite[c * kSide + b];
    cell.neighbor[slot[1]] = opposite[a * kSide + c];
  }
}

void BowyerWatson3::link_large_star() {
  struct Edge {
    std::uint64_t ends;
    Facet opposite;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * boundary_.size());
  for (std::size_t k = 0; k < boundary_.size(); ++k)
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint64_t a = facets_[k].corner[(i + 1) % 3];
      const std::uint64_t b = facets_[k].corner[(i + 2) % 3];
      edges.push_back(
          {std::min(a, b) << 32U | std::max(a, b), star_facet(k, i)});
    }
  std::ranges::sort(edges, {}, &Edge::ends);
  for (std::size_t k = 0; k < edges.size(); k += 2) {
    assert(edges[k].ends == edges[k + 1].ends);
    link(edges[k].opposite, edges[k + 1].opposite);
  }
}

// ---- End ----

void BowyerWatson3::remove_unused(std::size_t end) {
  while (fresh_.end_after(1) <= end)
    Mesh3::remove(mesh_.cells[index(fresh_.take())]);
}

}  // namespace delaunay
