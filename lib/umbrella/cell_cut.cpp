#include <algorithm>

#include "umbrella/cell_cut_internal.h"

namespace umbrella {

using delaunay::CellId;
using delaunay::Facet;

CellCut::CellCut(const delaunay::Triangulation3& triangulation)
    : triangulation_(triangulation),
      nodes_(triangulation.cells().size()),
      excess_(triangulation.cells().size()),
      residual_(4 * triangulation.cells().size()) {
  for (std::size_t c = triangulation.n_finite_cells(); c < nodes_.size(); ++c)
    excess_[c] = -kInfinite;
}

void CellCut::set_cost(Facet facet, Cost cost) {
  const Facet other = triangulation_.cell(facet.cell()).neighbor[facet.index()];
  for (const Facet f : {facet, other})
    residual_[4 * index(f.cell()) + f.index()] = cost;
}

CellCut::Index CellCut::beyond(Index c, unsigned i) const {
  return static_cast<Index>(triangulation_.cell(CellId{c}).neighbor[i].cell());
}

CellCut::Cost& CellCut::residual(Index c, unsigned i, bool outward) {
  if (outward) return residual_[4 * std::size_t{c} + i];
  const Facet f = triangulation_.cell(CellId{c}).neighbor[i];
  return residual_[4 * index(f.cell()) + f.index()];
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
        nodes_[c].tree != Tree::None ? grow(c) : std::optional<Facet>();
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
std::optional<Facet> CellCut::grow(Index c) {
  const Tree tree = nodes_[c].tree;
  const bool is_source = tree == Tree::Source;
  effort_ += 4;
  for (unsigned i = 0; i < 4; ++i) {
    if (residual(c, i, is_source) == 0) continue;
    const Facet back = triangulation_.cell(CellId{c}).neighbor[i];
    Node& other = nodes_[index(back.cell())];
    if (other.tree == Tree::None) {
      other.tree = tree;
      other.parent = static_cast<std::uint8_t>(back.index());
      other.time = nodes_[c].time;
      other.depth = nodes_[c].depth + 1;
      activate(static_cast<Index>(back.cell()));
    } else if (other.tree != tree) {
      return is_source ? Facet(CellId{c}, i) : back;
    }
  }
  return std::nullopt;
}

/// Along the tree, from c to its root.
CellCut::Cost CellCut::bottleneck(Index c) {
  const bool from_root = nodes_[c].tree == Tree::Source;
  Cost least = kInfinite;
  for (; nodes_[c].parent != kRoot; c = beyond(c, nodes_[c].parent))
    least = std::min(least, residual(c, nodes_[c].parent, !from_root));
  return std::min(least, from_root ? excess_[c] : -excess_[c]);
}

void CellCut::push(Index c, Cost flow) {
  const bool from_root = nodes_[c].tree == Tree::Source;
  const auto orphan = [this](Index at) {
    nodes_[at].parent = kOrphan;
    orphans_.push_front(at);
  };
  while (nodes_[c].parent != kRoot) {
    const unsigned i = nodes_[c].parent;
    const Index parent = beyond(c, i);
    residual(c, i, from_root) += flow;
    Cost& left = residual(c, i, !from_root);
    left -= flow;
    if (left == 0) orphan(c);
    c = parent;
  }
  excess_[c] += from_root ? -flow : flow;
  if (excess_[c] == 0) orphan(c);
}

void CellCut::augment(Facet bridge) {
  const auto source = static_cast<Index>(bridge.cell());
  const Index sink = beyond(source, bridge.index());
  const Cost flow = std::min({bottleneck(source), bottleneck(sink),
                              residual(source, bridge.index(), true)});
  residual(source, bridge.index(), true) -= flow;
  residual(source, bridge.index(), false) += flow;
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
    if (residual(c, i, !is_source) == 0) continue;
    const Index other = beyond(c, i);
    if (nodes_[other].tree != nodes_[c].tree) continue;
    const auto depth = depth_of(other);
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
  for (;; ++steps, at = beyond(at, nodes_[at].parent)) {
    ++effort_;
    if (nodes_[at].parent == kOrphan) return std::nullopt;
    if (nodes_[at].parent == kRoot) {
      nodes_[at].depth = 1;
      nodes_[at].time = time_;
    }
    if (nodes_[at].time == time_) break;
  }
  const std::uint32_t depth = nodes_[at].depth + steps;
  for (std::uint32_t d = depth; c != at; c = beyond(c, nodes_[c].parent), --d) {
    nodes_[c].depth = d;
    nodes_[c].time = time_;
  }
  return depth;
}

void CellCut::set_free(Index c) {
  const bool is_source = nodes_[c].tree == Tree::Source;
  for (unsigned i = 0; i < 4; ++i) {
    const Facet back = triangulation_.cell(CellId{c}).neighbor[i];
    const auto other = static_cast<Index>(back.cell());
    if (nodes_[other].tree != nodes_[c].tree) continue;
    if (residual(c, i, !is_source) > 0) activate(other);
    if (nodes_[other].parent == back.index()) {
      nodes_[other].parent = kOrphan;
      orphans_.push_back(other);
    }
  }
  nodes_[c].tree = Tree::None;
  nodes_[c].parent = kOrphan;
}

}  // namespace umbrella
