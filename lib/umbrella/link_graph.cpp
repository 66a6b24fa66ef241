#include <algorithm>
#include <limits>

#include "umbrella/link_graph_internal.h"

namespace umbrella {

void LinkGraph::clear() {
  for (const Node& node : nodes_) node_of_vertex_[index(node.vertex)] = 0;
  nodes_.clear();
  edges_.clear();
  stays_.clear();
}

bool LinkGraph::add(const LinkEdge& ends) {
  const std::array<NodeIndex, 2> edge = {node(ends[0]), node(ends[1])};
  const auto name = static_cast<EdgeIndex>(edges_.size());
  edges_.push_back(edge);
  stays_.push_back(true);
  for (const NodeIndex n : edge) {
    ++nodes_[n].degree;
    nodes_[n].edges ^= name;
  }
  const NodeIndex a = root(edge[0]), b = root(edge[1]);
  nodes_[a].parent = b;
  return a == b;
}

const std::vector<bool>& LinkGraph::peel() {
  for (NodeIndex start = 0; start < nodes_.size(); ++start) {
    NodeIndex leaf = start;
    while (nodes_[leaf].degree == 1) {
      const EdgeIndex edge = nodes_[leaf].edges;
      take_away(edge);
      leaf = other_end(edge, leaf);
    }
  }
  return stays_;
}

const std::vector<bool>& LinkGraph::drop_bridges() {
  peel();
  const bool only_cycles = std::none_of(
      nodes_.begin(), nodes_.end(), [](const Node& n) { return n.degree > 2; });
  if (!only_cycles) {
    find_bridges();
    for (const EdgeIndex e : bridges_) take_away(e);
  }
  return stays_;
}

bool LinkGraph::is_one_cycle() const {
  std::size_t n_edges = 0, n_nodes = 0;
  NodeIndex start = 0;
  for (NodeIndex n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].degree == 0) continue;
    if (nodes_[n].degree != 2) return false;
    start = n;
    ++n_nodes;
  }
  if (n_nodes == 0) return false;

  EdgeIndex edge = 0;
  while (!stays_[edge] ||
         (edges_[edge][0] != start && edges_[edge][1] != start))
    ++edge;
  NodeIndex n = start;
  do {
    n = other_end(edge, n);
    edge ^= nodes_[n].edges;  // the other one of its two
    ++n_edges;
  } while (n != start);
  return n_edges == n_nodes;
}

LinkGraph::NodeIndex LinkGraph::node(VertexId v) {
  std::uint32_t& known = node_of_vertex_[index(v)];
  if (known == 0) {
    const auto fresh = static_cast<NodeIndex>(nodes_.size());
    nodes_.push_back({v, fresh, 0, 0});
    known = fresh + 1;
  }
  return known - 1;
}

LinkGraph::NodeIndex LinkGraph::root(NodeIndex n) {
  while (nodes_[n].parent != n)
    n = nodes_[n].parent = nodes_[nodes_[n].parent].parent;
  return n;
}

void LinkGraph::take_away(EdgeIndex e) {
  stays_[e] = false;
  for (const NodeIndex n : edges_[e]) {
    --nodes_[n].degree;
    nodes_[n].edges ^= e;
  }
}

// Depth-first search with low points [Tarjan74], on an explicit stack: an edge
// to a node from which no back edge leaves its subtree is a bridge.
void LinkGraph::find_bridges() {
  constexpr EdgeIndex kNone = std::numeric_limits<EdgeIndex>::max();
  sort_half_edges();
  time_.assign(nodes_.size(), 0);  // 0: not yet reached
  low_.assign(nodes_.size(), 0);
  bridges_.clear();
  std::uint32_t clock = 0;
  const auto enter = [&](NodeIndex n, EdgeIndex by) {
    time_[n] = low_[n] = ++clock;
    stack_.push_back({n, by, first_half_edge_[n]});
  };
  for (NodeIndex start = 0; start < nodes_.size(); ++start) {
    if (time_[start] != 0) continue;
    enter(start, kNone);
    while (!stack_.empty()) {
      Visit& visit = stack_.back();
      if (visit.next != first_half_edge_[visit.node + 1]) {
        const EdgeIndex edge = half_edges_[visit.next++];
        const NodeIndex end = other_end(edge, visit.node);
        if (edge == visit.entered_by) continue;
        if (time_[end] == 0)
          enter(end, edge);
        else
          low_[visit.node] = std::min(low_[visit.node], time_[end]);
        continue;
      }
      const auto [n, entered_by, next] = visit;
      stack_.pop_back();
      if (stack_.empty()) continue;
      const NodeIndex above = stack_.back().node;
      low_[above] = std::min(low_[above], low_[n]);
      if (low_[n] > time_[above]) bridges_.push_back(entered_by);
    }
  }
}

/// Fills half_edges_ with the edges that stay, node after node.
void LinkGraph::sort_half_edges() {
  first_half_edge_.assign(nodes_.size() + 1, 0);
  std::uint32_t sum = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    first_half_edge_[n] = sum += nodes_[n].degree;
  first_half_edge_.back() = sum;
  half_edges_.resize(sum);
  for (EdgeIndex e = 0; e < edges_.size(); ++e)
    if (stays_[e])
      for (const NodeIndex n : edges_[e])
        half_edges_[--first_half_edge_[n]] = e;
}

}  // namespace umbrella
