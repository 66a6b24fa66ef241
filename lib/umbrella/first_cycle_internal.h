/// @file
/// The first cycle of a link graph with few edges: the usual case of the
/// filter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// As LinkGraph finds it by add() and peel(), but components are known by
/// labels of their vertices, all in one or two vector registers: so no jump
/// depends on what an edge joins, which no processor can guess.
class FirstCycle {
 public:
  static constexpr std::size_t kMostEdges = 32;

  explicit FirstCycle(std::size_t n_vertices) : places_(n_vertices) {}

  /// The edges on the first cycle that closes as they are added one after
  /// another, as bits; 0 if none closes.
  /// @param edges  at most kMostEdges
  std::uint32_t find(std::span<const LinkEdge> edges) {
    place_ends(edges);
    const std::size_t n_added = add_until_closed(edges.size());
    return n_added == 0 ? 0 : peeled(n_added);
  }

 private:
  static constexpr std::size_t kMostNodes = 2 * kMostEdges;
  static constexpr std::size_t kAtOnce = 16;
  /// Labels in one register.
  using Labels [[gnu::vector_size(kAtOnce)]] = std::int8_t;
  using Edge = std::array<std::uint8_t, 2>;

  /// Names the vertices 0, 1, .. by first appearance.
  void place_ends(std::span<const LinkEdge> edges) {
    std::array<VertexId, kMostNodes + 1> nodes;
    std::uint32_t n = 0;
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (unsigned i = 0; i < 2; ++i) {
        std::uint8_t& place = places_[index(edges[e][i])];  // and one
        nodes[n] = edges[e][i];
        const std::uint32_t is_new = place == 0 ? 1 : 0;
        n += is_new;
        place = static_cast<std::uint8_t>(place | (n & (0 - is_new)));
        ends_[e][i] = static_cast<std::uint8_t>(place - 1);
      }
    for (std::uint32_t i = 0; i < n; ++i) places_[index(nodes[i])] = 0;
    n_nodes_ = n;
  }

  /// @return how many edges it takes; 0 if all do not close a cycle
  std::size_t add_until_closed(std::size_t n_edges) const {
    std::array<Labels, kMostNodes / kAtOnce> labels;
    const std::size_t n_registers = (n_nodes_ + kAtOnce - 1) / kAtOnce;
    for (std::size_t r = 0; r < n_registers; ++r)
      labels[r] = kIota + static_cast<std::int8_t>(kAtOnce * r);
    const auto label = [&labels](std::uint8_t p) {
      return labels[p / kAtOnce][p % kAtOnce];
    };
    for (std::size_t e = 0; e < n_edges; ++e) {
      const std::int8_t a = label(ends_[e][0]), b = label(ends_[e][1]);
      if (a == b) return e + 1;
      for (std::size_t r = 0; r < n_registers; ++r)
        labels[r] ^= (labels[r] == b) & static_cast<std::int8_t>(a ^ b);
    }
    return 0;
  }

  /// Takes leaves away until there is none. @return the edges that stay
  std::uint32_t peeled(std::size_t n_edges) const {
    // XOR of the edges at a node: at a leaf, its edge.
    std::array<std::uint8_t, kMostNodes> degree, edges;
    for (std::size_t i = 0; i < n_nodes_; ++i) degree[i] = edges[i] = 0;
    for (std::size_t e = 0; e < n_edges; ++e)
      for (const std::uint8_t p : ends_[e]) {
        ++degree[p];
        edges[p] = static_cast<std::uint8_t>(edges[p] ^ e);
      }
    std::uint32_t stays = 0xffff'ffffU >> (kMostEdges - n_edges);
    for (std::size_t start = 0; start < n_nodes_; ++start)
      for (std::size_t leaf = start; degree[leaf] == 1;) {
        const std::uint8_t e = edges[leaf];
        stays &= ~(1U << e);
        degree[leaf] = 0;
        leaf = static_cast<std::size_t>(ends_[e][0] ^ ends_[e][1]) ^ leaf;
        --degree[leaf];
        edges[leaf] = static_cast<std::uint8_t>(edges[leaf] ^ e);
      }
    return stays;
  }

  static constexpr Labels kIota = {0, 1, 2,  3,  4,  5,  6,  7,
                                   8, 9, 10, 11, 12, 13, 14, 15};

  std::vector<std::uint8_t> places_;  // in the graph at hand; 0 if none
  std::array<Edge, kMostEdges> ends_ = {};
  std::size_t n_nodes_ = 0;
};

}  // namespace umbrella
