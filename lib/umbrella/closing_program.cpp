#include <algorithm>
#include <utility>

#include "umbrella/closing_program_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {
namespace {

bool contains(std::span<const LocatedTriangle> ascending, const Triangle& t) {
  const auto found =
      std::lower_bound(ascending.begin(), ascending.end(), t,
                       [](const LocatedTriangle& c, const Triangle& wanted) {
                         return c.corners < wanted;
                       });
  return found != ascending.end() && found->corners == t;
}

/// The corners of each side of a triangle; and so the sides of each corner.
constexpr std::array<std::array<unsigned, 2>, 3> kEnds = {
    {{0, 1}, {0, 2}, {1, 2}}};

}  // namespace

ClosingProgram::ClosingProgram(const WorkingSurface& surface, Parts parts,
                               VertexNumbers& numbers)
    : n_candidates_(parts.candidates.size()),
      vertices_(std::move(parts.vertices)) {
  numbers.assign(vertices_);
  sort_triangles(surface, parts.candidates, numbers);
  add_members(surface, parts.candidates, numbers);
  add_rings(add_pairs(), parts.may_drop);
}

/// The triangles at the program's vertices: candidates, and others.
void ClosingProgram::sort_triangles(const WorkingSurface& surface,
                                    std::span<const LocatedTriangle> candidates,
                                    const VertexNumbers& numbers) {
  std::vector<TriangleIndex> at_vertices;
  for (const VertexId v : vertices_)
    surface.for_each_at(v, [&](TriangleIndex t) {
      const auto& [a, b, c] = surface.corners(t);
      const bool is_first =
          v == a || (!numbers.contains(a) && (v == b || !numbers.contains(b)));
      if (is_first) at_vertices.push_back(t);
    });
  std::sort(at_vertices.begin(), at_vertices.end());
  for (const TriangleIndex t : at_vertices)
    (contains(candidates, surface.corners(t)) ? freed_ : fixed_).push_back(t);
}

void ClosingProgram::add_members(const WorkingSurface& surface,
                                 std::span<const LocatedTriangle> candidates,
                                 VertexNumbers& numbers) {
  std::vector<VertexId> outside;
  for (const TriangleIndex t : fixed_)
    for (const VertexId v : surface.corners(t))
      if (!numbers.contains(v)) outside.push_back(v);
  sort_unique(outside);
  nodes_ = united(vertices_, outside);
  is_free_.resize(nodes_.size());
  std::transform(nodes_.begin(), nodes_.end(), is_free_.begin(),
                 [&](VertexId v) { return numbers.contains(v) ? 1 : 0; });
  numbers.assign(nodes_);

  problem_.add_variables(candidates.size() + fixed_.size());
  members_.reserve(candidates.size() + fixed_.size());
  const auto add = [&](const Triangle& t) {
    members_.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
  };
  for (const LocatedTriangle& c : candidates) add(c.corners);
  for (const TriangleIndex t : fixed_) {
    problem_.fix(ilp::VarId{static_cast<std::uint32_t>(members_.size())}, true);
    add(surface.corners(t));
  }
}

/// A pair for each edge with an end among the program's vertices, by its ends.
/// Sides are sorted by their second end, then by their first one.
ClosingProgram::PairOfSide ClosingProgram::add_pairs() {
  struct Side {
    std::uint32_t low, high;  // ends
    std::uint32_t side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * members_.size());
  for (std::uint32_t m = 0; m < members_.size(); ++m)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Side side = {members_[m][kEnds[i][0]], members_[m][kEnds[i][1]],
                         3 * m + i};
      if ((is_free_[side.low] | is_free_[side.high]) != 0)
        sides.push_back(side);
    }
  const auto by_high = ilp::Rows<Side>::grouped(
      nodes_.size(), sides.size(), [&](std::size_t i) { return sides[i].high; },
      [&](std::size_t i) { return sides[i]; });
  const std::span<const Side> order = by_high.items();
  const auto by_low = ilp::Rows<Side>::grouped(
      nodes_.size(), order.size(), [&](std::size_t i) { return order[i].low; },
      [&](std::size_t i) { return order[i]; });

  PairOfSide pair_of_side(3 * members_.size());
  std::vector<ilp::VarId> pair;
  const std::span<const Side> sorted = by_low.items();
  for (auto side = sorted.begin(); side != sorted.end();) {
    const auto [low, high, first] = *side;
    pair.clear();
    for (; side != sorted.end() && side->low == low && side->high == high;
         ++side) {
      pair.push_back(ilp::VarId{side->side / 3});
      pair_of_side[side->side] =
          static_cast<std::uint32_t>(edge_of_pair_.size());
    }
    problem_.add_pair(pair);
    edge_of_pair_.push_back({nodes_[low], nodes_[high]});
  }
  return pair_of_side;
}

void ClosingProgram::add_rings(const PairOfSide& pairs,
                               std::span<const VertexId> may_drop) {
  const auto corners_at = ilp::Rows<std::uint32_t>::grouped(
      nodes_.size(), 3 * members_.size(),
      [&](std::size_t c) { return members_[c / 3][c % 3]; },
      [](std::size_t c) { return static_cast<std::uint32_t>(c); });
  std::vector<ilp::Spoke> spokes;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (is_free_[node] == 0) continue;
    const VertexId v = nodes_[node];
    const auto corners = corners_at[node];
    spokes.clear();
    for (const std::uint32_t c : corners) {
      const std::uint32_t m = c / 3;
      const auto& [i, k] = kEnds[c % 3];
      spokes.push_back({ilp::VarId{m}, pairs[3 * m + i], pairs[3 * m + k]});
    }
    const bool has_fixed =
        !corners.empty() && corners.back() / 3 >= n_candidates_;
    const bool optional =
        !has_fixed && std::binary_search(may_drop.begin(), may_drop.end(), v);
    problem_.add_ring_of_pairs(spokes, optional);
    vertex_of_ring_.push_back(v);
    if (optional) let_drop(v, corners);
  }
}

/// is_dropped, or some triangle at v.
void ClosingProgram::let_drop(VertexId v,
                              std::span<const std::uint32_t> corners) {
  const ilp::VarId is_dropped = problem_.add_variable();
  std::vector<ilp::Literal> clause = {ilp::Literal(is_dropped, true)};
  for (const std::uint32_t c : corners)
    clause.emplace_back(ilp::VarId{c / 3}, true);
  problem_.add_clause(clause);
  droppable_.push_back({v, is_dropped});
}

void ClosingProgram::demand_fewer(std::size_t n_triangles) {
  std::vector<ilp::Term> sum(n_candidates_);
  for (std::uint32_t i = 0; i < sum.size(); ++i) sum[i] = {ilp::VarId{i}, 1};
  problem_.add_linear(sum, static_cast<std::int64_t>(freed_.size()) -
                               static_cast<std::int64_t>(n_triangles));
}

void ClosingProgram::set_apart(std::span<const VertexId> part) {
  for (std::uint32_t i = 0; i < n_candidates_; ++i) {
    const auto n = std::count_if(
        members_[i].begin(), members_[i].end(), [&](std::uint32_t node) {
          return std::binary_search(part.begin(), part.end(), nodes_[node]);
        });
    if (n == 1 || n == 2) problem_.fix(ilp::VarId{i}, false);
  }
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
