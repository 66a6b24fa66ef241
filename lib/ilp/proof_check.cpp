// Reverse unit propagation [Goldberg03]: a clause follows if propagation, begun
// from the opposites of its literals, meets a contradiction. Whenever a
// variable gets a value, every constraint that has it is looked at from
// scratch; sides, which are long, only when nothing else moves.

#include "ilp/proof_check.h"

#include <algorithm>
#include <cstdlib>
#include <istream>
#include <numeric>
#include <sstream>
#include <utility>

namespace ilp {

ProofChecker::ProofChecker(const Problem& problem,
                           std::span<const Term> objective)
    : problem_(problem),
      constraints_of_(problem.n_variables()),
      value_(problem.n_variables()),
      objective_(objective.begin(), objective.end()) {
  for (std::uint32_t i = 0; i < problem.n_pairs(); ++i) {
    for (const VarId v : problem.pair(i)) watch(v);
    constraints_.push_back({ConstraintKind::Pair, i});
  }
  for (std::uint32_t i = 0; i < problem.n_rings(); ++i) {
    for (const Spoke& s : problem.ring(i)) watch(s.var);
    constraints_.push_back({ConstraintKind::Ring, i});
  }
  for (std::size_t i = 0; i < problem.n_linear(); ++i)
    add_linear({{problem.linear(i).begin(), problem.linear(i).end()},
                problem.bound(i)});
  for (std::size_t i = 0; i < problem.n_clauses(); ++i)
    add_clause({problem.clause(i).begin(), problem.clause(i).end()});
  for (const Literal l : problem.fixed())
    if (!set(l.var(), l.value())) is_refuted_ = true;
  for (std::size_t c = 0; c < constraints_.size() && !is_refuted_; ++c)
    is_refuted_ = !visit(constraints_[c]);
  settle();
}

void ProofChecker::add_clause(std::vector<Literal> clause) {
  std::ranges::sort(clause);
  for (const Literal l : clause) watch(l.var());
  number_of_clause_[clause].push_back(constraints_.size());
  constraints_.push_back(
      {ConstraintKind::Clause, static_cast<std::uint32_t>(clauses_.size())});
  clauses_.push_back(std::move(clause));
}

void ProofChecker::add_linear(Linear linear) {
  for (const Term& t : linear.terms) watch(t.var);
  constraints_.push_back(
      {ConstraintKind::Linear, static_cast<std::uint32_t>(linear_.size())});
  linear_.push_back(std::move(linear));
}

bool ProofChecker::remove_clause(std::vector<Literal> clause) {
  std::ranges::sort(clause);
  const auto found = number_of_clause_.find(clause);
  if (found == number_of_clause_.end()) return false;
  for (const Literal l : clause)
    std::erase(constraints_of_[index(l.var())], found->second.back());
  found->second.pop_back();
  if (found->second.empty()) number_of_clause_.erase(found);
  return true;
}

std::string ProofChecker::first_flaw(std::istream& log) {
  std::string text;
  for (std::size_t number = 1; std::getline(log, text); ++number) {
    std::istringstream line(text);
    const std::string flaw = read_line(line);
    if (!flaw.empty()) return "line " + std::to_string(number) + ": " + flaw;
  }
  return {};
}

std::string ProofChecker::read_line(std::istream& line) {
  char kind = 0;
  line >> kind;
  if (kind == 'b') return read_linear(line);
  std::vector<Literal> literals;
  std::int64_t number = 0;
  const auto n = static_cast<std::int64_t>(value_.size());
  while (line >> number && number != 0) {
    if (number > n || number < -n) return "no such variable";
    literals.emplace_back(
        VarId{static_cast<std::uint32_t>(std::abs(number)) - 1}, number > 0);
  }
  if (!line) return "no 0 at its end";
  if (kind == 'm') return read_model(literals);
  if (kind == 'd')
    return remove_clause(literals) ? "" : "removes what is not there";
  if (kind != 'a' && kind != 'l') return "no such kind of line";
  if (kind == 'l' && !implies(literals)) return "does not follow";
  add_clause(literals);
  if (!is_refuted_) is_refuted_ = !visit(constraints_.back());
  settle();
  return {};
}

std::string ProofChecker::read_linear(std::istream& line) {
  Linear linear;
  std::int64_t a = 0, var = 0;
  line >> linear.bound;
  while (line >> a && a != 0 && line >> var) {
    if (var < 1 || var > static_cast<std::int64_t>(value_.size()))
      return "no such variable";
    linear.terms.push_back({VarId{static_cast<std::uint32_t>(var - 1)}, a});
  }
  if (!line) return "no 0 at its end";
  if (!is_in_range(linear.terms, linear.bound)) return "out of range";
  join(std::move(linear));
  return {};
}

// All that was derived holds in every better model.
std::string ProofChecker::read_model(std::span<const Literal> literals) {
  Model model(value_.size(), false);
  for (const Literal l : literals) model[index(l.var())] = l.value();
  const std::string broken = first_violation(problem_, model);
  if (!broken.empty()) return "no model: " + broken;
  const auto in_model = [&model](Literal l) {
    return model[index(l.var())] == l.value();
  };
  for (const std::vector<Literal>& clause : clauses_)
    if (std::ranges::none_of(clause, in_model)) return "breaks a line before";
  const auto sum = [&model](std::span<const Term> terms) {
    return std::accumulate(terms.begin(), terms.end(), std::int64_t{0},
                           [&model](std::int64_t s, const Term& t) {
                             return model[index(t.var)] ? s + t.coefficient : s;
                           });
  };
  for (const Linear& l : linear_)
    if (sum(l.terms) > l.bound) return "breaks a bound before";
  best_ = sum(objective_);
  join({objective_, *best_ - 1});
  return {};
}

void ProofChecker::join(Linear linear) {
  add_linear(std::move(linear));
  if (!is_refuted_) is_refuted_ = !visit(constraints_.back());
  settle();
}

// What follows without assumption holds for good.
void ProofChecker::settle() {
  if (!is_refuted_) is_refuted_ = !propagate();
}

bool ProofChecker::implies(std::span<const Literal> clause) {
  if (is_refuted_) return true;
  const std::size_t n_kept = trail_.size();
  const auto fails = [this](Literal l) { return set(l.var(), !l.value()); };
  const bool follows = !std::ranges::all_of(clause, fails) || !propagate();
  for (const VarId v : std::span(trail_).subspan(n_kept))
    value_[index(v)].reset();
  trail_.resize(n_kept);
  n_followed_ = n_kept;
  return follows;
}

// False if the variable has the other value.
bool ProofChecker::set(VarId v, bool value) {
  if (!is_open(v)) return is_true(v) == value;
  value_[index(v)] = value;
  trail_.push_back(v);
  return true;
}

bool ProofChecker::propagate() {
  std::size_t before = 0;
  do {
    for (; n_followed_ < trail_.size(); ++n_followed_)
      for (const std::size_t c : constraints_of_[index(trail_[n_followed_])])
        if (!visit(constraints_[c])) return false;
    before = trail_.size();
    for (std::size_t i = 0; i < problem_.n_sides(); ++i)
      if (!visit_sides(problem_.sides(i))) return false;
  } while (trail_.size() > before);
  return true;
}

// Each gives the values that a constraint forces; false on a contradiction.
bool ProofChecker::visit(const Constraint& constraint) {
  const auto& [kind, row] = constraint;
  if (kind == ConstraintKind::Pair)
    return visit_none_or_two(problem_.pair(row));
  if (kind == ConstraintKind::Clause) return visit_clause(clauses_[row]);
  if (kind == ConstraintKind::Linear) return visit_linear(linear_[row]);
  return visit_ring(problem_.ring(row), problem_.is_optional(row));
}

bool ProofChecker::visit_none_or_two(std::span<const VarId> vars) {
  int n_open = 0, n_true = 0;
  for (const VarId v : vars) {
    if (is_open(v)) ++n_open;
    if (is_true(v)) ++n_true;
  }
  if (n_true > 2 || (n_true == 1 && n_open == 0)) return false;
  if (n_open == 1 || n_true == 2)
    for (const VarId v : vars)
      if (is_open(v)) set(v, n_true == 1);
  return true;
}

bool ProofChecker::visit_ring(std::span<const Spoke> spokes, bool optional) {
  std::map<std::uint32_t, std::vector<VarId>> at_node;
  std::vector<Literal> some_spoke;
  for (const Spoke& s : spokes) {
    at_node[s.a].push_back(s.var);
    at_node[s.b].push_back(s.var);
    some_spoke.emplace_back(s.var, true);
  }
  const std::size_t before = trail_.size();
  for (const auto& [node, vars] : at_node)
    if (!visit_none_or_two(vars)) return false;
  if (trail_.size() > before) return true;  // a new value: it is visited again
  return (optional || visit_clause(some_spoke)) && visit_cycles(spokes);
}

// No node has more than two true spokes, so a path cannot run into itself.
bool ProofChecker::visit_cycles(std::span<const Spoke> spokes) {
  for (const Spoke& start : spokes) {
    if (!is_true(start.var)) continue;
    std::vector<VarId> path = {start.var};
    std::uint32_t node = start.b;
    while (node != start.a) {
      const auto next = std::ranges::find_if(spokes, [&](const Spoke& s) {
        return (s.a == node || s.b == node) && is_true(s.var) &&
               s.var != path.back();
      });
      if (next == spokes.end()) break;
      path.push_back(next->var);
      node ^= next->a ^ next->b;
    }
    if (node != start.a) continue;
    for (const Spoke& s : spokes)
      if (std::ranges::find(path, s.var) == path.end() && !set(s.var, false))
        return false;
  }
  return true;
}

bool ProofChecker::visit_clause(std::span<const Literal> clause) {
  std::optional<Literal> last;
  for (const Literal l : clause) {
    if (holds(l)) return true;
    if (!is_open(l.var())) continue;
    if (last && *last != l) return true;
    last = l;
  }
  return last && set(last->var(), last->value());
}

bool ProofChecker::visit_linear(const Linear& linear) {
  std::int64_t left = linear.bound;  // by the least possible sum
  for (const auto& [var, a] : linear.terms)
    if (is_open(var) ? a < 0 : is_true(var)) left -= a;
  if (left < 0) return false;
  for (const auto& [var, a] : linear.terms)
    if (is_open(var) && std::abs(a) > left) set(var, a < 0);
  return true;
}

// Two nodes for each room, as it lies on either side; a wall with a value joins
// what agrees with it.
bool ProofChecker::visit_sides(std::span<const Wall> walls) {
  std::vector<std::size_t> parent(4 * walls.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const Wall& w : walls) {
    const std::size_t flip = is_true(w.var) != w.inverted ? 1 : 0;
    for (const std::size_t side : {0, 1})
      if (!is_open(w.var))
        parent[root(2 * std::size_t{w.a} + side)] =
            root(2 * std::size_t{w.b} + (side ^ flip));
  }
  for (const Wall& w : walls) {
    const std::size_t a = root(2 * std::size_t{w.a});
    if (a == root(2 * std::size_t{w.a} + 1)) return false;
    for (const std::size_t flip : {0, 1})
      if (a == root(2 * std::size_t{w.b} + flip) &&
          !set(w.var, (flip == 1) != w.inverted))
        return false;
  }
  return true;
}

}  // namespace ilp
