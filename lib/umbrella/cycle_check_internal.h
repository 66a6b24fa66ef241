/// @file
/// The usual case of a link graph, told without building it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// Whether the edges of one graph after another are a simple cycle: each node
/// has two edges, and a walk from any of them meets all.
class CycleCheck {
 public:
  explicit CycleCheck(std::size_t n_vertices) : nodes_(n_vertices) {}

  void clear() {
    ++n_graphs_;
    n_nodes_ = n_edges_ = largest_degree_ = 0;
  }
  /// Adds an edge, new to the graph.
  void add(const LinkEdge& ends) {
    ++n_edges_;
    enter(ends[0], ends[1]);
    enter(ends[1], ends[0]);
    last_ = ends;
  }

  bool is_cycle() const {
    // As many nodes as edges, and no degree above two: so each is two.
    if (n_edges_ == 0 || n_nodes_ != n_edges_ || largest_degree_ > 2)
      return false;
    std::uint32_t from = number(last_[0]), at = number(last_[1]);
    std::uint32_t n = 1;
    for (const std::uint32_t start = from; at != start; ++n) {
      const std::uint32_t next = nodes_[at].others ^ from;
      from = at;
      at = next;
    }
    return n == n_edges_;
  }

 private:
  struct Node {
    std::uint32_t graph = 0;   // the last it was in
    std::uint32_t degree = 0;  // there
    std::uint32_t others = 0;  // XOR of the other ends of its edges there
  };

  static std::uint32_t number(VertexId v) {
    return static_cast<std::uint32_t>(v);
  }
  void enter(VertexId v, VertexId other) {
    Node& node = nodes_[index(v)];
    // Selected, not jumped over: whether it is new, no processor can guess.
    const bool is_new = node.graph != n_graphs_;
    node.graph = n_graphs_;
    node.degree = (is_new ? 0 : node.degree) + 1;
    node.others = (is_new ? 0 : node.others) ^ number(other);
    n_nodes_ += is_new ? 1 : 0;
    largest_degree_ =
        node.degree > largest_degree_ ? node.degree : largest_degree_;
  }

  std::vector<Node> nodes_;
  std::uint32_t n_graphs_ = 0;
  std::uint32_t n_nodes_ = 0, n_edges_ = 0, largest_degree_ = 0;
  LinkEdge last_ = {};
};

}  // namespace umbrella
