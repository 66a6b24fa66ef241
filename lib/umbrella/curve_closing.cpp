#include "umbrella/curve_closing.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ilp/improve.h"
#include "ilp/problem.h"
#include "ilp/solver.h"

namespace umbrella {
namespace {

using delaunay::VertexId;
using EdgeIndex = std::uint32_t;

/// Vertices that lack edges, and the edges that could be added.
struct Region {
  std::vector<VertexId> vertices;
  std::vector<EdgeIndex> edges;
};

class Closer {
 public:
  Closer(std::size_t n_vertices, std::span<const DelaunayEdge> edges,
         const CurveClosingOptions& options);
  CurveClosingResult run(std::span<const Edge> agreed);

 private:
  std::span<const EdgeIndex> edges_at(VertexId v) const {
    const std::size_t first = first_[index(v)];
    return std::span(incident_).subspan(first, first_[index(v) + 1] - first);
  }
  VertexId other_end(EdgeIndex e, VertexId v) const {
    const Edge& ends = edges_[e].ends;
    return ends[0] == v ? ends[1] : ends[0];
  }
  bool lacks_edges(VertexId v) const { return degree_[index(v)] < 2; }
  void set(EdgeIndex e, bool on);

  std::vector<Region> regions() const;
  bool close(const Region& region);
  bool is_odd(const Region& region) const;
  ilp::Problem program(const Region& region) const;
  std::vector<ilp::VarId> worst_first(const Region& region) const;
  bool cut_pieces(const Region& region, ilp::Solver& solver);
  std::vector<VertexId> piece_through(EdgeIndex e) const;
  bool grow(const Region& region);
  CurveClosingResult result() const;

