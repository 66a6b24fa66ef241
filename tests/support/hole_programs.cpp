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
  const auto n_in = [&is_in](const Located& t) {
    return std::ranges::count_if(t.corners,
                                 [&is_in](auto v) { return is_in[index(v)]; });
  };
  HoleProgram hole;
  hole.n_vertices = static_cast<std::size_t>(std::ranges::count(is_in, true));
  std::vector<VarId> var_of(triangles_.size(), kNoVariable);
  std::vector<double> radius;
  std::map<std::array<std::size_t, 2>, std::vector<VarId>> pairs;
  std::map<std::size_t, std::vector<std::size_t>> at_vertex;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Located& t = triangles_[i];
    const bool is_free = n_in(t) == 3;
    if (!is_free && (!t.in_surface || n_in(t) == 0)) continue;
    var_of[i] = hole.problem.add_variable();
    hole.old.push_back(t.in_surface);
    hole.weights.push_back(std::llround(1e6 * t.area));
    radius.push_back(t.circumradius2);
    if (is_free) hole.worst_first.push_back(var_of[i]);
    if (!is_free) hole.problem.fix(var_of[i], true);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = index(t.corners[k]);
      const std::size_t a = index(t.corners[(k + 1) % 3]);
      if (is_in[v]) at_vertex[v].push_back(i);
      if (is_in[v] || is_in[a])
        pairs[{std::min(v, a), std::max(v, a)}].push_back(var_of[i]);
    }
  }
  for (const auto& [edge, vars] : pairs) hole.problem.add_pair(vars);
  for (const auto& [v, around] : at_vertex) {
    std::map<std::size_t, std::uint32_t> node;
    std::vector<Spoke> spokes;
    for (const std::size_t i : around) {
      std::vector<std::uint32_t> ends;
      for (const auto w : triangles_[i].corners)
        if (index(w) != v)
          ends.push_back(node.try_emplace(index(w), node.size()).first->second);
      spokes.push_back({var_of[i], ends[0], ends[1]});
    }
    hole.problem.add_ring(spokes);
  }
  if (with_sides) add_sides(var_of, hole.problem);
  std::ranges::stable_sort(hole.worst_first, [&radius](VarId a, VarId b) {
    return radius[index(a)] > radius[index(b)];
  });
  return hole;
}

// Cells on the same side, or on opposite ones, of a triangle that is no
// variable are one room; `parity` tells which.
void HoleMaker::add_sides(std::span<const VarId> var_of, Problem& p) const {
  std::vector<std::uint32_t> parent(n_cells_);
  std::iota(parent.begin(), parent.end(), 0U);
  std::vector<std::uint8_t> parity(n_cells_, 0);
  const auto find = [&](std::uint32_t cell) {
    std::uint32_t root = cell, side = 0;
    for (; parent[root] != root; root = parent[root]) side ^= parity[root];
    for (std::uint32_t s = side; parent[cell] != root && cell != root;) {
      const std::uint32_t above = parent[cell], own = parity[cell];
      parent[cell] = root;
      parity[cell] = static_cast<std::uint8_t>(s);
      s ^= own;
      cell = above;
    }
    return std::pair{root, side};
  };
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (var_of[i] != kNoVariable) continue;
    const auto [a, side_a] = find(triangles_[i].cells[0]);
    const auto [b, side_b] = find(triangles_[i].cells[1]);
    if (a == b) continue;
    parent[a] = b;
    parity[a] = static_cast<std::uint8_t>(side_a ^ side_b ^
                                          (triangles_[i].in_surface ? 1U : 0U));
  }
  std::map<std::uint32_t, std::uint32_t> room;
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (var_of[i] == kNoVariable) continue;
    const auto [a, side_a] = find(triangles_[i].cells[0]);
    const auto [b, side_b] = find(triangles_[i].cells[1]);
    const auto number = [&room](std::uint32_t root) {
      return room.try_emplace(root, static_cast<std::uint32_t>(room.size()))
          .first->second;
    };
    const std::uint32_t room_a = number(a), room_b = number(b);
    walls.push_back({var_of[i], room_a, room_b, side_a != side_b});
  }
  p.add_sides(walls);
}

}  // namespace support
