#include "tests/support/ilp_programs.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <map>
#include <numeric>

namespace support {

using ilp::ConstraintKind;
using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Spoke;
using ilp::Term;
using ilp::VarId;
using ilp::Wall;

namespace {

std::uint32_t below(std::mt19937_64& rng, std::uint32_t n) {
  return static_cast<std::uint32_t>(rng() % n);
}

bool with_chance(std::mt19937_64& rng, double p) {
  return std::uniform_real_distribution<double>(0, 1)(rng) < p;
}

Triangle sorted(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Triangle t = {a, b, c};
  std::ranges::sort(t);
  return t;
}

std::vector<Literal> random_clause(std::mt19937_64& rng, std::uint32_t n) {
  std::vector<Literal> clause;
  for (std::uint32_t k = 1 + below(rng, 4); k > 0; --k)
    clause.emplace_back(VarId{below(rng, n)}, below(rng, 2) == 0);
  return clause;
}

std::vector<VarId> random_subset(std::mt19937_64& rng, std::uint32_t n,
                                 std::size_t size) {
  std::vector<VarId> vars = random_order(rng, n);
  vars.resize(std::min<std::size_t>(size, n));
  return vars;
}

std::vector<Wall> random_walls(std::mt19937_64& rng, std::uint32_t n) {
  std::vector<Wall> walls;
  const std::uint32_t n_rooms = 1 + below(rng, 6);
  for (const VarId v : random_subset(rng, n, (n_rooms + 1) / 2 + below(rng, 8)))
    walls.push_back(
        {v, below(rng, n_rooms), below(rng, n_rooms), below(rng, 2) == 0});
  if (2 * walls.size() < n_rooms) walls.clear();
  return walls;
}

std::vector<Term> random_terms(std::mt19937_64& rng, std::uint32_t n) {
  std::vector<Term> terms;
  const std::int64_t range = std::int64_t{1} << below(rng, 5);
  for (const VarId v : random_subset(rng, n, 1 + below(rng, 9))) {
    const auto size = static_cast<std::int64_t>(rng()) % (range + 1);
    terms.push_back({v, size});
  }
  return terms;
}

// Near what half of the variables give.
void add_random_linear(std::mt19937_64& rng, Problem& problem) {
  const auto n = static_cast<std::uint32_t>(problem.n_variables());
  const std::vector<Term> terms = random_terms(rng, n);
  std::int64_t sum = 0, size = 0;
  for (const Term& t : terms) {
    sum += t.coefficient;
    size += std::abs(t.coefficient);
  }
  problem.add_linear(
      terms, sum / 2 + static_cast<std::int64_t>(rng()) % (size / 2 + 1));
}

void add_random_extras(std::mt19937_64& rng, Problem& problem) {
  const auto n = static_cast<std::uint32_t>(problem.n_variables());
  for (std::uint32_t k = below(rng, 4); k > 0; --k)
    problem.add_clause(random_clause(rng, n));
  for (std::uint32_t k = below(rng, 4); k > 0; --k)
    problem.fix(VarId{below(rng, n)}, below(rng, 2) == 0);
  if (below(rng, 3) == 0) add_random_linear(rng, problem);
}

// The nodes numbered from 0: they may have been pairs.
std::vector<Spoke> with_own_nodes(std::span<const Spoke> ring) {
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<Spoke> spokes(ring.begin(), ring.end());
  for (Spoke& s : spokes)
    for (std::uint32_t* node : {&s.a, &s.b})
      *node =
          number.try_emplace(*node, static_cast<std::uint32_t>(number.size()))
              .first->second;
  return spokes;
}

}  // namespace

Problem surface_program(std::span<const Triangle> triangles,
                        std::span<const std::uint32_t> optional) {
  using Edge = std::array<std::uint32_t, 2>;
  std::map<Edge, std::vector<VarId>> pairs;
  std::map<std::uint32_t, std::vector<Spoke>> rings;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> nodes;
  const auto node = [&nodes](std::uint32_t v, std::uint32_t w) {
    auto& of_v = nodes[v];
    return of_v.try_emplace(w, static_cast<std::uint32_t>(of_v.size()))
        .first->second;
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangles[t][i];
      const auto [a, b] =
          std::minmax(triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]);
      pairs[{a, b}].push_back(VarId{t});
      rings[v].push_back({VarId{t}, node(v, a), node(v, b)});
    }

