#include <algorithm>
#include <utility>

#include "umbrella/closing_program_internal.h"

namespace umbrella {
namespace {

void sort_unique(std::vector<VertexId>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

bool contains(std::span<const VertexId> ascending, VertexId v) {
  return std::binary_search(ascending.begin(), ascending.end(), v);
}

}  // namespace

ClosingProgram::ClosingProgram(const WorkingSurface& surface,
                               std::span<const LocatedTriangle> candidates,
                               std::vector<VertexId> vertices,
                               std::span<const VertexId> may_drop)
    : n_candidates_(candidates.size()), vertices_(std::move(vertices)) {
  add_members(surface, candidates);
  add_pairs();
  add_rings(may_drop);
}

void ClosingProgram::add_members(const WorkingSurface& surface,
                                 std::span<const LocatedTriangle> candidates) {
  problem_.add_variables(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    members_.push_back(
        {candidates[i].corners, ilp::VarId{static_cast<std::uint32_t>(i)}});

  std::vector<TriangleIndex> at_vertices;
  for (const VertexId v : vertices_)
    surface.for_each_at(v, [&](TriangleIndex t) { at_vertices.push_back(t); });
  std::sort(at_vertices.begin(), at_vertices.end());
  at_vertices.erase(std::unique(at_vertices.begin(), at_vertices.end()),
                    at_vertices.end());
  for (const TriangleIndex t : at_vertices) {
    const Triangle& corners = surface.corners(t);
    const auto found =
        std::lower_bound(candidates.begin(), candidates.end(), corners,
                         [](const LocatedTriangle& c, const Triangle& wanted) {
                           return c.corners < wanted;
                         });
    if (found != candidates.end() && found->corners == corners) {
      freed_.push_back(t);
      continue;
    }
    fixed_.push_back(t);
    members_.push_back({corners, problem_.add_variable()});
    problem_.fix(members_.back().var, true);
  }
}

/// Candidates have all their corners among the program's vertices.
bool ClosingProgram::has_vertex(const Member& member, VertexId v) const {
  return index(member.var) < n_candidates_ || contains(vertices_, v);
}

/// A pair for each edge with an end among the program's vertices.
void ClosingProgram::add_pairs() {
  struct Side {
    std::uint64_t edge;
    ilp::VarId var;
  };
  std::vector<Side> sides;
  sides.reserve(3 * members_.size());
  for (const Member& m : members_) {
    const auto& [a, b, c] = m.corners;
    for (const auto& [p, q] : {Edge{a, b}, Edge{a, c}, Edge{b, c}})
      if (has_vertex(m, p) || has_vertex(m, q))
        sides.push_back({std::uint64_t{index(p)} << 32U | index(q), m.var});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.var < b.var;
  });
  std::vector<ilp::VarId> pair;
  for (std::size_t i = 0; i < sides.size();) {
    const std::uint64_t edge = sides[i].edge;
    pair.clear();
    for (; i < sides.size() && sides[i].edge == edge; ++i)
      pair.push_back(sides[i].var);
    problem_.add_pair(pair);
    edge_of_pair_.push_back({VertexId{static_cast<std::uint32_t>(edge >> 32U)},
                             VertexId{static_cast<std::uint32_t>(edge)}});
  }
}

void ClosingProgram::add_rings(std::span<const VertexId> may_drop) {
  std::vector<std::uint64_t> corners;  // a vertex and a member at it
  corners.reserve(3 * members_.size());
  for (std::size_t m = 0; m < members_.size(); ++m)
    for (const VertexId v : members_[m].corners)
      if (has_vertex(members_[m], v))
        corners.push_back(std::uint64_t{index(v)} << 32U | m);
  std::sort(corners.begin(), corners.end());
  std::vector<Member> at_v;
  std::size_t i = 0;
  for (const VertexId v : vertices_) {
    at_v.clear();
    for (; i < corners.size() && corners[i] >> 32U == index(v); ++i)
      at_v.push_back(members_[static_cast<std::uint32_t>(corners[i])]);
    add_ring(v, at_v, contains(may_drop, v));
  }
}

void ClosingProgram::add_ring(VertexId v, std::span<const Member> members,
                              bool may_drop) {
  ends_.clear();
  for (const Member& m : members)
    for (const VertexId end : opposite_edge(m.corners, v)) ends_.push_back(end);
  sort_unique(ends_);
  const auto node = [&](VertexId end) {
    return static_cast<std::uint32_t>(
        std::lower_bound(ends_.begin(), ends_.end(), end) - ends_.begin());
  };
  spokes_.clear();
  bool has_fixed = false;
  for (const Member& m : members) {
    const auto [a, b] = opposite_edge(m.corners, v);
    spokes_.push_back({m.var, node(a), node(b)});
    has_fixed = has_fixed || index(m.var) >= n_candidates_;
  }
  const bool optional = may_drop && !has_fixed;
  problem_.add_ring(spokes_, optional);
  vertex_of_ring_.push_back(v);
  if (optional) let_drop(v, members);
}

/// is_dropped, or some triangle at v.
void ClosingProgram::let_drop(VertexId v, std::span<const Member> members) {
  const ilp::VarId is_dropped = problem_.add_variable();
  std::vector<ilp::Literal> clause = {ilp::Literal(is_dropped, true)};
  for (const Member& m : members) clause.emplace_back(m.var, true);
  problem_.add_clause(clause);
  droppable_.push_back({v, is_dropped});
}

void ClosingProgram::demand_fewer(std::size_t n_triangles) {
  std::vector<ilp::Term> sum(n_candidates_);
  for (std::uint32_t i = 0; i < sum.size(); ++i) sum[i] = {ilp::VarId{i}, 1};
  problem_.add_linear(sum, static_cast<std::int64_t>(freed_.size()) -
                               static_cast<std::int64_t>(n_triangles));
}

std::vector<VertexId> ClosingProgram::vertices_of(const ilp::Core& core) const {
  std::vector<VertexId> result;
  for (const auto& [kind, i] : core.constraints) {
    if (kind == ilp::ConstraintKind::Ring)
      result.push_back(vertex_of_ring_[i]);
    else if (kind == ilp::ConstraintKind::Pair)
      result.insert(result.end(), edge_of_pair_[i].begin(),
                    edge_of_pair_[i].end());
  }
  sort_unique(result);
  return result;
}

}  // namespace umbrella
