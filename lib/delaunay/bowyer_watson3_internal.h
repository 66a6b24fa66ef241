/// @file
/// Incremental construction of a 3D Delaunay triangulation; for
/// triangulation3.cpp alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"

namespace delaunay {

/// The triangulation of the vertices inserted so far, always complete.
class BowyerWatson3 {
 public:
  /// @param points  distinct; quickest if their coordinates fill [-1, 1], for
  ///   spheres far larger or smaller are not cached
  /// @param first   four vertices that span space, in any order
  BowyerWatson3(std::span<const Point3> points,
                const std::array<VertexId, 4>& first);

  /// @pre `v` was not inserted before
  /// @throws std::length_error  the cells' numbers would not fit 30 bits
  void insert(VertexId v);

  /// Cells without gaps, those inside the hull first.
  /// @return how many lie inside the hull
  std::size_t finish(std::vector<Cell>& cells) &&;

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
  /// A vertex, with its place in `rim_` during one insertion, in half a cache
  /// line.
  struct alignas(32) Site {
    std::array<double, 3> at;
    std::uint32_t insertion = 0;
    std::uint32_t rim_position = 0;
  };

  template <bool kExact>
  CellId walk(CellId start, const double* p) const;
  CellId locate(const double* p) const;
  template <bool kExact>
  bool is_beyond(const Cell& cell, unsigned facet, const double* p) const;

  bool in_conflict(const Cell& cell, const double* p) const;
  bool in_conflict_exact(const Cell& cell, const double* p) const;
  void find_cavity(CellId seed, const double* p);

  void fill_cavity(VertexId apex);
  void allocate_star();
  void make_star_cell(std::size_t k, VertexId apex);
  std::uint32_t rim_position(VertexId v, const double* p);
  RimVertex relative(VertexId v, const double* p) const;
  void link_star();
  void link_large_star();
  void link(Facet a, Facet b);
  Facet star_facet(std::size_t k, unsigned corner) const;

  void relocate(CellId from, CellId to);
  template <class Keep>
  std::size_t gather(std::size_t first, Keep keep);

  const double* at(VertexId v) const { return sites_[index(v)].at.data(); }
  Site& site(VertexId v) {
    return v == kInfinite ? sites_.back() : sites_[index(v)];
  }
  void reserve_cells();

  std::vector<Site> sites_;  // by vertex; the infinite one comes last
  std::vector<Cell> cells_;
  std::vector<CellId> free_;
  CellId hint_{};  // a cell near the vertex inserted last

  // Of the insertion under way; kept to reuse their memory. Rim facet k is
  // boundary_[k] seen from the cavity, and star_[k] the new cell on it.
  std::uint32_t insertion_ = 0;
  std::vector<CellId> cavity_;
  std::vector<Facet> boundary_;
  std::vector<CellId> star_;
  std::vector<RimFacet> facets_;
  std::vector<RimVertex> rim_;
  std::uint32_t n_rim_ = 0;
  static constexpr std::size_t kLinkTableSide = 64;
  std::vector<Facet> link_table_;  // by pair of rim positions
};

}  // namespace delaunay
