#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "umbrella/curve_pieces_internal.h"
#include "umbrella/curve_straightening_internal.h"
#include "umbrella/curve_tour.h"

namespace umbrella {
namespace {

using delaunay::VertexId;

/// Link in[0] in[1] of a piece and out[0] out[1] of another curve become
/// in[0] out[0] and in[1] out[1]. out[1] is kNone at the end of an open curve.
struct Exchange {
  std::array<VertexId, 2> in;
  std::array<VertexId, 2> out;
  double spacings = std::numeric_limits<double>::infinity();  // what it costs
};

class Joiner {
 public:
  Joiner(CurveGraph& graph, CurveLinks& links, const PieceRules& rules)
      : graph_(graph), links_(links), rules_(rules) {}

  bool join(const std::vector<VertexId>& piece,
            std::vector<VertexId>& changed) {
    best_ = {};
    piece_ = piece;
    std::ranges::sort(piece_);
    for (const VertexId v : piece_)
      for (const CurveGraph::Arc& arc : graph_.arcs(v))
        if (!std::ranges::binary_search(piece_, arc.to)) look_at(v, arc);
    const double most =
        piece.size() <= kTinyPiece ? 2 * rules_.most : rules_.most;
    if (!(best_.spacings < most)) return false;
    const auto& [in, out, spacings] = best_;
    links_.drop(in[0], in[1]);
    if (out[1] != CurveLinks::kNone) {
      links_.drop(out[0], out[1]);
      links_.add(in[1], out[1]);
      changed.push_back(out[1]);
    }
    links_.add(in[0], out[0]);
    changed.insert(changed.end(), {in[0], in[1], out[0]});
    return true;
  }

 private:
  void look_at(VertexId v, const CurveGraph::Arc& arc) {
    for (const VertexId v1 : links_[v]) {
      const double dropped = graph_.arc(v, v1)->cost;
      for (const VertexId w1 : links_[arc.to]) {
        double cost = arc.cost - dropped;
        if (w1 == CurveLinks::kNone) {
          cost +=
              rules_.end_price * (rules_.spacing(v1) - rules_.spacing(arc.to));
        } else {
          const CurveGraph::Arc* const second = graph_.arc(v1, w1);
          if (second == nullptr) continue;
          cost += second->cost - graph_.arc(arc.to, w1)->cost;
        }
        const double unit = std::min(rules_.spacing(v), rules_.spacing(arc.to));
        if (cost < best_.spacings * unit)
          best_ = {{v, v1}, {arc.to, w1}, cost / unit};
      }
    }
  }

  CurveGraph& graph_;
  CurveLinks& links_;
  const PieceRules& rules_;
  std::vector<VertexId> piece_;  // ascending
  Exchange best_;
};

/// A closed curve as a problem of tours: vertices far from the seeds are left
/// out, and what links them becomes required edges.
class Shortening {
 public:
  Shortening(CurveGraph& graph, CurveLinks& links)
      : graph_(graph), links_(links), place_(links.n_vertices(), kNowhere) {}

  bool shorten(const std::vector<VertexId>& curve,
               const std::vector<bool>& is_near) {
    collect(curve, is_near);
    const TourResult tour =
        shortest_tour(vertices_.size(), edges_, start_, {.trees = 3000});
    apply(tour);
    for (const VertexId v : vertices_) place_[index(v)] = kNowhere;
    return tour.status == TourStatus::Optimal;
  }

 private:
  static constexpr auto kNowhere = std::numeric_limits<std::uint32_t>::max();

  void collect(const std::vector<VertexId>& curve,
               const std::vector<bool>& is_near) {
    vertices_.clear();
    edges_.clear();
    start_.clear();
    for (const VertexId v : curve) {
      if (!is_near[index(v)]) continue;
      place_[index(v)] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(v);
    }
    add_delaunay_edges();
    add_chains(curve, is_near);
  }

  void add_delaunay_edges() {
    for (const VertexId v : vertices_) {
      for (const CurveGraph::Arc& arc : graph_.arcs(v)) {
        const std::uint32_t to = place_[index(arc.to)];
        if (to == kNowhere || place_[index(v)] > to) continue;
        if (links_.has(v, arc.to)) add_start();
        edges_.push_back({{place_[index(v)], to}, arc.cost});
      }
    }
    n_delaunay_ = edges_.size();
  }

