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
  explicit LinkGraph(std::size_t n_vertices) : places_(n_vertices) {}

  void clear() {
    ++n_graphs_;
    nodes_.clear();
    edges_.clear();
    n_closing_ = 0;
  }

  /// Adds an edge, new to the graph. @return whether it closes a cycle
  bool add(const LinkEdge& ends) {
    const auto name = static_cast<EdgeIndex>(edges_.size());
    const Edge edge = {place(ends[0]), place(ends[1])};
    edges_.push_back(edge);
    for (const Place p : edge) {
      ++nodes_[p].degree;
      nodes_[p].edges ^= name;
    }
    const Place a = root(edge[0]), b = root(edge[1]);
    nodes_[a].parent = b;
    n_closing_ += a == b ? 1 : 0;
    return a == b;
  }

  bool has_cycle() const { return n_closing_ > 0; }

  /// Whether the edges that are no bridges are one simple cycle: the edges that
  /// closed a cycle are as many as there are independent cycles.
  bool has_one_cycle() const { return n_closing_ == 1; }

  /// Takes away leaves until there is none: what stays of a graph with one
  /// cycle is the cycle. To be called once. @return for each edge, 1 if it
  /// stays
  const std::vector<std::uint8_t>& peel();

  /// Takes away all bridges: what stays are the edges on cycles. Likewise.
  const std::vector<std::uint8_t>& drop_bridges();

 private:
  using EdgeIndex = std::uint32_t;
  /// Of a vertex in the graph, by first appearance.
  using Place = std::uint32_t;
  using Edge = std::array<Place, 2>;

  /// A vertex of the graph.
  struct Node {
    Place parent;              // union-find
    std::uint32_t degree = 0;  // edges that stay
    EdgeIndex edges = 0;       // XOR of them: at a leaf, its edge
  };

  Place place(VertexId v) {
    Known& known = places_[index(v)];
    if (known.graph != n_graphs_) {
      known = {n_graphs_, static_cast<Place>(nodes_.size())};
      nodes_.push_back({known.place});
    }
    return known.place;
  }
  Place root(Place p) {
    while (nodes_[p].parent != p)
      p = nodes_[p].parent = nodes_[nodes_[p].parent].parent;
    return p;
  }
  Place other_end(EdgeIndex e, Place p) const {
    return edges_[e][0] == p ? edges_[e][1] : edges_[e][0];
  }
  void take_away(EdgeIndex e);
  void find_bridges();
  void sort_half_edges();

  /// Where a vertex was put, in the last graph it was in.
  struct Known {
    std::uint32_t graph = 0;
    Place place = 0;
  };
  std::vector<Known> places_;
  std::uint32_t n_graphs_ = 1;
  std::vector<Node> nodes_;  // by place
  std::vector<Edge> edges_;
  std::size_t n_closing_ = 0;
  std::vector<std::uint8_t> stays_;

  // For find_bridges(): edges by places of vertices, and the search.
  struct Visit {
    Place vertex;
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
