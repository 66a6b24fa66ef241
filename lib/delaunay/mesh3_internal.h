/// @file
/// A 3D triangulation under construction: what its inserters share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/cell_vector.h"
#include "delaunay/triangulation3.h"
#include "predicates/lattice.h"

namespace delaunay {

struct Mesh3 {
  /// A vertex, and its place on the rim of a cavity in the lower half of
  /// `rim_place`; in the upper half, which vertex was inserted there. Half a
  /// cache line.
  struct alignas(32) Site {
    std::array<double, 3> at;
    std::uint64_t rim_place = ~std::uint64_t{0};
  };

  /// @param points  distinct; quickest if their coordinates fill [-1, 1], for
  ///   spheres far larger or smaller are not cached
  explicit Mesh3(std::span<const Point3> points);

  /// Makes room for n cells at least.
  /// @throws std::length_error  their numbers would not fit 30 bits
  void make_room(std::size_t n);

  /// Removes the places in front of `end` that hold no cell, and all behind;
  /// moves the cells inside the hull to the front.
  /// @return how many lie inside the hull
  std::size_t compact(std::size_t end);

  static bool is_cell(const Cell& c) { return c.vertex[0] != kInfinite; }
  static void remove(Cell& c) { c.vertex[0] = kInfinite; }

  std::vector<Site> sites;      // by vertex
  predicates::Lattice lattice;  // on which all sites lie, if there is one
  LazyVector<Cell> cells;       // used and unused ones

 private:
  void link(Facet a, Facet b);
  void relocate(CellId from, CellId to);
  template <class Keep>
  std::size_t gather(std::size_t first, Keep keep);
};

/// Vertices whose cells one inserter may change: an interval of ids, or all
/// but an interval.
class Part {
 public:
  static Part inside(std::uint32_t begin, std::uint32_t end) {
    return {begin, end - begin, false};
  }
  static Part outside(std::uint32_t begin, std::uint32_t end) {
    return {begin, end - begin, true};
  }

  bool holds(VertexId v) const {
    return (static_cast<std::uint32_t>(v) - begin_ < size_) != is_outside_;
  }
  /// Whether all finite corners are in the part.
  bool holds(const Cell& c) const {
    return holds(c.vertex[0]) && holds(c.vertex[1]) && holds(c.vertex[2]) &&
           (c.is_infinite() || holds(c.vertex[3]));
  }

 private:
  Part(std::uint32_t begin, std::uint32_t size, bool is_outside)
      : begin_(begin), size_(size), is_outside_(is_outside) {}

  std::uint32_t begin_, size_;
  bool is_outside_;
};

/// Numbers of cells for one of n inserters, in ascending order: every n-th
/// block is its own, so that which numbers it takes depends on its own work
/// alone, and all together leave few gaps.
class FreshCells {
 public:
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
  static constexpr std::size_t kBlock = 1024;
  void next_block() {
    next_ += skip_;
    block_end_ = next_ + kBlock;
  }

  std::size_t next_, block_end_, skip_;
};

}  // namespace delaunay
