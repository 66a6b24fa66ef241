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
  explicit LinkGraph(std::size_t n_vertices) : nodes_(n_vertices) {}

  /// In the time that the last graph took.
  void clear() {
    for (const VertexId v : vertices_) node(v) = {};
    vertices_.clear();
    edges_.clear();
    n_closing_ = 0;
  }

  /// Adds an edge, new to the graph. @return whether it closes a cycle
  bool add(const LinkEdge& ends) {
    const auto name = static_cast<EdgeIndex>(edges_.size());
    edges_.push_back(ends);
    for (const VertexId v : ends) attach(v, name);
    const VertexId a = root(ends[0]), b = root(ends[1]);
    node(a).parent = b;
    n_closing_ += a == b ? 1 : 0;
    return a == b;
  }

  bool has_cycle() const { return n_closing_ > 0; }

  /// Whether the edges that are no bridges are one simple cycle: the edges that
  /// closed a cycle are as many as there are independent cycles.
  bool has_one_cycle() const { return n_closing_ == 1; }

  /// Takes away leaves until there is none: what stays of a graph with one
  /// cycle is the cycle. To be called once. @return for each edge, whether it
  /// stays
  const std::vector<bool>& peel();

  /// Takes away all bridges: what stays are the edges on cycles. Likewise.
  const std::vector<bool>& drop_bridges();

 private:
  using EdgeIndex = std::uint32_t;

  /// A vertex of the graph; all zero if it has no edge.
  struct Node {
    VertexId parent;       // union-find
    std::uint32_t degree;  // edges that stay
    EdgeIndex edges;       // XOR of them: at a leaf, its edge
    std::uint32_t place;   // in vertices_
  };

  Node& node(VertexId v) { return nodes_[index(v)]; }
  void attach(VertexId v, EdgeIndex e) {
    Node& n = node(v);
    if (n.degree == 0) {
      n.parent = v;
      n.place = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(v);
    }
    ++n.degree;
    n.edges ^= e;
  }
  VertexId root(VertexId v) {
    while (node(v).parent != v)
      v = node(v).parent = node(node(v).parent).parent;
    return v;
  }
  VertexId other_end(EdgeIndex e, VertexId v) const {
    return edges_[e][0] == v ? edges_[e][1] : edges_[e][0];
  }
  void take_away(EdgeIndex e);
  void find_bridges();
  void sort_half_edges();

  std::vector<Node> nodes_;
  std::vector<VertexId> vertices_;  // of the graph, by first appearance
  std::vector<LinkEdge> edges_;
  std::size_t n_closing_ = 0;
  std::vector<bool> stays_;

  // For find_bridges(), by the places of vertices: their edges, and the search.
  struct Visit {
    VertexId vertex;
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
