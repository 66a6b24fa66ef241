#include <algorithm>
#include <limits>

#include "umbrella/link_graph_internal.h"

namespace umbrella {

const std::vector<std::uint8_t>& LinkGraph::peel() {
  stays_.assign(edges_.size(), 1);
  for (Place start = 0; start < nodes_.size(); ++start) {
    Place leaf = start;
    while (nodes_[leaf].degree == 1) {
      const EdgeIndex edge = nodes_[leaf].edges;
      take_away(edge);
      leaf = other_end(edge, leaf);
    }
  }
  return stays_;
}

const std::vector<std::uint8_t>& LinkGraph::drop_bridges() {
  peel();
  // With one cycle or none there is nothing left but that.
  const bool only_cycles =
      n_closing_ <= 1 ||
      std::none_of(nodes_.begin(), nodes_.end(),
                   [](const Node& n) { return n.degree > 2; });
  if (!only_cycles) {
    find_bridges();
    for (const EdgeIndex e : bridges_) take_away(e);
  }
  return stays_;
}

void LinkGraph::take_away(EdgeIndex e) {
  stays_[e] = 0;
  for (const Place p : edges_[e]) {
    --nodes_[p].degree;
    nodes_[p].edges ^= e;
  }
}

// Depth-first search with low points [Tarjan74], on an explicit stack: an edge
// to a vertex from which no back edge leaves its subtree is a bridge.
void LinkGraph::find_bridges() {
  constexpr EdgeIndex kNone = std::numeric_limits<EdgeIndex>::max();
  sort_half_edges();
  time_.assign(nodes_.size(), 0);  // 0: not yet reached
  low_.assign(nodes_.size(), 0);
  bridges_.clear();
  std::uint32_t clock = 0;
  const auto enter = [&](Place p, EdgeIndex by) {
    time_[p] = low_[p] = ++clock;
    stack_.push_back({p, by, first_half_edge_[p]});
  };
  for (Place start = 0; start < nodes_.size(); ++start) {
    if (time_[start] != 0) continue;
    enter(start, kNone);
    while (!stack_.empty()) {
      Visit& visit = stack_.back();
      std::uint32_t& low = low_[visit.vertex];
      if (visit.next != first_half_edge_[visit.vertex + 1]) {
        const EdgeIndex edge = half_edges_[visit.next++];
        const Place end = other_end(edge, visit.vertex);
        if (edge == visit.entered_by) continue;
        if (time_[end] == 0)
          enter(end, edge);
        else
          low = std::min(low, time_[end]);
        continue;
      }
      const EdgeIndex entered_by = visit.entered_by;
      stack_.pop_back();
      if (stack_.empty()) continue;
      const Place above = stack_.back().vertex;
      low_[above] = std::min(low_[above], low);
      if (low > time_[above]) bridges_.push_back(entered_by);
    }
  }
}

/// Fills half_edges_ with the edges that stay, vertex after vertex.
void LinkGraph::sort_half_edges() {
  first_half_edge_.resize(nodes_.size() + 1);
  std::uint32_t sum = 0;
  for (Place p = 0; p < nodes_.size(); ++p)
    first_half_edge_[p] = sum += nodes_[p].degree;
  first_half_edge_.back() = sum;
  half_edges_.resize(sum);
  for (EdgeIndex e = 0; e < edges_.size(); ++e)
    if (stays_[e] != 0)
      for (const Place p : edges_[e]) half_edges_[--first_half_edge_[p]] = e;
}

}  // namespace umbrella
