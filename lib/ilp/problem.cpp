#include "ilp/problem.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace ilp {
namespace {

template <class T>
ConstraintId add_row(Rows<T>& rows, std::span<const T> row,
                     ConstraintKind kind) {
  if (rows.size() >= kMaxVariables)
    throw std::length_error("ilp: more than 2^29 constraints of one kind");
  rows.add(row);
  return {kind, static_cast<std::uint32_t>(rows.size() - 1)};
}

// Degrees alone allow several cycles: what one walk does not meet is another.
bool is_one_cycle(std::vector<Spoke> spokes) {
  const std::uint32_t start = spokes.back().a;
  std::uint32_t node = spokes.back().b;
  spokes.pop_back();
  while (node != start) {
    const auto next = std::ranges::find_if(
        spokes, [node](const Spoke& s) { return s.a == node || s.b == node; });
    if (next == spokes.end()) return false;
    node = next->a == node ? next->b : next->a;
    spokes.erase(next);
  }
  return spokes.empty();
}

bool has_simple_degrees(std::span<const Spoke> spokes) {
  std::vector<std::uint32_t> ends;
  for (const Spoke& s : spokes) ends.insert(ends.end(), {s.a, s.b});
  return std::ranges::all_of(ends, [&ends](std::uint32_t node) {
    return std::ranges::count(ends, node) == 2;
  });
}

bool pair_holds(std::span<const VarId> vars, const Model& model) {
  const auto n_true = std::ranges::count_if(
      vars, [&model](VarId v) { return model[index(v)]; });
  return n_true == 0 || n_true == 2;
}

bool ring_holds(std::span<const Spoke> ring, bool optional,
                const Model& model) {
  std::vector<Spoke> spokes;
  for (const Spoke& s : ring)
    if (model[index(s.var)]) spokes.push_back(s);
  if (spokes.empty()) return optional;
  return has_simple_degrees(spokes) && is_one_cycle(spokes);
}

// Two nodes for each room: it lies on the first side, on the second. A wall
// joins what agrees with it; no room may be joined to its own opposite.
bool sides_hold(std::span<const Wall> walls, const Model& model) {
  std::vector<std::size_t> parent(4 * walls.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const Wall& w : walls) {
    const std::size_t flip = model[index(w.var)] != w.inverted ? 1 : 0;
    for (const std::size_t side : {0, 1})
      parent[root(2 * std::size_t{w.a} + side)] =
          root(2 * std::size_t{w.b} + (side ^ flip));
  }
  return std::ranges::none_of(walls, [&root](const Wall& w) {
    return root(2 * std::size_t{w.a}) == root(2 * std::size_t{w.a} + 1);
  });
}

bool linear_holds(std::span<const Term> terms, std::int64_t bound,
                  const Model& model) {
  std::int64_t sum = 0;
  for (const Term& t : terms)
    if (model[index(t.var)]) sum += t.coefficient;
  return sum <= bound;
}

std::string name(const char* kind, std::size_t i) {
  return std::string(kind) + " " + std::to_string(i);
}

}  // namespace

bool is_in_range(std::span<const Term> terms, std::int64_t bound) {
  std::uint64_t left = kMaxLinearSum;
  const auto take = [&left](std::int64_t x) {
    const auto u = static_cast<std::uint64_t>(x);
    const std::uint64_t size = x < 0 ? ~u + 1 : u;
    if (size > left) return false;
    left -= size;
    return true;
  };
  return take(bound) && std::ranges::all_of(terms, take, &Term::coefficient);
}

VarId Problem::add_variable() { return add_variables(1); }

VarId Problem::add_variables(std::size_t n) {
  const std::size_t first = mark_.size();
  if (n > kMaxVariables - first)
    throw std::length_error("ilp: more than 2^29 variables");
  mark_.resize(first + n, 0);
  return VarId{static_cast<std::uint32_t>(first)};
}

ConstraintId Problem::add_pair(std::span<const VarId> vars) {
  ++n_checks_;
  for (const VarId v : vars) check_distinct(v);
  return add_row(pairs_, vars, ConstraintKind::Pair);
}

ConstraintId Problem::add_ring(std::span<const Spoke> spokes, bool optional) {
  check_spokes(spokes, 2 * spokes.size());
  return append_ring(spokes, optional, false);
}

ConstraintId Problem::add_ring_of_pairs(std::span<const Spoke> spokes,
                                        bool optional) {
  check_spokes(spokes, n_pairs());
  check_pairs_of(spokes);
  return append_ring(spokes, optional, true);
}

