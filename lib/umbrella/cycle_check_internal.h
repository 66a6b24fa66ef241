/// @file
/// The usual case of a link graph, told without building it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// Whether the edges of one graph after another are a simple cycle: each node
/// has two edges, and a walk from any of them meets all.
class CycleCheck {
 public:
  explicit CycleCheck(std::size_t n_vertices) : nodes_(n_vertices) {}

  /// Adds one edge after another until there are as many nodes as edges, as
  /// there are in a cycle, and not before it closes. At most 2^30 times.
  ///
  /// @param edge  callable: the i-th of n distinct edges
  /// @return the number of edges, if they are a simple cycle; 0 otherwise. So n
  ///   says that all are one
  template <class EdgeAt>
  std::size_t find(std::size_t n, EdgeAt edge) {
    assert(graph_ < std::numeric_limits<std::uint32_t>::max() - kDegrees);
    const std::uint32_t graph = graph_ += kDegrees;
    std::size_t n_nodes = 0, n_edges = 0;
    LinkEdge last = {};
    do {
      if (n_edges == n) return 0;
      last = edge(n_edges++);
      for (const unsigned i : {0, 1}) {
        Node& node = nodes_[index(last[i])];
        // Masked, not jumped over: whether it is new, no processor can guess.
        const std::uint32_t if_known =
            0U - static_cast<std::uint32_t>(node.state > graph);
        if (node.state == graph + 2) return 0;
        node = {std::max(node.state, graph) + 1,
                (node.others & if_known) ^ number(last[1 - i])};
        n_nodes += if_known + 1;
      }
    } while (n_nodes != n_edges);
    return is_one(n_edges, last) ? n_edges : 0;
  }

 private:
  static constexpr std::uint32_t kDegrees = 4;

  struct Node {
    std::uint32_t state = 0;   // the last graph it was in, and its degree there
    std::uint32_t others = 0;  // XOR of the other ends of its edges there
  };

  static std::uint32_t number(VertexId v) {
    return static_cast<std::uint32_t>(v);
  }

  /// Whether that many edges, which are cycles, are a single one.
  bool is_one(std::size_t n_edges, const LinkEdge& edge) const {
    const std::uint32_t start = number(edge[0]);
    std::uint32_t from = start, at = number(edge[1]);
    std::uint32_t n_at_start = 0;
    // As many steps as edges, however soon it is back: so the next graph need
    // not wait for it.
    for (std::size_t n = 1; n < n_edges; ++n) {
      n_at_start += at == start ? 1 : 0;
      const std::uint32_t next = nodes_[at].others ^ from;
      from = at;
      at = next;
    }
    return n_at_start == 0 && at == start;
  }

  std::vector<Node> nodes_;
  std::uint32_t graph_ = 0;  // a multiple of kDegrees
};

}  // namespace umbrella
