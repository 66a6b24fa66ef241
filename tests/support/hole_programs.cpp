#include "tests/support/hole_programs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <random>

#include "apps/shapes.h"
#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/criterion.h"
#include "umbrella/reconstruct.h"

namespace support {

using ilp::Literal;
using ilp::Problem;
using ilp::Spoke;
using ilp::VarId;
using ilp::Wall;
using umbrella::Triangle;

namespace {

constexpr VarId kNoVariable{0xffff'ffffU};

std::vector<Triangle> surface_of(const delaunay::Triangulation3& delaunay,
                                 const umbrella::Reconstruction& surface) {
  std::vector<Triangle> triangles;
  for (const auto& rows : surface.triangles) {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = delaunay.vertex_of_row()[rows[i]];
    std::ranges::sort(t);
    triangles.push_back(t);
  }
  std::ranges::sort(triangles);
  return triangles;
}

std::array<std::size_t, 2> ends(delaunay::VertexId a, delaunay::VertexId b) {
  return {std::min(index(a), index(b)), std::max(index(a), index(b))};
}

double area(const std::array<delaunay::Point3, 3>& p) {
  const Eigen::Vector3d u = p[1] - p[0], v = p[2] - p[0];
  return 0.5 * std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() -
                                           std::pow(u.dot(v), 2)));
}

}  // namespace

void mutate(Problem& problem, std::mt19937_64& rng) {
  const auto n = problem.n_variables();
  const auto some = [&rng, n] {
    return VarId{static_cast<std::uint32_t>(rng() % n)};
  };
  std::vector<bool> is_fixed(n, false);
  for (const Literal l : problem.fixed()) is_fixed[index(l.var())] = true;
  const std::uint64_t percent = rng() % 12;
  for (std::uint32_t v = 0; v < n; ++v)
    if (!is_fixed[v] && rng() % 100 < percent)
      problem.fix(VarId{v}, rng() % 6 == 0);
  if (rng() % 3 == 0)
    problem.add_clause(std::array{Literal(some(), true), Literal(some(), true),
                                  Literal(some(), false)});
  if (rng() % 3 != 0) return;
  std::vector<ilp::Term> terms;
  std::int64_t half = 0;
  for (std::uint32_t v = 0; v < n; ++v) {
    if (is_fixed[v] || rng() % n > 40) continue;
    terms.push_back({VarId{v}, static_cast<std::int64_t>(1 + rng() % 4)});
    half += terms.back().coefficient;
  }
  problem.add_linear(terms, half * static_cast<std::int64_t>(rng() % 60) / 100);
}

HoleMaker::HoleMaker(const Shape& shape) {
  const auto points = shapes::sample(
      shape.name, shape.n_points, {.seed = shape.seed, .noise = shape.noise});
  const auto reconstruction = umbrella::reconstruct(points);
  is_closed_ = reconstruction.surface.closed && reconstruction.surface.manifold;
  const delaunay::Triangulation3 delaunay(points);
  n_vertices_ = delaunay.points().size();
  n_cells_ = delaunay.cells().size();
  const auto surface = surface_of(delaunay, reconstruction);
  const umbrella::Circumspheres spheres(delaunay);
  for (const delaunay::Facet facet : umbrella::facets(delaunay)) {
    const umbrella::DelaunayTriangle t(delaunay, spheres, facet);
    const auto cells = t.cells();
    triangles_.push_back({t.corners(),
                          {static_cast<std::uint32_t>(cells[0]),
                           static_cast<std::uint32_t>(cells[1])},
                          t.squared_circumradius(),
                          area(t.points()),
                          std::ranges::binary_search(surface, t.corners())});
  }
  std::ranges::sort(triangles_, {}, &Located::corners);
}

// The first n vertices of a walk over the surface, ring by ring.
std::vector<bool> HoleMaker::patch(std::size_t n, std::uint64_t seed) const {
  std::vector<std::vector<std::size_t>> next(n_vertices_);
  for (const Located& t : triangles_)
    for (const auto v : t.corners)
      for (const auto w : t.corners)
        if (t.in_surface && v != w) next[index(v)].push_back(index(w));
  std::mt19937_64 rng(seed);
  std::vector<bool> is_in(n_vertices_, false);
  std::queue<std::size_t> front;
  std::size_t start = rng() % n_vertices_;
  while (next[start].empty()) start = (start + 1) % n_vertices_;
  is_in[start] = true;
  front.push(start);
  for (std::size_t taken = 1; taken < n && !front.empty(); front.pop())
    for (const std::size_t w : next[front.front()])
      if (!is_in[w] && taken < n) {
        is_in[w] = true;
        front.push(w);
        ++taken;
      }
  return is_in;
}