  // Near vertices that follow each other over far ones.
  void add_chains(const std::vector<VertexId>& curve,
                  const std::vector<bool>& is_near) {
    const auto first = std::ranges::find_if(
        curve, [&](VertexId v) { return is_near[index(v)]; });
    VertexId last_near = vertices_.back();
    bool has_gap = curve.front() != *first || !is_near[index(curve.back())];
    for (const VertexId v : curve) {
      if (!is_near[index(v)]) {
        has_gap = true;
        continue;
      }
      if (has_gap) {
        add_start();
        edges_.push_back(
            {{place_[index(last_near)], place_[index(v)]}, 0, true});
      }
      has_gap = false;
      last_near = v;
    }
  }

  void add_start() {
    start_.push_back(static_cast<std::uint32_t>(edges_.size()));
  }

  void apply(const TourResult& tour) {
    for (const bool is_add : {false, true}) {
      for (const std::uint32_t e :
           is_add ? std::span(tour.edges)
                  : std::span<const std::uint32_t>(start_)) {
        const auto& other = is_add ? start_ : tour.edges;
        if (e >= n_delaunay_ || std::ranges::binary_search(other, e)) continue;
        const VertexId v = vertices_[edges_[e].ends[0]];
        const VertexId w = vertices_[edges_[e].ends[1]];
        if (is_add)
          links_.add(v, w);
        else
          links_.drop(v, w);
      }
    }
  }

  CurveGraph& graph_;
  CurveLinks& links_;
  std::vector<std::uint32_t> place_;  // of a vertex in vertices_
  std::vector<VertexId> vertices_;    // near ones, along the curve
  std::vector<TourEdge> edges_;       // Delaunay edges, then chains
  std::size_t n_delaunay_ = 0;
  std::vector<std::uint32_t> start_;  // the curve as it is
};

/// The seeds and what is at most two Delaunay edges from them.
std::vector<bool> near(CurveGraph& graph, std::size_t n_vertices,
                       std::span<const VertexId> seeds) {
  std::vector<bool> is_near(n_vertices);
  std::vector<VertexId> front(seeds.begin(), seeds.end());
  for (const VertexId v : front) is_near[index(v)] = true;
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<VertexId> next;
    for (const VertexId v : front) {
      for (const CurveGraph::Arc& arc : graph.arcs(v)) {
        if (!is_near[index(arc.to)]) next.push_back(arc.to);
        is_near[index(arc.to)] = true;
      }
    }
    front = std::move(next);
  }
  return is_near;
}

}  // namespace

std::size_t join_pieces(CurveGraph& graph, CurveLinks& links,
                        std::span<const VertexId> seeds,
                        const PieceRules& rules,
                        std::vector<VertexId>& changed) {
  Joiner joiner(graph, links, rules);
  std::vector<bool> seen(links.n_vertices());
  std::size_t n_joined = 0;
  for (const VertexId seed : seeds) {
    if (seen[index(seed)]) continue;
    const std::vector<VertexId> piece = links.closed_curve_through(seed);
    for (const VertexId v : piece) seen[index(v)] = true;
    if (!piece.empty() && joiner.join(piece, changed)) ++n_joined;
  }
  return n_joined;
}

PieceChanges shorten_pieces(CurveGraph& graph, CurveLinks& links,
                            std::span<const VertexId> seeds) {
  // Far more is no local doubt but another kind of sample.
  constexpr std::size_t kMost = 3000;
  PieceChanges changes;
  if (seeds.empty()) return changes;
  const std::vector<bool> is_near = near(graph, links.n_vertices(), seeds);
  const auto near_part = [&](std::vector<VertexId> curve) {
    std::erase_if(curve, [&](VertexId v) { return !is_near[index(v)]; });
    return curve;
  };
  Shortening shortening(graph, links);
  CurveStraightening straightening(graph, links);
  std::vector<bool> seen(links.n_vertices());
  for (const VertexId seed : seeds) {
    if (seen[index(seed)]) continue;
    const std::vector<VertexId> curve = links.closed_curve_through(seed);
    for (const VertexId v : curve) seen[index(v)] = true;
    const std::size_t n_near = near_part(curve).size();
    if (n_near < 5 || n_near > kMost) continue;
    if (shortening.shorten(curve, is_near)) ++changes.tours;
    changes.turns +=
        straightening.run(near_part(links.closed_curve_through(seed)));
  }
  return changes;
}

}  // namespace umbrella
