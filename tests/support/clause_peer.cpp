#include "tests/support/clause_peer.h"

#include <algorithm>
#include <cadical.hpp>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "ilp/linear_form.h"

namespace support {
namespace {

using ilp::Cycle;
using ilp::LinearForm;
using ilp::LinearRow;
using ilp::Literal;
using ilp::Minimum;
using ilp::Model;
using ilp::Problem;
using ilp::Status;
using ilp::Term;
using ilp::VarId;

class Clock : public CaDiCaL::Terminator {
 public:
  explicit Clock(double seconds) : seconds_(seconds) {}
  bool terminate() override {
    const std::chrono::duration<double> passed = Steady::now() - start_;
    return passed.count() > seconds_;
  }

 private:
  using Steady = std::chrono::steady_clock;
  double seconds_;
  Steady::time_point start_ = Steady::now();
};

class ClausePeer {
 public:
  ClausePeer(const Problem& problem, const ilp::Limits& limits)
      : problem_(problem),
        clock_(limits.seconds),
        max_conflicts_(static_cast<int>(
            std::min<std::uint64_t>(limits.conflicts, 1U << 30U))),
        form_(linear_form(problem)) {
    n_variables_ = static_cast<int>(form_.n_variables);
    solver_.set("quiet", 1);
    solver_.set("phase", 0);  // false first, as in our own search
    // Tries of all-false and the like never close a hole. Without them medians
    // at 100 vertices fall by up to three quarters.
    solver_.set("lucky", 0);
    solver_.connect_terminator(&clock_);
    std::vector<LinearRow> both;
    for (const LinearRow& row : form_.rows) {
      both.push_back(row);
      if (row.is_equation) both.push_back(opposite(row));
    }
    for (const LinearRow& row : both)
      if (!write_clause(row) && !write_at_most_two(row)) write_sum(row);
  }
  ~ClausePeer() { solver_.disconnect_terminator(); }
  ClausePeer(const ClausePeer&) = delete;
  ClausePeer& operator=(const ClausePeer&) = delete;

  Minimum run() {
    for (;;) {
      solver_.limit("conflicts", max_conflicts_);
      const int answer = solver_.solve();
      if (answer == 20) return {Status::Infeasible, {}, 0};
      if (answer != 10) return {Status::Limit, {}, 0};
      Model model;
      for (std::uint32_t v = 0; v < problem_.n_variables(); ++v)
        model.push_back(is_true(VarId{v}));
      if (!cut_cycles(model)) return {Status::Feasible, model, 0};
    }
  }

 private:
  static int number(VarId v) { return static_cast<int>(index(v)) + 1; }
  bool is_true(VarId v) {
    return number(v) <= solver_.vars() && solver_.val(number(v)) > 0;
  }

  static LinearRow opposite(LinearRow row) {
    for (Term& t : row.terms) t.coefficient = -t.coefficient;
    row.bound = -row.bound;
    return row;
  }

  void add(const std::vector<int>& clause) {
    for (const int l : clause) solver_.add(l);
    solver_.add(0);
  }

  // What the row lacks if all its literals fail.
  static std::int64_t degree(const LinearRow& row) {
    std::int64_t d = row.bound;
    for (const Term& t : row.terms)
      if (t.coefficient < 0) d -= t.coefficient;
    return d;
  }

  static int helping(const Term& t) {
    return t.coefficient > 0 ? number(t.var) : -number(t.var);
  }

  bool write_clause(const LinearRow& row) {
    const std::int64_t d = degree(row);
    if (d <= 0) return true;
    std::vector<int> clause;
    for (const Term& t : row.terms) {
      if (t.coefficient == 0) continue;
      if (std::abs(t.coefficient) < d) return false;
      clause.push_back(helping(t));
    }
    add(clause);
    return true;
  }

  bool write_at_most_two(const LinearRow& row) {
    if (row.bound != -2 || row.terms.size() > 60 ||
        std::ranges::any_of(row.terms,
                            [](const Term& t) { return t.coefficient != -1; }))
      return false;
    for (std::size_t i = 0; i < row.terms.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k)
          add({helping(row.terms[i]), helping(row.terms[j]),
               helping(row.terms[k])});
    return true;
  }

  // A decision diagram: node (i, s) says that the terms from i on may weigh no
  // more than s, in weights of literals that fail the row.
  void write_sum(const LinearRow& row) {
    std::int64_t slack = -degree(row);
    for (const Term& t : row.terms) slack += std::abs(t.coefficient);
    std::map<std::pair<std::size_t, std::int64_t>, int> nodes;
    add({node(row, 0, slack, nodes)});
  }

  int node(const LinearRow& row, std::size_t i, std::int64_t slack,
           std::map<std::pair<std::size_t, std::int64_t>, int>& nodes) {
    const auto [found, is_new] = nodes.try_emplace({i, slack}, 0);
    if (!is_new) return found->second;
    const int self = ++n_variables_;
    found->second = self;
    if (slack < 0) add({-self});
    if (slack < 0 || i == row.terms.size()) return self;
    const Term& t = row.terms[i];
    const std::int64_t weight = std::abs(t.coefficient);
    add({-self, node(row, i + 1, slack, nodes)});
    add({-self, helping(t), node(row, i + 1, slack - weight, nodes)});
    return self;
  }

  bool cut_cycles(const Model& model) {
    const std::vector<Cycle> excess = excess_cycles(problem_, model);
    for (const Cycle& cycle : excess) {
      std::vector<int> clause;
      for (const VarId v : cycle.spokes) clause.push_back(-number(v));
      for (const ilp::Spoke& s : problem_.ring(cycle.ring)) {
        if (std::ranges::find(cycle.spokes, s.var) != cycle.spokes.end())
          continue;
        clause.push_back(-number(s.var));
        add(clause);
        clause.pop_back();
      }
    }
    return !excess.empty();
  }

  const Problem& problem_;
  Clock clock_;
  int max_conflicts_;
  LinearForm form_;
  int n_variables_ = 0;
  CaDiCaL::Solver solver_;
};

}  // namespace

Minimum solve_by_clauses(const Problem& problem, const ilp::Limits& limits) {
  return ClausePeer(problem, limits).run();
}

}  // namespace support