ConstraintId Problem::append_ring(std::span<const Spoke> spokes, bool optional,
                                  bool of_pairs) {
  const ConstraintId id = add_row(rings_, spokes, ConstraintKind::Ring);
  is_optional_.push_back(optional);
  is_of_pairs_.push_back(of_pairs);
  return id;
}

void Problem::check_spokes(std::span<const Spoke> spokes, std::size_t n_nodes) {
  ++n_checks_;
  for (const Spoke& s : spokes) {
    check_distinct(s.var);
    if (s.a == s.b || std::max(s.a, s.b) >= n_nodes)
      throw std::invalid_argument("ilp: spoke " + std::to_string(s.a) + " " +
                                  std::to_string(s.b) + " of ring " +
                                  std::to_string(n_rings()));
  }
}

// Spokes that are all among the variables, and as many, are the variables: for
// all pairs together it is enough to count. Where the spokes come in the order
// of the variables, no search is needed.
void Problem::check_pairs_of(std::span<const Spoke> spokes) {
  n_met_.resize(n_pairs(), 0);
  std::size_t n_left = 2 * spokes.size();
  bool is_right = true;
  const auto meet = [&](std::uint32_t p, VarId v) {
    const std::span<const VarId> vars = pair(p);
    const std::uint32_t i = n_met_[p]++;
    if (i == 0) n_left -= vars.size();
    is_right &= (i < vars.size() && vars[i] == v) ||
                std::ranges::find(vars, v) != vars.end();
  };
  for (const auto& [v, a, b] : spokes) {
    meet(a, v);
    meet(b, v);
  }
  for (const Spoke& s : spokes) n_met_[s.a] = n_met_[s.b] = 0;
  if (!is_right || n_left != 0)
    throw std::invalid_argument("ilp: ring " + std::to_string(n_rings()) +
                                " has other spokes than its pairs");
}

ConstraintId Problem::add_sides(std::span<const Wall> walls) {
  ++n_checks_;
  for (const Wall& w : walls) {
    check_distinct(w.var);
    if (std::max(w.a, w.b) >= 2 * walls.size())
      throw std::invalid_argument("ilp: wall " + std::to_string(w.a) + " " +
                                  std::to_string(w.b) + " of sides " +
                                  std::to_string(n_sides()));
  }
  return add_row(sides_, walls, ConstraintKind::Sides);
}

ConstraintId Problem::add_clause(std::span<const Literal> literals) {
  for (const Literal l : literals) check_known(l.var());
  return add_row(clauses_, literals, ConstraintKind::Clause);
}

ConstraintId Problem::add_linear(std::span<const Term> terms,
                                 std::int64_t bound) {
  ++n_checks_;
  for (const Term& t : terms) check_distinct(t.var);
  if (!is_in_range(terms, bound))
    throw std::invalid_argument("ilp: linear constraint " +
                                std::to_string(n_linear()) + " out of range");
  const ConstraintId id = add_row(linear_, terms, ConstraintKind::Linear);
  bounds_.push_back(bound);
  return id;
}

void Problem::fix(VarId var, bool value) {
  check_known(var);
  fixed_.emplace_back(var, value);
}

void Problem::check_known(VarId var) const {
  if (index(var) >= n_variables())
    throw std::invalid_argument("ilp: no variable " +
                                std::to_string(index(var)));
}

void Problem::check_distinct(VarId var) {
  check_known(var);
  if (mark_[index(var)] == n_checks_)
    throw std::invalid_argument("ilp: variable " + std::to_string(index(var)) +
                                " twice in one constraint");
  mark_[index(var)] = n_checks_;
}

std::string first_violation(const Problem& problem, const Model& model) {
  if (model.size() != problem.n_variables()) return "size of the model";
  const auto holds = [&model](Literal l) {
    return model[index(l.var())] == l.value();
  };
  for (const Literal l : problem.fixed())
    if (!holds(l)) return name("fixed variable", index(l.var()));
  for (std::size_t i = 0; i < problem.n_pairs(); ++i)
    if (!pair_holds(problem.pair(i), model)) return name("pair", i);
  for (std::size_t i = 0; i < problem.n_rings(); ++i)
    if (!ring_holds(problem.ring(i), problem.is_optional(i), model))
      return name("ring", i);
  for (std::size_t i = 0; i < problem.n_sides(); ++i)
    if (!sides_hold(problem.sides(i), model)) return name("sides", i);
  for (std::size_t i = 0; i < problem.n_clauses(); ++i)
    if (std::ranges::none_of(problem.clause(i), holds))
      return name("clause", i);
  for (std::size_t i = 0; i < problem.n_linear(); ++i)
    if (!linear_holds(problem.linear(i), problem.bound(i), model))
      return name("linear", i);
  return {};
}

}  // namespace ilp
