/// @file
/// The star of a new vertex over the boundary of its cavity, made in passes
/// over small arrays: corners of the boundary are numbered, cells written,
/// circumspheres computed, neighbours linked.
#include <algorithm>
#include <cassert>
#include <utility>

#include "delaunay/bowyer_watson3_internal.h"
#include "delaunay/cavity_search_internal.h"

namespace delaunay {
namespace {

// Slots of the corners and of the apex in the new cell: (a, b, c, apex), or,
// with c infinite, its even permutation (a, apex, b, infinite).
constexpr std::array<std::uint8_t, 4> kFiniteSlots = {0, 1, 2, 3};
constexpr std::array<std::uint8_t, 4> kInfiniteSlots = {0, 2, 3, 1};

/// Numbers the vertices of the rim in the order they are met. Each is met six
/// times, and no branch has to guess whether it is the first time: less the
/// rim, the number of a vertex of another rim is at least 2^32.
struct RimNumbers {
  VertexId* list;
  std::uint64_t rim;
  std::uint64_t count = 0;

  std::uint32_t of(VertexId v, Mesh3::Site& site) {
    const std::uint64_t known = site.rim_number - rim;
    const std::uint64_t number = std::min(known, count);
    site.rim_number = rim + number;
    list[count] = v;
    count += known >> 32U != 0 ? 1 : 0;
    return static_cast<std::uint32_t>(number);
  }
};

}  // namespace

void BowyerWatson3::link(Facet a, Facet b) {
  cells_[index(a.cell())].neighbor[a.index()] = b;
  cells_[index(b.cell())].neighbor[b.index()] = a;
}

Spoke BowyerWatson3::relative(VertexId v, const double* p) const {
  if (v == kInfinite) return {{0, 0, 0}, 0};
  const double* q = at(v);
  const double x = q[0] - p[0];
  const double y = q[1] - p[1];
  const double z = q[2] - p[2];
  return {{x, y, z}, x * x + y * y + z * z};
}

/// How many cells the star needs that were never used.
std::size_t BowyerWatson3::n_fresh_cells() const {
  const std::size_t n_known = n_cavity_ + free_.size();
  return n_boundary_ - std::min(n_boundary_, n_known);
}

// The cells of the star: first those of the cavity, then freed ones, then new
// ones. After this nothing is allocated until the star is complete.
void BowyerWatson3::allocate_star() {
  const std::size_t n = n_boundary_;
  const std::size_t n_reused = std::min(n, n_cavity_);
  std::size_t k = 0;
  for (; k < n_reused; ++k) star_[k] = cavity_[k].cell();
  for (; k < n && !free_.empty(); ++k) {
    star_[k] = free_.back();
    free_.pop_back();
  }
  for (; k < n; ++k) star_[k] = fresh_.take();
  for (k = n_reused; k < n_cavity_; ++k) {
    Mesh3::remove(cells_[index(cavity_[k].cell())]);
    free_.push_back(cavity_[k].cell());
  }
}

void BowyerWatson3::make_star_cells(VertexId apex) {
  RimNumbers numbers{rim_.data(), Site::rim_of(apex)};
  Site* const sites = sites_;
  for (std::size_t k = 0; k < n_boundary_; ++k) {
    const Facet outside = boundary_[k];
    Cell& outer = cells_[index(outside.cell())];
    unmark(outer.outside2);
    const auto& corner = kFacetCorners[outside.index()];
    VertexId a = outer.vertex[corner[0]];
    VertexId b = outer.vertex[corner[1]];
    VertexId c = outer.vertex[corner[2]];
    Cell& cell = cells_[index(star_[k])];
    Site* last = &infinite_site_;
    if (outer.is_infinite() && outside.index() != 3) [[unlikely]] {
      while (c != kInfinite) c = std::exchange(a, std::exchange(b, c));
      cell.vertex = {a, apex, b, kInfinite};
      beyond_hull_ = star_[k];
      cell.neighbor[kInfiniteSlots[3]] = outside;
      outer.neighbor[outside.index()] = Facet(star_[k], kInfiniteSlots[3]);
    } else {
      last = &sites[index(c)];
      cell.vertex = {a, b, c, apex};
      cell.neighbor[kFiniteSlots[3]] = outside;
      outer.neighbor[outside.index()] = Facet(star_[k], kFiniteSlots[3]);
    }
    SpokeTriple& triple = corners_[k];
    triple[0] = numbers.of(a, sites[index(a)]);
    triple[1] = numbers.of(b, sites[index(b)]);
    triple[2] = numbers.of(c, *last);
  }
  n_rim_ = numbers.count;
}

void BowyerWatson3::fill_cavity(VertexId apex) {
  allocate_star();
  make_star_cells(apex);
  count(counters_.cells_made, n_boundary_);
  const double* p = at(apex);
  for (std::uint32_t i = 0; i < n_rim_; ++i) spokes_[i] = relative(rim_[i], p);
  std::size_t n = n_boundary_;
  n_star_ = n;
  set_star_spheres(p, {spokes_, corners_, {star_.data(), n}}, cells_);
  if (n_rim_ > kLinkTableSide)
    link_large_star();
  else if (infinite_site_.rim_number >> 32U == index(apex))
    link_star([this](std::size_t k) { return slots(k); });
  else
    link_star([](std::size_t) { return kFiniteSlots; });
  do hint_ = star_[--n];
  while (cells_[index(hint_)].is_infinite());
}

BowyerWatson3::Slots BowyerWatson3::slots(std::size_t k) const {
  return rim_[corners_[k][2]] == kInfinite ? kInfiniteSlots : kFiniteSlots;
}

// Two star cells share a facet over each edge of the cavity's boundary, which
// is a sphere: its directed edges (i, j) and (j, i) lie on one rim facet each.
// Every entry that is read was written in this insertion, so none is cleared.
template <class SlotsOf>
void BowyerWatson3::link_star(const SlotsOf& slots_of) {
  constexpr std::size_t kSide = kLinkTableSide;
  Facet* const opposite = link_table_.data();
  for (std::size_t k = 0; k < n_boundary_; ++k) {
    const auto& [a, b, c] = corners_[k];
    const Slots slot = slots_of(k);
    opposite[a * kSide + b] = Facet(star_[k], slot[2]);
    opposite[b * kSide + c] = Facet(star_[k], slot[0]);
    opposite[c * kSide + a] = Facet(star_[k], slot[1]);
  }
  for (std::size_t k = 0; k < n_boundary_; ++k) {
    const auto& [a, b, c] = corners_[k];
    const Slots slot = slots_of(k);
    auto& neighbor = cells_[index(star_[k])].neighbor;
    neighbor[slot[2]] = opposite[b * kSide + a];
    neighbor[slot[0]] = opposite[c * kSide + b];
    neighbor[slot[1]] = opposite[a * kSide + c];
  }
}

void BowyerWatson3::link_large_star() {
  struct Edge {
    std::uint64_t ends;
    Facet opposite;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * n_boundary_);
  for (std::size_t k = 0; k < n_boundary_; ++k)
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint64_t a = corners_[k][(i + 1) % 3];
      const std::uint64_t b = corners_[k][(i + 2) % 3];
      edges.push_back({std::min(a, b) << 32U | std::max(a, b),
                       Facet(star_[k], slots(k)[i])});
    }
  std::ranges::sort(edges, {}, &Edge::ends);
  for (std::size_t k = 0; k < edges.size(); k += 2) {
    assert(edges[k].ends == edges[k + 1].ends);
    link(edges[k].opposite, edges[k + 1].opposite);
  }
}

}  // namespace delaunay
