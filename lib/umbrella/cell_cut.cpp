#include <algorithm>
#include <limits>

#include "umbrella/cell_cut_internal.h"

namespace umbrella {

using delaunay::CellId;
using delaunay::Facet;

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

}  // namespace

CellCut::CellCut(const delaunay::Triangulation3& triangulation,
                 std::span<const CellId> cells)
    : place_(triangulation.cells().size(), kNone),
      nodes_(cells.size()),
      excess_(cells.size()),
      across_(4 * cells.size()),
      residual_(4 * cells.size()) {
  for (Index c = 0; c < cells.size(); ++c) place_[index(cells[c])] = c;
  for (Index c = 0; c < cells.size(); ++c)
    for (unsigned i = 0; i < 4; ++i) {
      const Facet back = triangulation.cell(cells[c]).neighbor[i];
      const Index other = place_[index(back.cell())];
      across_[arc(c, i)] =
          other == kNone ? arc(c, i) : arc(other, back.index());
    }
}

void CellCut::set_cost(Facet facet, Cost cost) {
  const Arc a = arc(place_[index(facet.cell())], facet.index());
  residual_[a] = residual_[across_[a]] = cost;
}

void CellCut::activate(Index c) {
  if (nodes_[c].is_active) return;
  nodes_[c].is_active = true;
  active_.push_back(c);
}

bool CellCut::run(std::uint64_t effort) {
  for (Index c = 0; c < nodes_.size(); ++c) {
    if (excess_[c] == 0) continue;
    nodes_[c].tree = excess_[c] > 0 ? Tree::Source : Tree::Sink;
    nodes_[c].parent = kRoot;
    nodes_[c].depth = 1;
    activate(c);
  }
  while (!active_.empty() && effort_ <= effort) {
    const Index c = active_.front();
    const auto bridge =
        nodes_[c].tree != Tree::None ? grow(c) : std::optional<Arc>();
    if (!bridge) {
      active_.pop_front();
      nodes_[c].is_active = false;
      continue;
    }
    ++time_;
    augment(*bridge);
    while (!orphans_.empty()) {
      const Index orphan = orphans_.front();
      orphans_.pop_front();
      if (!find_parent(orphan)) set_free(orphan);
    }
  }
  return active_.empty();
}

/// Takes free neighbours into the tree of c.
/// @return a facet from the source's tree to the sink's, if one is met
std::optional<CellCut::Arc> CellCut::grow(Index c) {
  const Tree tree = nodes_[c].tree;
  const bool is_source = tree == Tree::Source;
  effort_ += 4;
  for (Arc a = arc(c, 0); a < arc(c, 4); ++a) {
    if (residual(a, is_source) == 0) continue;
    Node& other = nodes_[beyond(a)];
    if (other.tree == Tree::None) {
      other.tree = tree;
      other.parent = static_cast<std::uint8_t>(across_[a] % 4);
      other.time = nodes_[c].time;
      other.depth = nodes_[c].depth + 1;
      activate(beyond(a));
    } else if (other.tree != tree) {
      return is_source ? a : across_[a];
    }
  }
  return std::nullopt;
}

/// Along the tree, from c to its root.
CellCut::Cost CellCut::bottleneck(Index c) {
  const bool from_root = nodes_[c].tree == Tree::Source;
  Cost least = kInfinite;
  while (nodes_[c].parent != kRoot) {
    const Arc a = arc(c, nodes_[c].parent);
    least = std::min(least, residual(a, !from_root));
    c = beyond(a);
  }
  return std::min(least, from_root ? excess_[c] : -excess_[c]);
}

void CellCut::push(Index c, Cost flow) {
  const bool from_root = nodes_[c].tree == Tree::Source;
  const auto orphan = [this](Index at) {
    nodes_[at].parent = kOrphan;
    orphans_.push_front(at);
  };
  while (nodes_[c].parent != kRoot) {
    const Arc a = arc(c, nodes_[c].parent);
    residual(a, from_root) += flow;
    Cost& left = residual(a, !from_root);
    left -= flow;
    if (left == 0) orphan(c);
    c = beyond(a);
  }
  excess_[c] += from_root ? -flow : flow;
  if (excess_[c] == 0) orphan(c);
}

void CellCut::augment(Arc bridge) {
  const Index source = bridge / 4, sink = beyond(bridge);
  const Cost flow =
      std::min({bottleneck(source), bottleneck(sink), residual(bridge, true)});
  residual(bridge, true) -= flow;
  residual(bridge, false) += flow;
  push(source, flow);
  push(sink, flow);
}

/// The neighbour in the same tree that is nearest to its root.
bool CellCut::find_parent(Index c) {
  const bool is_source = nodes_[c].tree == Tree::Source;
  std::optional<std::uint32_t> least;
  std::uint8_t parent = kOrphan;  // stays so: ways up through c do not count
  effort_ += 4;
  for (unsigned i = 0; i < 4; ++i) {
    const Arc a = arc(c, i);
    if (residual(a, !is_source) == 0) continue;
    if (nodes_[beyond(a)].tree != nodes_[c].tree) continue;
    const auto depth = depth_of(beyond(a));
    if (!depth || (least && *least <= *depth)) continue;
    least = depth;
    parent = static_cast<std::uint8_t>(i);
  }
  if (!least) return false;
  nodes_[c].parent = parent;
  nodes_[c].time = time_;
  nodes_[c].depth = *least + 1;
  return true;
}

/// None if the way up ends in an orphan.
std::optional<std::uint32_t> CellCut::depth_of(Index c) {
  std::uint32_t steps = 0;
  Index at = c;
  for (;; ++steps, at = beyond(arc(at, nodes_[at].parent))) {
    ++effort_;
    if (nodes_[at].parent == kOrphan) return std::nullopt;
    if (nodes_[at].parent == kRoot) {
      nodes_[at].depth = 1;
      nodes_[at].time = time_;
    }
    if (nodes_[at].time == time_) break;
  }
  const std::uint32_t depth = nodes_[at].depth + steps;
  for (std::uint32_t d = depth; c != at; --d) {
    nodes_[c].depth = d;
    nodes_[c].time = time_;
    c = beyond(arc(c, nodes_[c].parent));
  }
  return depth;
}

void CellCut::set_free(Index c) {
  const bool is_source = nodes_[c].tree == Tree::Source;
  for (Arc a = arc(c, 0); a < arc(c, 4); ++a) {
    const Index other = beyond(a);
    if (nodes_[other].tree != nodes_[c].tree) continue;
    if (residual(a, !is_source) > 0) activate(other);
    if (nodes_[other].parent == across_[a] % 4) {
      nodes_[other].parent = kOrphan;
      orphans_.push_back(other);
    }
  }
  nodes_[c].tree = Tree::None;
  nodes_[c].parent = kOrphan;
}

}  // namespace umbrella
