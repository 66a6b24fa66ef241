/// @file
/// Labels of least cost: a minimum cut of the cells.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Maximum flow by two search trees that are kept from one augmenting path to
/// the next [Boykov04]. Cells are the nodes, facets the arcs, both ways.
/// Costs are whole numbers: so it ends, with the same cut everywhere. Of the
/// cheapest labels, those with the fewest cells inside.
class CellCut {
 public:
  using Cost = std::int64_t;

  /// No facet costs anything, no cell prefers a label.
  /// @param cells  those to be labelled, distinct; there are no others
  CellCut(const delaunay::Triangulation3& triangulation,
          std::span<const delaunay::CellId> cells);

  /// Beyond any cost that can be asked for: at most 2^40 by facet and cell.
  static constexpr Cost kInfinite = Cost{1} << 60U;

  /// What it costs if the cells at the facet differ; both are to be labelled.
  void set_cost(delaunay::Facet facet, Cost cost);
  /// What it costs more if the cell is outside than if it is inside.
  void add_preference(delaunay::CellId c, Cost inside) {
    excess_[place_[index(c)]] += inside;
  }

  /// @param effort  arcs that may be looked at
  /// @return whether the minimum was found
  bool run(std::uint64_t effort);

  /// @pre run() returned true
  bool is_inside(delaunay::CellId c) const {
    return nodes_[place_[index(c)]].tree == Tree::Source;
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
  using Index = std::uint32_t;  // of a node
  using Arc = std::uint32_t;    // 4 c + i: from node c across its facet i

  Index beyond(Arc a) const { return across_[a] / 4; }
  /// What can still flow along the arc, or back: away from the source.
  Cost& residual(Arc a, bool outward) {
    return residual_[outward ? a : across_[a]];
  }
  static Arc arc(Index c, unsigned i) { return 4 * c + i; }

  void activate(Index c);
  std::optional<Arc> grow(Index c);
  void augment(Arc bridge);
  Cost bottleneck(Index c);
  void push(Index c, Cost flow);
  bool find_parent(Index c);
  std::optional<std::uint32_t> depth_of(Index c);
  void set_free(Index c);

  std::vector<Index> place_;  // of a cell among the nodes
  std::vector<Node> nodes_;
  std::vector<Cost> excess_;    // from the source; to the sink if negative
  std::vector<Arc> across_;     // the same arc backwards; itself if there is no
                                // other node, and then nothing ever flows
  std::vector<Cost> residual_;  // by arc
  std::deque<Index> active_;
  std::deque<Index> orphans_;
  std::uint32_t time_ = 0;
  std::uint64_t effort_ = 0;
};

}  // namespace umbrella
