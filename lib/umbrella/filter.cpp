// Kruskal at every vertex: union-find over the link graph tells the first edge
// that closes a cycle, and peeling leaves off what was taken so far leaves the
// cycle alone. The paper searches the graph anew after each triangle; this is
// near linear in all.
#include "umbrella/filter.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "umbrella/incidence_internal.h"

namespace umbrella {
namespace {

using NodeIndex = std::uint32_t;

/// The graph G_v of one vertex after another, built edge by edge.
class LinkGraph {
 public:
  explicit LinkGraph(std::size_t n_vertices) : node_of_vertex_(n_vertices) {}

  void clear() {
    for (const Node& node : nodes_) node_of_vertex_[index(node.vertex)] = 0;
    nodes_.clear();
    edges_.clear();
  }

  /// Adds an edge. @return whether it closes a cycle
  bool add(const LinkEdge& ends) {
    const std::pair edge(node(ends[0]), node(ends[1]));
    const auto name = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back(edge);
    for (const NodeIndex n : {edge.first, edge.second}) {
      ++nodes_[n].degree;
      nodes_[n].edges ^= name;
    }
    const NodeIndex a = root(edge.first), b = root(edge.second);
    nodes_[a].parent = b;
    return a == b;
  }

  /// Peels leaves until none is left. @return for each edge, in the order of
  ///   add(), whether it stays
  const std::vector<bool>& peel() {
    stays_.assign(edges_.size(), true);
    for (NodeIndex leaf = 0; leaf < nodes_.size(); ++leaf) {
      NodeIndex n = leaf;
      while (nodes_[n].degree == 1) {
        const std::uint32_t edge = nodes_[n].edges;
        stays_[edge] = false;
        nodes_[n].degree = 0;
        n ^= edges_[edge].first ^ edges_[edge].second;
        --nodes_[n].degree;
        nodes_[n].edges ^= edge;
      }
    }
    return stays_;
  }

 private:
  struct Node {
    VertexId vertex;
    NodeIndex parent;      // union-find
    std::uint32_t degree;  // edges at it, less the peeled ones
    std::uint32_t edges;   // XOR of their positions: at a leaf, its edge
  };

  NodeIndex node(VertexId v) {
    NodeIndex& known = node_of_vertex_[index(v)];
    if (known == 0) {
      const auto fresh = static_cast<NodeIndex>(nodes_.size());
      nodes_.push_back({v, fresh, 0, 0});
      known = fresh + 1;
    }
    return known - 1;
  }

  NodeIndex root(NodeIndex n) {
    while (nodes_[n].parent != n)
      n = nodes_[n].parent = nodes_[nodes_[n].parent].parent;
    return n;
  }

  std::vector<NodeIndex> node_of_vertex_;  // 1 + node; 0 is none
  std::vector<Node> nodes_;
  std::vector<std::pair<NodeIndex, NodeIndex>> edges_;
  std::vector<bool> stays_;
};

/// The umbrella of one vertex after another.
class UmbrellaPicker {
 public:
  UmbrellaPicker(std::size_t n_vertices,
                 std::span<const RankedTriangle> triangles)
      : triangles_(triangles), graph_(n_vertices) {}

  /// @param at_v  the triangles at v
  /// @return the umbrella at v, empty if there is none; valid until the next
  ///   call
  std::span<const TriangleIndex> pick(VertexId v,
                                      std::span<const TriangleIndex> at_v) {
    order_.assign(at_v.begin(), at_v.end());
    std::sort(order_.begin(), order_.end(),
              [this](TriangleIndex a, TriangleIndex b) {
                return ranks_before(triangles_[a], triangles_[b]);
              });
    graph_.clear();
    const auto closing =
        std::find_if(order_.begin(), order_.end(), [&](TriangleIndex t) {
          return graph_.add(opposite_edge(triangles_[t].corners, v));
        });
    if (closing == order_.end()) return {};

    const std::vector<bool>& stays = graph_.peel();
    std::size_t n = 0;
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k]) order_[n++] = order_[k];
    return std::span(order_).first(n);
  }

 private:
  std::span<const RankedTriangle> triangles_;
  LinkGraph graph_;
  std::vector<TriangleIndex> order_;
};

}  // namespace

FilterResult umbrella_filter(std::size_t n_vertices,
                             std::span<const RankedTriangle> triangles) {
  const Incidence incidence(
      n_vertices, triangles.size(),
      [&](TriangleIndex t) -> const Triangle& { return triangles[t].corners; });

  FilterResult result;
  UmbrellaPicker picker(n_vertices, triangles);
  std::vector<bool> chosen(triangles.size());
  for (std::size_t i = 0; i < n_vertices; ++i) {
    const VertexId v{static_cast<std::uint32_t>(i)};
    const auto umbrella = picker.pick(v, incidence.at(v));
    if (umbrella.empty()) result.without_umbrella.push_back(v);
    for (const TriangleIndex t : umbrella) chosen[t] = true;
  }

  for (TriangleIndex t = 0; t < triangles.size(); ++t)
    if (chosen[t]) result.triangles.push_back(triangles[t]);
  return result;
}

}  // namespace umbrella
