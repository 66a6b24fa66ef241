/// @file
/// Incremental construction of a 3D Delaunay triangulation, by one thread or
/// by several that share the work.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/mesh3_internal.h"
#include "delaunay/triangulation3.h"

namespace delaunay {

/// Inserts vertices into a mesh. Several may work on one mesh at a time, each
/// within a part of its own; all use the numbers 0 .. n_inserters - 1.
class BowyerWatson3 {
 public:
  /// @param number  of this inserter, among `n_inserters` on the mesh
  explicit BowyerWatson3(Mesh3& mesh, unsigned number = 0,
                         unsigned n_inserters = 1);

  /// Begins a mesh without cells.
  /// @param first  four vertices that span space, in any order
  void start(const std::array<VertexId, 4>& first);

  /// No other inserter may be at work.
  /// @pre `v` was not inserted before
  /// @throws std::length_error  the cells' numbers would not fit 30 bits
  void insert(VertexId v);

  /// Prepares for insertions within a part, while no inserter is at work.
  /// @param near  a cell to start from
  /// @return whether the cell found at `v` is the part's; without one
  ///   every insertion is refused
  bool enter(const Part& part, VertexId v, CellId near);

  /// The same as insert() if that changes no cell but those of the part that
  /// was entered; otherwise, or if room runs out, changes nothing and returns
  /// false. Others may be at work in disjoint parts.
  bool insert_within_part(VertexId v);

  /// A cell near the vertex inserted last.
  CellId hint() const { return hint_; }

  /// Marks what is left of the cells given out to this inserter as no cells.
  void give_back(std::size_t end);
  /// Beyond the last cell ever used.
  std::size_t end() const { return fresh_.end(); }

 private:
  /// A facet between the cavity and the cell outside it: its corners as
  /// positions in `rim_`, counter-clockwise seen from inside the cavity; the
  /// infinite vertex, if any, is corner 2.
  struct RimFacet {
    std::array<std::uint32_t, 3> corner;
    bool is_infinite;
  };
  /// A vertex of the cavity, relative to the point that is inserted.
  struct RimVertex {
    VertexId id;
    std::array<double, 3> offset;
    double norm2;
  };
  using Site = Mesh3::Site;

  template <bool kExact, class Region>
  CellId walk(CellId start, const double* p, const Region& region) const;
  CellId locate(CellId start, const double* p) const;
  CellId finite(CellId c) const;
  template <bool kExact>
  bool is_beyond(const Cell& cell, unsigned facet, const double* p) const;

  bool in_conflict(const Cell& cell, const double* p) const;
  bool in_conflict_exact(const Cell& cell, const double* p) const;
  template <class Region>
  bool find_cavity(CellId seed, const double* p, const Region& region);
  void prefetch_around(Facet entry);
  void lengthen_lists();
  void forget_cavity();
  std::span<const Facet> cavity() const { return {cavity_.data(), n_cavity_}; }
  std::span<const Facet> boundary() const {
    return {boundary_.data(), n_boundary_};
  }

  std::size_t n_fresh_cells() const;
  void fill_cavity(VertexId apex);
  void allocate_star();
  void make_star_cell(std::size_t k, VertexId apex);
  std::uint32_t rim_position(VertexId v, VertexId apex);
  RimVertex relative(VertexId v, const double* p) const;
  void link_star();
  void link_large_star();
  void link(Facet a, Facet b);
  Facet star_facet(std::size_t k, unsigned corner) const;

  const double* at(VertexId v) const { return sites_[index(v)].at.data(); }
  Site& site(VertexId v) {
    return v == kInfinite ? infinite_site_ : sites_[index(v)];
  }

  Mesh3& mesh_;
  Site* sites_;  // of the mesh
  Cell* cells_;
  Site infinite_site_;
  FreshCells fresh_;
  std::vector<CellId> free_;
  Part part_ = Part::inside(0, 0);
  CellId hint_{};  // near the vertex inserted last, inside the hull

  // Of the insertion under way; kept to reuse their memory. Rim facet k is
  // boundary_[k] seen from the cavity, and star_[k] the new cell on it.
  std::vector<Facet> cavity_;    // each cell through the facet of its entry
  std::vector<Facet> boundary_;  // of equal length, which grows
  std::size_t n_cavity_ = 0;     // so many are in use
  std::size_t n_boundary_ = 0;
  std::vector<CellId> star_;
  std::vector<RimFacet> facets_;
  std::vector<RimVertex> rim_;
  std::uint32_t n_rim_ = 0;
  static constexpr std::size_t kLinkTableSide = 64;
  std::vector<Facet> link_table_;  // by pair of rim positions
};

}  // namespace delaunay
