/// @file
/// The graph G_v of a vertex [Adamy02, Sec. 3.2]: it joins p and q for each
/// triangle v p q. Umbrellas at v are its cycles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// One graph after another in the same memory. Edges are named by their
/// position in the order of add().
class LinkGraph {
 public:
  explicit LinkGraph(std::size_t n_vertices) : node_of_vertex_(n_vertices) {}

  void clear();

  /// Adds an edge, new to the graph. @return whether it closes a cycle
  bool add(const LinkEdge& ends);

  /// Takes away leaves until there is none: what stays of a graph with one
  /// cycle is the cycle. @return for each edge, whether it stays
  const std::vector<bool>& peel();

  /// Takes away all bridges: what stays are the edges on cycles.
  /// @return for each edge, whether it stays
  const std::vector<bool>& drop_bridges();

  /// Whether what peel() or drop_bridges() has left is one simple cycle.
  bool is_one_cycle() const;

 private:
  using NodeIndex = std::uint32_t;
  using EdgeIndex = std::uint32_t;

  struct Node {
    VertexId vertex;
    NodeIndex parent;      // union-find
    std::uint32_t degree;  // edges that stay
    EdgeIndex edges;       // XOR of them: at a leaf, its edge
  };

  NodeIndex node(VertexId v);
  NodeIndex root(NodeIndex n);
  NodeIndex other_end(EdgeIndex e, NodeIndex n) const {
    return n ^ edges_[e][0] ^ edges_[e][1];
  }
  void take_away(EdgeIndex e);
  void find_bridges();
  void sort_half_edges();

  std::vector<std::uint32_t> node_of_vertex_;  // 1 + node; 0 is none
  std::vector<Node> nodes_;
  std::vector<std::array<NodeIndex, 2>> edges_;
  std::vector<bool> stays_;

  // For find_bridges(): edges at each node, and the search.
  struct Visit {
    NodeIndex node;
    EdgeIndex entered_by;
    std::uint32_t next;  // half-edge to follow
  };
  std::vector<std::uint32_t> first_half_edge_;
  std::vector<EdgeIndex> half_edges_;
  std::vector<std::uint32_t> time_, low_;
  std::vector<Visit> stack_;
  std::vector<EdgeIndex> bridges_;
};

}  // namespace umbrella