  Problem problem;
  problem.add_variables(triangles.size());
  for (const auto& [edge, vars] : pairs) problem.add_pair(vars);
  for (const auto& [v, spokes] : rings)
    problem.add_ring(spokes, std::ranges::find(optional, v) != optional.end());
  return problem;
}

std::vector<Triangle> all_triangles(std::uint32_t n) {
  std::vector<Triangle> all;
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c) all.push_back({a, b, c});
  return all;
}

std::vector<Triangle> torus(std::uint32_t rows, std::uint32_t columns) {
  const auto id = [rows, columns](std::uint32_t i, std::uint32_t j) {
    return i % rows * columns + j % columns;
  };
  std::vector<Triangle> all;
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      all.push_back(sorted(id(i, j), id(i + 1, j), id(i, j + 1)));
      all.push_back(sorted(id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)));
    }
  return all;
}

Problem torus_hole(std::uint32_t size, double extra, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  const std::uint32_t columns = size + 4;
  std::vector<Triangle> triangles = torus(columns, columns);
  const auto is_free = [size, columns](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) {
      return v / columns < size && v % columns < size;
    });
  };
  const auto n_free = std::ranges::count_if(triangles, is_free);
  const auto near = [&rng, size](std::uint32_t i) {
    const std::uint32_t first = i < 2 ? 0 : i - 2;
    return first + below(rng, std::min(i + 2, size - 1) - first + 1);
  };
  for (auto k = static_cast<int>(extra * static_cast<double>(n_free)); k > 0;
       --k) {
    const std::uint32_t i = below(rng, size), j = below(rng, size);
    const Triangle t = sorted(i * columns + j, near(i) * columns + near(j),
                              near(i) * columns + near(j));
    if (t[0] != t[1] && t[1] != t[2]) triangles.push_back(t);
  }
  std::ranges::sort(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()),
                  triangles.end());

  Problem problem = surface_program(triangles);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!is_free(triangles[t])) problem.fix(VarId{t}, true);
  return problem;
}

Problem random_surface_program(std::mt19937_64& rng,
                               std::uint32_t max_triangles) {
  const std::uint32_t n_vertices = 4 + below(rng, 4);
  std::vector<Triangle> triangles = all_triangles(n_vertices);
  std::ranges::shuffle(triangles, rng);
  const std::size_t n =
      std::max<std::size_t>(4, max_triangles - below(rng, max_triangles / 2));
  triangles.resize(std::min(n, triangles.size()));
  std::vector<std::uint32_t> optional;
  for (std::uint32_t v = 0; v < n_vertices; ++v)
    if (with_chance(rng, 0.3)) optional.push_back(v);
  Problem problem = surface_program(triangles, optional);
  add_random_extras(rng, problem);
  return problem;
}

Problem random_program(std::mt19937_64& rng, std::uint32_t max_variables) {
  const std::uint32_t n = 1 + below(rng, max_variables);
  Problem problem;
  problem.add_variables(n);
  for (std::uint32_t k = below(rng, 5); k > 0; --k)
    problem.add_pair(random_subset(rng, n, below(rng, 6)));
  for (std::uint32_t k = below(rng, 4); k > 0; --k) {
    std::vector<Spoke> spokes;
    const std::uint32_t n_nodes = 2 + below(rng, 5);
    for (const VarId v : random_subset(rng, n, n_nodes + below(rng, 7))) {
      const std::uint32_t a = below(rng, n_nodes);
      spokes.push_back({v, a, (a + 1 + below(rng, n_nodes - 1)) % n_nodes});
    }
    if (2 * spokes.size() < n_nodes) continue;
    problem.add_ring(spokes, below(rng, 3) == 0);
  }
  for (std::uint32_t k = below(rng, 3); k > 0; --k)
    problem.add_sides(random_walls(rng, n));
  for (std::uint32_t k = below(rng, 4); k > 0; --k)
    add_random_linear(rng, problem);
  add_random_extras(rng, problem);
  return problem;
}

