#include "ilp/linear_form.h"

#include <algorithm>
#include <iterator>

#include "ilp/links.h"

namespace ilp {
namespace {

class Writer {
 public:
  explicit Writer(const Problem& problem) : problem_(problem) {
    form_.n_variables = problem.n_variables();
  }

  LinearForm run(std::span<const Cycle> cycles) {
    for (const Literal l : problem_.fixed())
      add({{l.var(), 1}}, l.value() ? 1 : 0, true);
    const Links links = link(problem_);  // with those that rings imply
    for (std::size_t i = 0; i < links.pairs.size(); ++i)
      add_pair(links.pairs[i]);
    for (std::size_t i = 0; i < problem_.n_rings(); ++i)
      if (!problem_.is_optional(i)) add_some_spoke(problem_.ring(i));
    for (const Cycle& cycle : cycles) add_cycle(cycle);
    for (std::size_t i = 0; i < problem_.n_sides(); ++i)
      add_sides(problem_.sides(i));
    for (std::size_t i = 0; i < problem_.n_clauses(); ++i)
      add_clause(problem_.clause(i));
    for (std::size_t i = 0; i < problem_.n_linear(); ++i)
      add_at_most(problem_.linear(i), problem_.bound(i));
    return std::move(form_);
  }

 private:
  void add(std::vector<Term> terms, std::int64_t bound,
           bool is_equation = false) {
    form_.rows.push_back({std::move(terms), bound, is_equation});
  }

  void add_at_most(std::span<const Term> terms, std::int64_t bound) {
    std::vector<Term> opposite;
    for (const Term& t : terms) opposite.push_back({t.var, -t.coefficient});
    add(std::move(opposite), -bound);
  }

  // (3), and (4): each variable needs another.
  void add_pair(std::span<const VarId> vars) {
    std::vector<Term> terms;
    for (const VarId v : vars) terms.push_back({v, -1});
    if (vars.size() > 2) add(terms, -2);
    for (Term& t : terms) t.coefficient = 1;
    for (Term& t : terms) {
      t.coefficient = -1;
      add(terms, 0);
      t.coefficient = 1;
    }
  }

  void add_some_spoke(std::span<const Spoke> spokes) {
    std::vector<Term> terms;
    for (const Spoke& s : spokes) terms.push_back({s.var, 1});
    add(std::move(terms), 1);
  }

  void add_cycle(const Cycle& cycle) {
    std::vector<Term> terms;
    for (const VarId v : cycle.spokes) terms.push_back({v, -1});
    const auto length = static_cast<std::int64_t>(cycle.spokes.size());
    for (const Spoke& s : problem_.ring(cycle.ring)) {
      if (std::ranges::find(cycle.spokes, s.var) != cycle.spokes.end())
        continue;
      terms.push_back({s.var, -1});
      add(terms, -length);
      terms.pop_back();
    }
  }

  // x = (a != b), or its opposite: a clause for each way to place two rooms.
  void add_sides(std::span<const Wall> walls) {
    std::uint32_t n_rooms = 0;
    for (const Wall& w : walls) n_rooms = std::max({n_rooms, w.a + 1, w.b + 1});
    const auto first = static_cast<std::uint32_t>(form_.n_variables);
    form_.n_variables += n_rooms;
    for (const Wall& w : walls) {
      const VarId a{first + w.a}, b{first + w.b};
      const bool differ = !w.inverted;
      if (a == b) {
        add({{w.var, 1}}, w.inverted ? 1 : 0, true);
        continue;
      }
      for (const bool side_a : {false, true})
        for (const bool side_b : {false, true})
          add_clause(
              std::vector<Literal>{Literal(w.var, (side_a != side_b) == differ),
                                   Literal(a, !side_a), Literal(b, !side_b)});
    }
  }

  // Literals of one variable add up: x or not x always holds.
  void add_clause(std::span<const Literal> literals) {
    std::vector<Literal> sorted(literals.begin(), literals.end());
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<Term> terms;
    std::int64_t bound = 1;
    for (const Literal l : sorted) {
      if (!terms.empty() && terms.back().var == l.var()) return;
      terms.push_back({l.var(), l.value() ? 1 : -1});
      if (!l.value()) --bound;
    }
    add(std::move(terms), bound);
  }

  const Problem& problem_;
  LinearForm form_;
};

// The cycles that the spokes form, each node having two.
std::vector<std::vector<VarId>> cycles_of(std::vector<Spoke> spokes) {
  std::vector<std::vector<VarId>> cycles;
  while (!spokes.empty()) {
    std::uint32_t node = spokes.back().a;
    cycles.emplace_back();
    for (;;) {
      const auto next = std::ranges::find_if(spokes, [node](const Spoke& s) {
        return s.a == node || s.b == node;
      });
      if (next == spokes.end()) break;
      node = next->a == node ? next->b : next->a;
      cycles.back().push_back(next->var);
      spokes.erase(next);
    }
  }
  return cycles;
}

}  // namespace

LinearForm linear_form(const Problem& problem, std::span<const Cycle> cycles) {
  return Writer(problem).run(cycles);
}

std::vector<Cycle> excess_cycles(const Problem& problem, const Model& model) {
  std::vector<Cycle> excess;
  std::vector<Spoke> spokes;
  for (std::uint32_t r = 0; r < problem.n_rings(); ++r) {
    spokes.clear();
    std::ranges::copy_if(
        problem.ring(r), std::back_inserter(spokes),
        [&model](const Spoke& s) { return model[index(s.var)]; });
    auto cycles = cycles_of(spokes);
    if (cycles.size() < 2) continue;
    std::ranges::stable_sort(cycles, {}, &std::vector<VarId>::size);
    cycles.pop_back();
    for (auto& cycle : cycles) excess.push_back({r, std::move(cycle)});
  }
  return excess;
}

}  // namespace ilp
