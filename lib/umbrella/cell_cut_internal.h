/// @file
/// Labels of least cost: a minimum cut of the cells.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Maximum flow by two search trees that are kept from one augmenting path to
/// the next [Boykov04]. Cells are the nodes, facets the arcs, both ways.
/// Costs are whole numbers: so it ends, with the same cut everywhere.
class CellCut {
 public:
  using Cost = std::int64_t;

  /// No facet costs anything, no cell prefers a label, but those beyond the
  /// hull are outside.
  /// @param triangulation  must outlive this object
  explicit CellCut(const delaunay::Triangulation3& triangulation);

  /// Beyond any cost that can be asked for: at most 2^40 by facet and cell.
  static constexpr Cost kInfinite = Cost{1} << 60U;

  /// What it costs if the cells at the facet differ.
  void set_cost(delaunay::Facet facet, Cost cost);
  /// What it costs more if the cell is outside than if it is inside.
  void add_preference(delaunay::CellId c, Cost inside) {
    excess_[index(c)] += inside;
  }

  /// @param effort  arcs that may be looked at
  /// @return whether the minimum was found
  bool run(std::uint64_t effort);

  /// @pre run() returned true
  bool is_inside(delaunay::CellId c) const {
    return nodes_[index(c)].tree == Tree::Source;
  }

 private:
  enum class Tree : std::uint8_t { None, Source, Sink };
  static constexpr std::uint8_t kRoot = 4, kOrphan = 5;

  struct Node {
    Tree tree = Tree::None;
    std::uint8_t parent = kOrphan;  // facet towards it, kRoot or kOrphan
    bool is_active = false;
    std::uint32_t time = 0;   // when depth was last known to be right
    std::uint32_t depth = 0;  // of the node in its tree
  };
  using Index = std::uint32_t;  // of a cell

  Index beyond(Index c, unsigned i) const;
  /// What can still flow from the parent's side to the child's, or back: across
  /// facet i of c, away from the source.
  Cost& residual(Index c, unsigned i, bool outward);

  void activate(Index c);
  std::optional<delaunay::Facet> grow(Index c);
  void augment(delaunay::Facet bridge);
  Cost bottleneck(Index c);
  void push(Index c, Cost flow);
  bool find_parent(Index c);
  std::optional<std::uint32_t> depth_of(Index c);
  void set_free(Index c);

  const delaunay::Triangulation3& triangulation_;
  std::vector<Node> nodes_;
  std::vector<Cost> excess_;    // from the source; to the sink if negative
  std::vector<Cost> residual_;  // by 4 c + i, from c across facet i
  std::deque<Index> active_;
  std::deque<Index> orphans_;
  std::uint32_t time_ = 0;
  std::uint64_t effort_ = 0;
};

}  // namespace umbrella