Problem with_fixed(Problem problem, std::span<const Literal> literals) {
  for (const Literal l : literals) problem.fix(l.var(), l.value());
  return problem;
}

Problem part_of(const Problem& problem,
                std::span<const ilp::ConstraintId> constraints) {
  Problem part;
  part.add_variables(problem.n_variables());
  for (const auto& [kind, i] : constraints) {
    if (kind == ConstraintKind::Pair) part.add_pair(problem.pair(i));
    if (kind == ConstraintKind::Ring)
      part.add_ring(with_own_nodes(problem.ring(i)), problem.is_optional(i));
    if (kind == ConstraintKind::Sides) part.add_sides(problem.sides(i));
    if (kind == ConstraintKind::Clause) part.add_clause(problem.clause(i));
    if (kind == ConstraintKind::Linear)
      part.add_linear(problem.linear(i), problem.bound(i));
  }
  return with_fixed(part, problem.fixed());
}

void add_rows(Problem& problem, const ilp::LinearForm& form) {
  for (const ilp::LinearRow& row : form.rows) {
    std::vector<ilp::Term> opposite = row.terms;
    for (ilp::Term& t : opposite) t.coefficient = -t.coefficient;
    problem.add_linear(opposite, -row.bound);
    if (row.is_equation) problem.add_linear(row.terms, row.bound);
  }
}

Problem rows_alone(const ilp::LinearForm& form) {
  Problem problem;
  problem.add_variables(form.n_variables);
  add_rows(problem, form);
  return problem;
}

std::vector<VarId> random_order(std::mt19937_64& rng, std::size_t n) {
  std::vector<VarId> order(n);
  for (std::uint32_t i = 0; i < n; ++i) order[i] = VarId{i};
  std::ranges::shuffle(order, rng);
  return order;
}

namespace {

/// The fixed values, the others false; nothing if they contradict each other.
std::optional<Model> fixed_values(const Problem& problem,
                                  std::vector<bool>& is_fixed) {
  Model model(problem.n_variables(), false);
  is_fixed.assign(problem.n_variables(), false);
  for (const Literal l : problem.fixed()) {
    if (is_fixed[index(l.var())] && model[index(l.var())] != l.value())
      return std::nullopt;
    is_fixed[index(l.var())] = true;
    model[index(l.var())] = l.value();
  }
  return model;
}

struct PairBits {
  int n_fixed_true = 0;
  std::uint32_t free = 0;

  bool holds(std::uint32_t x) const {
    const int n_true = n_fixed_true + std::popcount(x & free);
    return n_true == 0 || n_true == 2;
  }
};

}  // namespace

std::optional<Model> least_model(const Problem& problem,
                                 std::span<const VarId> order) {
  std::vector<bool> is_fixed;
  std::optional<Model> model = fixed_values(problem, is_fixed);
  if (!model) return std::nullopt;
  std::vector<VarId> free;
  for (const VarId v : order)
    if (!is_fixed[index(v)]) free.push_back(v);
  // Bit n-1-i of the counter is the i-th free variable of the order.
  const std::size_t n = free.size();
  std::vector<std::uint32_t> bit(order.size(), 0);
  for (std::size_t i = 0; i < n; ++i) bit[index(free[i])] = 1U << (n - 1 - i);
  std::vector<PairBits> pairs(problem.n_pairs());
  for (std::size_t p = 0; p < problem.n_pairs(); ++p)
    for (const VarId v : problem.pair(p)) {
      pairs[p].free |= bit[index(v)];
      if ((*model)[index(v)]) ++pairs[p].n_fixed_true;
    }
  for (std::uint32_t x = 0; x < 1U << n; ++x) {
    if (!std::ranges::all_of(pairs,
                             [x](const PairBits& p) { return p.holds(x); }))
      continue;
    for (const VarId v : free) (*model)[index(v)] = (x & bit[index(v)]) != 0;
    if (first_violation(problem, *model).empty()) return model;
  }
  return std::nullopt;
}

}  // namespace support