HoleProgram HoleMaker::hole(std::size_t n, std::uint64_t seed,
                            bool with_sides) const {
  const std::vector<bool> is_in = patch(n, seed);
  HoleProgram hole;
  hole.n_vertices = static_cast<std::size_t>(std::ranges::count(is_in, true));
  const std::vector<VarId> var_of = add_triangles(is_in, hole);
  add_rings(is_in, var_of, add_pairs(is_in, var_of, hole.problem),
            hole.problem);
  if (with_sides) add_sides(var_of, hole.problem);
  return hole;
}

// Free are those with three corners in the hole; those of the surface with one
// or two stay.
std::vector<VarId> HoleMaker::add_triangles(const std::vector<bool>& is_in,
                                            HoleProgram& hole) const {
  std::vector<VarId> var_of(triangles_.size(), kNoVariable);
  std::vector<double> radius;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Located& t = triangles_[i];
    const auto n_in = std::ranges::count_if(
        t.corners, [&is_in](auto v) { return is_in[index(v)]; });
    if (n_in < 3 && (!t.in_surface || n_in == 0)) continue;
    var_of[i] = hole.problem.add_variable();
    hole.old.push_back(t.in_surface);
    hole.weights.push_back(std::llround(1e6 * t.area));
    radius.push_back(t.circumradius2);
    if (n_in == 3) hole.worst_first.push_back(var_of[i]);
    if (n_in < 3) hole.problem.fix(var_of[i], true);
  }
  std::ranges::stable_sort(hole.worst_first, [&radius](VarId a, VarId b) {
    return radius[index(a)] > radius[index(b)];
  });
  return var_of;
}

// A pair for each edge with an end in the hole, by its ends.
HoleMaker::Pairs HoleMaker::add_pairs(const std::vector<bool>& is_in,
                                      std::span<const VarId> var_of,
                                      Problem& p) const {
  std::map<std::array<std::size_t, 2>, std::vector<VarId>> vars_of;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (var_of[i] == kNoVariable) continue;
    const Triangle& corners = triangles_[i].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = ends(corners[k], corners[(k + 1) % 3]);
      if (is_in[edge[0]] || is_in[edge[1]]) vars_of[edge].push_back(var_of[i]);
    }
  }
  Pairs pairs;
  for (const auto& [edge, vars] : vars_of) pairs[edge] = p.add_pair(vars).index;
  return pairs;
}

void HoleMaker::add_rings(const std::vector<bool>& is_in,
                          std::span<const VarId> var_of, const Pairs& pairs,
                          Problem& p) const {
  std::map<std::size_t, std::vector<Spoke>> rings;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (var_of[i] == kNoVariable) continue;
    const Triangle& corners = triangles_[i].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = corners[k];
      if (is_in[index(v)])
        rings[index(v)].push_back({var_of[i],
                                   pairs.at(ends(v, corners[(k + 1) % 3])),
                                   pairs.at(ends(v, corners[(k + 2) % 3]))});
    }
  }
  for (const auto& [v, spokes] : rings) p.add_ring_of_pairs(spokes);
}

namespace {

/// Cells in groups; each knows whether it lies on the side of its group's
/// first.
class Rooms {
 public:
  struct Place {
    std::uint32_t group;
    std::uint32_t side;
  };

  explicit Rooms(std::size_t n_cells) : parent_(n_cells), side_(n_cells, 0) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  Place find(std::uint32_t cell) {
    if (parent_[cell] == cell) return {cell, 0};
    const Place above = find(parent_[cell]);
    parent_[cell] = above.group;
    side_[cell] ^= above.side;
    return {above.group, side_[cell]};
  }

  void join(std::uint32_t a, std::uint32_t b, bool differ) {
    const Place at_a = find(a), at_b = find(b);
    if (at_a.group == at_b.group) return;
    parent_[at_a.group] = at_b.group;
    side_[at_a.group] = at_a.side ^ at_b.side ^ (differ ? 1U : 0U);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> side_;  // relative to the parent
};

}  // namespace

void HoleMaker::add_sides(std::span<const VarId> var_of, Problem& p) const {
  Rooms rooms(n_cells_);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& [a, b] = triangles_[i].cells;
    if (var_of[i] == kNoVariable) rooms.join(a, b, triangles_[i].in_surface);
  }
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (var_of[i] == kNoVariable) continue;
    const Rooms::Place a = rooms.find(triangles_[i].cells[0]);
    const Rooms::Place b = rooms.find(triangles_[i].cells[1]);
    for (const std::uint32_t group : {a.group, b.group})
      number.try_emplace(group, static_cast<std::uint32_t>(number.size()));
    walls.push_back(
        {var_of[i], number[a.group], number[b.group], a.side != b.side});
  }
  p.add_sides(walls);
}

}  // namespace support
