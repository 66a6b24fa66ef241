/// @file
/// A 3D triangulation under construction: what its inserters share.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/cell_vector.h"
#include "delaunay/triangulation3.h"

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
  /// @param n_inserters  how many will work on it
  explicit Mesh3(std::span<const Point3> points, unsigned n_inserters = 1);

  /// Makes room for n cells at least.
  /// @throws std::length_error  their numbers would not fit 30 bits
  void make_room(std::size_t n);

  /// Removes the places in front of `end` that hold no cell, and all behind;
  /// moves the cells inside the hull to the front.
  /// @return how many lie inside the hull
  std::size_t compact(std::size_t end);

  static bool is_cell(const Cell& c) { return c.vertex[0] != kInfinite; }
  static void remove(Cell& c) { c.vertex[0] = kInfinite; }

  std::vector<Site> sites;  // by vertex
  LazyVector<Cell> cells;   // used and unused ones

 private:
  void link(Facet a, Facet b);
  void relocate(CellId from, CellId to);
  template <class Keep>
  std::size_t gather(std::size_t first, Keep keep);
};

/// Vertices whose cells one inserter may change: an interval of the ids, which
/// follow a Hilbert curve, or all but an interval, joined over the curve's
/// ends.
class Part {
 public:
  /// From `begin` up to `end`, over the last and the first id if it is not
  /// above `begin`.
  Part(std::uint32_t begin, std::uint32_t end)
      : low_(std::min(begin, end)),
        size_(std::max(begin, end) - low_),
        is_outside_(end <= begin) {}

  bool holds(VertexId v) const {
    return (static_cast<std::uint32_t>(v) - low_ < size_) != is_outside_;
  }
  /// Whether all finite corners are in the part.
  bool holds(const Cell& c) const {
    return holds(c.vertex[0]) && holds(c.vertex[1]) && holds(c.vertex[2]) &&
           (c.is_infinite() || holds(c.vertex[3]));
  }
  /// Those it holds of some in ascending order; in the order of the part.
  std::vector<VertexId> select(std::span<const VertexId> vertices) const;

 private:
  std::uint32_t low_, size_;
  bool is_outside_;
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
