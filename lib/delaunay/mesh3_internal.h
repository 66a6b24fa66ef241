/// @file
/// A 3D triangulation under construction: what its inserters share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/counters.h"
#include "delaunay/lazy_vector.h"
#include "delaunay/triangulation3.h"
#include "predicates/lattice.h"
#include "predicates/lattice_ties.h"

namespace delaunay {

struct Mesh3 {
  /// A vertex, and its number on the rim of a cavity, added to rim_of() the
  /// vertex that was inserted there. Half a cache line.
  struct alignas(32) Site {
    std::array<double, 3> at;
    std::uint64_t rim_number = rim_of(kInfinite);

    static constexpr std::uint64_t rim_of(VertexId apex) {
      return std::uint64_t{index(apex)} << 32U;
    }
  };

  /// @param points  distinct; quickest if their coordinates fill [-1, 1], for
  ///   spheres far larger or smaller are not cached
  /// @param n_inserters  how many will work on it
  explicit Mesh3(std::span<const Point3> points, unsigned n_inserters = 1);

  /// Makes room for n cells at least.
  /// @throws std::length_error  that is over max_cells
  void make_room(std::size_t n);

  /// Removes the gaps, and all places from `end` on; moves the cells inside the
  /// hull to the front. Looks at no others than those it moves, but at its end.
  /// @param gaps         all places in front of `end` that hold no cell
  /// @param beyond_hull  any infinite cell
  /// @return how many lie inside the hull
  std::size_t compact(std::size_t end, std::vector<CellId> gaps,
                      CellId beyond_hull);

  static bool is_cell(const Cell& c) { return c.vertex[0] != kInfinite; }
  static void remove(Cell& c) { c.vertex[0] = kInfinite; }

  LazyVector<Site> sites;       // by vertex
  predicates::Lattice lattice;  // on which all sites lie, if there is one
  LazyVector<predicates::LatticePoint> lattice_points;  // by vertex, or none
  float tie_reach2 = 0;    // squared radius up to which LatticeTies may decide
  LazyVector<Cell> cells;  // used and unused ones
  std::size_t max_cells = std::size_t{1} << 30U;  // a Facet holds 30 bits
  Counters counters;  // of all inserters, at the end

 private:
  void lay_on_lattice(double unit);
  void link(Facet a, Facet b);
  void relocate(CellId from, CellId to);
  std::vector<CellId> cells_beyond_hull(CellId any);
  template <class Keep>
  void fill(std::span<const CellId> places, Keep keep);
};

/// Vertices that one inserter may use while others use the other parts. What
/// it may read and write then is proved in docs/delaunay.md, "Threads".
class Part {
 public:
  /// @param part_of_vertex  must outlive this object
  /// @param number          of this part
  Part(std::span<const std::uint8_t> part_of_vertex, std::uint8_t number)
      : part_of_vertex_(part_of_vertex.data()), number_(number) {}

  /// All finite corners are in this part: it may be replaced.
  bool owns(const Cell& c) const {
    return part(c, 0) == number_ && part(c, 1) == number_ &&
           part(c, 2) == number_ && (c.is_infinite() || part(c, 3) == number_);
  }
  /// No one else owns it: it will not be replaced.
  bool may_visit(const Cell& c) const {
    const std::uint8_t first = part(c, 0);
    return first == number_ || part(c, 1) != first || part(c, 2) != first ||
           (!c.is_infinite() && part(c, 3) != first);
  }
  /// No one else owns the facet: what lies across will not be replaced.
  /// @param c  finite
  bool may_cross(const Cell& c, unsigned facet) const {
    const auto& [i, j, k] = kFacetCorners[facet];
    const std::uint8_t first = part(c, i);
    return first == number_ || part(c, j) != first || part(c, k) != first;
  }

 private:
  std::uint8_t part(const Cell& c, unsigned corner) const {
    return part_of_vertex_[index(c.vertex[corner])];
  }

  const std::uint8_t* part_of_vertex_;
  std::uint8_t number_;
};

/// An inserter without company owns all.
struct Everything {
  static constexpr bool owns(const Cell&) { return true; }
  static constexpr bool may_cross(const Cell&, unsigned) { return true; }
};

/// Numbers of cells for one of n inserters, in ascending order: every n-th
/// block is its own, so that which numbers it takes depends on its own work
/// alone, and all together leave few gaps.
class FreshCells {
 public:
  static constexpr std::size_t kBlock = 1024;

  FreshCells(unsigned number, unsigned n_inserters)
      : next_(number * kBlock),
        block_end_(next_ + kBlock),
        skip_((n_inserters - 1) * kBlock) {}

  CellId take() {
    if (next_ == block_end_) next_block();
    return CellId{static_cast<std::uint32_t>(next_++)};
  }

  /// Beyond the last number taken so far.
  std::size_t end() const { return next_; }
  /// Beyond the last number after taking n more.
  std::size_t end_after(std::size_t n) const {
    const std::size_t in_block = block_end_ - next_;
    if (n <= in_block) return next_ + n;
    const std::size_t n_blocks = (n - in_block - 1) / kBlock;
    return block_end_ + n_blocks * (kBlock + skip_) + skip_ +
           (n - in_block - n_blocks * kBlock);
  }

 private:
  void next_block() {
    next_ += skip_;
    block_end_ = next_ + kBlock;
  }

  std::size_t next_, block_end_;
  std::size_t skip_;  // from the end of a block to the next
};

}  // namespace delaunay
