/// @file
/// Incremental construction of a 3D Delaunay triangulation, by one thread or
/// by several that share the work.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/mesh3_internal.h"
#include "delaunay/star_spheres_internal.h"
#include "delaunay/triangulation3.h"

namespace delaunay {

struct CavitySearch;

/// Inserts vertices into a mesh. Several may work on one mesh at a time, each
/// within a part of its own; all use the numbers 0 .. n_inserters - 1.
class alignas(128) BowyerWatson3 {  // shares no cache line with another
 public:
  /// @param number  of this inserter, among `n_inserters` on the mesh
  explicit BowyerWatson3(Mesh3& mesh, unsigned number = 0,
                         unsigned n_inserters = 1);

  /// Begins a mesh without cells.
  /// @param first  four vertices that span space, in any order
  void start(const std::array<VertexId, 4>& first);

  /// Inserts while no other inserter is at work.
  /// @pre `v` was not inserted before
  /// @throws std::length_error  the cells' numbers would not fit 30 bits
  void insert(VertexId v);
  /// To be called before insert() if others were at work.
  /// @param near  any cell, the nearer to the next vertex the better
  void resume(CellId near);

  /// Binds further insertions to a part; no inserter may be at work.
  /// @return whether it may begin near `v`; if not, do not insert
  bool enter(const Part& part, VertexId v, CellId near);
  /// Inserts while others may be at work in disjoint parts: true, or nothing
  /// has changed, since a cell outside the part would have had to, or room
  /// runs out.
  /// @pre enter() returned true
  bool insert_within_part(VertexId v);
  bool lacks_room() const { return lacks_room_; }

  /// A cell near the vertex inserted or sought last.
  CellId hint() const { return hint_; }
  const Counters& counters() const { return counters_; }

  /// Beyond the last cell ever used.
  std::size_t end() const { return fresh_.end(); }
  /// Its own places below `end` that hold no cell, and are marked so.
  const std::vector<CellId>& gaps(std::size_t end);
  /// An infinite cell, or one that has taken the place of such a cell.
  CellId beyond_hull() const { return beyond_hull_; }

 private:
  using Site = Mesh3::Site;

  template <bool kExact, class Region>
  CellId walk(CellId start, const double* p, const Region& region) const;
  std::optional<CellId> near_in_star(const double* p) const;
  CellId locate(CellId start, const double* p) const;
  CellId finite(CellId c) const;
  template <bool kExact>
  bool is_beyond(const Cell& cell, unsigned facet, const double* p) const;

  bool in_conflict(const Cell& cell, const double* p) const;
  bool in_conflict_exact(const Cell& cell, const double* p) const;
  template <class Region>
  bool find_cavity(CellId seed, VertexId v, const Region& region);
  CavitySearch with_open_decided(CavitySearch search, VertexId v);
  void lengthen_lists(std::size_t n);
  void forget_cavity();
  std::span<const Facet> cavity() const { return {cavity_.data(), n_cavity_}; }
  std::span<const Facet> boundary() const {
    return {boundary_.data(), n_boundary_};
  }

  std::size_t n_fresh_cells() const;
  void fill_cavity(VertexId apex);
  void allocate_star();
  void make_star_cells(VertexId apex);
  Spoke relative(VertexId v, const double* p) const;
  using Slots = std::array<std::uint8_t, 4>;
  Slots slots(std::size_t k) const;
  template <class SlotsOf>
  void link_star(const SlotsOf& slots_of);
  void link_large_star();
  void link(Facet a, Facet b);

  const double* at(VertexId v) const { return sites_[index(v)].at.data(); }

  Mesh3& mesh_;
  Site* sites_;  // of the mesh
  Cell* cells_;
  Site infinite_site_;
  FreshCells fresh_;
  std::vector<CellId> free_;
  Part part_{{}, 0};
  bool lacks_room_ = false;
  CellId hint_{};         // near the vertex inserted last, inside the hull
  CellId beyond_hull_{};  // the last infinite cell it made

  mutable Counters counters_;

  // Of the insertion under way; kept to reuse their memory, and made longer
  // together. Star cell k lies on boundary_[k]; its corners are in
  // counter-clockwise order seen from the cavity, an infinite one the last.
  std::vector<Facet> cavity_;  // each cell through the facet of its entry
  std::vector<Facet> boundary_;
  std::vector<Facet> open_;                // left to exact predicates
  std::vector<std::uint8_t> open_inside_;  // what they say
  std::size_t n_cavity_ = 0;               // so many are in use
  std::size_t n_boundary_ = 0;
  std::vector<CellId> star_;
  std::size_t n_star_ = 0;            // of the star that is in the mesh
  std::vector<SpokeTriple> corners_;  // positions in rim_ and spokes_
  std::vector<VertexId> rim_;
  std::vector<Spoke> spokes_;
  std::size_t n_rim_ = 0;
  static constexpr std::size_t kLinkTableSide = 64;
  std::vector<Facet> link_table_;  // by pair of rim positions
};

}  // namespace delaunay