  std::span<const DelaunayEdge> edges_;
  CurveClosingOptions options_;
  std::vector<std::size_t> first_;   // of a vertex in incident_
  std::vector<EdgeIndex> incident_;  // edges at each vertex, ascending
  std::vector<bool> on_;             // edges of the curve
  std::vector<unsigned> degree_;     // of each vertex in it
  CurveClosingReport report_;
};

Closer::Closer(std::size_t n_vertices, std::span<const DelaunayEdge> edges,
               const CurveClosingOptions& options)
    : edges_(edges),
      options_(options),
      first_(n_vertices + 1),
      incident_(2 * edges.size()),
      on_(edges.size()),
      degree_(n_vertices) {
  for (const DelaunayEdge& edge : edges)
    for (const VertexId v : edge.ends) ++first_[index(v)];
  std::size_t sum = 0;
  for (std::size_t& first : first_) first = sum += first;
  for (auto e = static_cast<EdgeIndex>(edges.size()); e-- > 0;)
    for (const VertexId v : edges[e].ends) incident_[--first_[index(v)]] = e;
}

void Closer::set(EdgeIndex e, bool on) {
  assert(on_[e] != on);
  on_[e] = on;
  for (const VertexId v : edges_[e].ends) degree_[index(v)] += on ? 1U : -1U;
}

std::vector<Region> Closer::regions() const {
  std::vector<Region> regions;
  std::vector<bool> seen(degree_.size());
  for (std::uint32_t seed = 0; seed < degree_.size(); ++seed) {
    if (seen[seed] || !lacks_edges(VertexId{seed})) continue;
    Region& region = regions.emplace_back();
    region.vertices = {VertexId{seed}};
    seen[seed] = true;
    for (std::size_t i = 0; i < region.vertices.size(); ++i) {
      const VertexId v = region.vertices[i];
      for (const EdgeIndex e : edges_at(v)) {
        const VertexId w = other_end(e, v);
        if (on_[e] || !lacks_edges(w)) continue;
        if (v < w) region.edges.push_back(e);
        if (!seen[index(w)]) region.vertices.push_back(w);
        seen[index(w)] = true;
      }
    }
    std::ranges::sort(region.vertices);
    std::ranges::sort(region.edges);
  }
  return regions;
}

/// Variable i is region.edges[i]; a last one is true, to stand for the edge
/// that a vertex has already.
ilp::Problem Closer::program(const Region& region) const {
  ilp::Problem problem;
  problem.add_variables(region.edges.size());
  const ilp::VarId there = problem.add_variable();
  problem.fix(there, true);
  for (const VertexId v : region.vertices) {
    std::vector<ilp::VarId> at;
    std::vector<ilp::Literal> any;
    for (const EdgeIndex e : edges_at(v)) {
      const auto found = std::ranges::lower_bound(region.edges, e);
      if (found == region.edges.end() || *found != e) continue;
      at.push_back(
          ilp::VarId{static_cast<std::uint32_t>(found - region.edges.begin())});
      any.emplace_back(at.back(), true);
    }
    if (degree_[index(v)] == 1) at.push_back(there);
    problem.add_pair(at);
    problem.add_clause(any);
  }
  return problem;
}

std::vector<ilp::VarId> Closer::worst_first(const Region& region) const {
  std::vector<ilp::VarId> order(region.edges.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = ilp::VarId{i};
  const auto weight = [&](ilp::VarId var) {
    const DelaunayEdge& edge = edges_[region.edges[index(var)]];
    return options_.weight == CurveWeight::Length
               ? std::pair(edge.length, edge.lambda_lower)
               : std::pair(edge.lambda_lower, edge.length);
  };
  std::ranges::stable_sort(order, std::ranges::greater{}, weight);
  return order;
}

/// The vertices of the closed curve through e; empty if it is open or too
/// long to be cut.
std::vector<VertexId> Closer::piece_through(EdgeIndex e) const {
  const double part = options_.piece_part * static_cast<double>(degree_.size());
  const auto limit =
      std::max(options_.piece_edges, static_cast<std::size_t>(part));
  const VertexId start = edges_[e].ends[0];
  std::vector<VertexId> piece;
  VertexId v = start;
  do {
    v = other_end(e, v);
    piece.push_back(v);
    if (lacks_edges(v) || piece.size() > limit) return {};
    for (const EdgeIndex next : edges_at(v)) {
      if (!on_[next] || next == e) continue;
      e = next;
      break;
    }
  } while (v != start);
  std::ranges::sort(piece);
  return piece;
}

/// Forbids the small closed pieces that the present solution makes: one of the
/// region's edges must leave each. False if there is none to forbid.
bool Closer::cut_pieces(const Region& region, ilp::Solver& solver) {
  bool found = false;
  for (const EdgeIndex e : region.edges) {
    if (!on_[e]) continue;
    const std::vector<VertexId> piece = piece_through(e);
    if (piece.empty()) continue;
    std::vector<ilp::Literal> leaving;
    for (std::uint32_t i = 0; i < region.edges.size(); ++i) {
      const Edge& ends = edges_[region.edges[i]].ends;
      if (std::ranges::binary_search(piece, ends[0]) !=
          std::ranges::binary_search(piece, ends[1]))
        leaving.emplace_back(ilp::VarId{i}, true);
    }
    solver.add_clause(leaving);
    found = true;
  }
  return found;
}

/// Every edge ends twice: an odd number of ends cannot be made up.
bool Closer::is_odd(const Region& region) const {
  unsigned n_ends = 0;
  for (const VertexId v : region.vertices) n_ends += degree_[index(v)];
  return n_ends % 2 != 0;
}

bool Closer::close(const Region& region) {
  if (is_odd(region)) {
    ++report_.infeasible;
    return false;
  }
  const ilp::Problem problem = program(region);
  const std::vector<ilp::VarId> order = worst_first(region);
  ilp::Solver solver(problem);
  const ilp::Limits limits = {.conflicts = options_.conflicts};
  std::vector<EdgeIndex> chosen;
  bool again = true;
  while (again) {
    const auto found = ilp::minimize_worst_first(solver, order, limits);
    if (found.model.empty()) {
      if (!chosen.empty()) break;  // only with small pieces
      ++(found.status == ilp::Status::Infeasible ? report_.infeasible
                                                 : report_.undecided);
      break;
    }
    for (const EdgeIndex e : chosen) set(e, false);
    chosen.clear();
    for (std::size_t i = 0; i < region.edges.size(); ++i)
      if (found.model[i]) chosen.push_back(region.edges[i]);
    for (const EdgeIndex e : chosen) set(e, true);
    again = cut_pieces(region, solver);
  }
  report_.variables += region.edges.size();
  report_.conflicts += solver.statistics().conflicts;
  return !chosen.empty();
}

/// Gives up the edges among the region and its neighbours. False if there are
/// none.
bool Closer::grow(const Region& region) {
  std::vector<VertexId> grown = region.vertices;
  for (const VertexId v : region.vertices)
    for (const EdgeIndex e : edges_at(v)) grown.push_back(other_end(e, v));
  std::ranges::sort(grown);
  bool has_grown = false;
  for (const VertexId v : region.vertices) {
    for (const EdgeIndex e : edges_at(v)) {
      const VertexId w = other_end(e, v);
      for (const EdgeIndex f : edges_at(w)) {
        if (!on_[f] || !std::ranges::binary_search(grown, other_end(f, w)))
          continue;
        set(f, false);
        has_grown = true;
      }
    }
  }
  return has_grown;
}

CurveClosingResult Closer::run(std::span<const Edge> agreed) {
  std::vector<EdgeIndex> agreed_edges;
  for (const Edge& ends : agreed) {
    const auto e =
        std::ranges::lower_bound(edges_, ends, {}, &DelaunayEdge::ends);
    assert(e != edges_.end() && e->ends == ends);
    agreed_edges.push_back(static_cast<EdgeIndex>(e - edges_.begin()));
    set(agreed_edges.back(), true);
  }
  for (unsigned round = 0; round <= options_.max_growth; ++round) {
    const std::vector<Region> open = regions();
    if (round == 0) report_.regions = open.size();
    bool has_grown = false;
    for (const Region& region : open) {
      if (close(region)) {
        ++report_.feasible;
        report_.grown += round > 0 ? 1 : 0;
      } else if (round < options_.max_growth) {
        has_grown = grow(region) || has_grown;
      }
    }
    if (!has_grown) break;
  }
  // What growing gave up in vain.
  for (const EdgeIndex e : agreed_edges) {
    if (!on_[e] && std::ranges::all_of(edges_[e].ends, [&](VertexId v) {
          return lacks_edges(v);
        }))
      set(e, true);
  }
  return result();
}

CurveClosingResult Closer::result() const {
  CurveClosingResult result;
  result.report = report_;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (on_[e]) result.edges.push_back(edges_[e].ends);
  for (std::uint32_t v = 0; v < degree_.size(); ++v)
    if (lacks_edges(VertexId{v})) result.open.push_back(VertexId{v});
  return result;
}

}  // namespace

CurveClosingResult close_curve(std::size_t n_vertices,
                               std::span<const DelaunayEdge> edges,
                               std::span<const Edge> agreed,
                               const CurveClosingOptions& options) {
  return Closer(n_vertices, edges, options).run(agreed);
}

}  // namespace umbrella
