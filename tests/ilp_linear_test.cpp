// What a linear constraint forces, against its definition, on random walks of
// decisions and retreats.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "ilp/propagate.h"

namespace {

using ilp::Assignment;
using ilp::Literal;
using ilp::Problem;
using ilp::Propagator;
using ilp::Term;
using ilp::VarId;

struct Row {
  std::vector<Term> terms;
  std::int64_t bound;
};

/// The least sum that the variables can still have.
template <class Holds>
std::int64_t least_sum(const Row& row, const Holds& holds) {
  std::int64_t sum = 0;
  for (const auto& [var, a] : row.terms) {
    if (holds(Literal(var, true))) sum += a;
    if (!holds(Literal(var, false)) && !holds(Literal(var, true)) && a < 0)
      sum += a;
  }
  return sum;
}

bool allows(const Row& row, const Assignment& values, Literal also) {
  return least_sum(row, [&](Literal l) {
           return l == also || (l != !also && values.holds(l));
         }) <= row.bound;
}

/// Whether the literals alone break the row.
bool breaks(const Row& row, const std::vector<Literal>& literals) {
  return least_sum(row, [&](Literal l) {
           return std::find(literals.begin(), literals.end(), l) !=
                  literals.end();
         }) > row.bound;
}

Row random_row(std::mt19937_64& rng, std::uint32_t n_variables) {
  Row row;
  std::int64_t sum = 0;
  for (std::uint32_t v = 0; v < n_variables; ++v) {
    const auto a = static_cast<std::int64_t>(rng() % 19) - 9;
    if (a == 0) continue;
    row.terms.push_back({VarId{v}, a});
    sum += a;
  }
  row.bound = sum / 2 + static_cast<std::int64_t>(rng() % 7) - 3;
  return row;
}

class Walk {
 public:
  Walk(const Problem& problem, const std::vector<Row>& rows,
       std::mt19937_64& rng)
      : rows_(rows), rng_(rng), propagator_(problem) {}

  void run(int n_steps) {
    bool is_sound = propagator_.propagate();
    for (int step = 0; step < n_steps; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      if (is_sound)
        expect_complete();
      else
        expect_conflict();
      const std::uint32_t n_levels = values().n_levels();
      if (!is_sound && n_levels == 0) return;
      if (!is_sound || !decide()) {
        if (n_levels == 0) return;
        propagator_.backtrack(static_cast<std::uint32_t>(rng_() % n_levels));
      }
      is_sound = propagator_.propagate();
    }
  }

 private:
  const Assignment& values() const { return propagator_.assignment(); }

  // An open variable may have either value; a forced one has its reason.
  void expect_complete() const {
    for (std::uint32_t v = 0; v < values().n_variables(); ++v)
      for (const bool value : {false, true}) {
        const Literal l(VarId{v}, value);
        if (!values().is_open(l.var())) continue;
        for (const Row& row : rows_) EXPECT_TRUE(allows(row, values(), l));
      }
    for (const Literal l : values().trail()) {
      const ilp::Reason& reason = values().reason(l.var());
      if (reason.kind == ilp::Reason::Kind::None) continue;
      std::vector<Literal> why;
      propagator_.explain(l, why);
      for (const Literal w : why) {
        EXPECT_TRUE(values().holds(w));
        EXPECT_LT(values().position(w.var()), values().position(l.var()));
      }
      why.push_back(!l);
      EXPECT_TRUE(breaks(rows_[reason.index], why));
    }
  }

  void expect_conflict() const {
    const ilp::Conflict& conflict = propagator_.conflict();
    for (const Literal l : conflict.literals) EXPECT_TRUE(values().holds(l));
    EXPECT_TRUE(breaks(rows_[conflict.reason.index], conflict.literals));
  }

  // Decides some open variable. @return whether there is one
  bool decide() {
    std::vector<VarId> open;
    for (std::uint32_t v = 0; v < values().n_variables(); ++v)
      if (values().is_open(VarId{v})) open.push_back(VarId{v});
    if (open.empty()) return false;
    propagator_.open_level();
    propagator_.decide(Literal(open[rng_() % open.size()], rng_() % 2 == 0));
    return true;
  }

  const std::vector<Row>& rows_;
  std::mt19937_64& rng_;
  Propagator propagator_;
};

TEST(Linears, ForceAllThatWouldBreakThem) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    constexpr std::uint32_t kVariables = 8;
    Problem problem;
    problem.add_variables(kVariables);
    std::vector<Row> rows;
    for (int i = 0; i < 1 + trial % 3; ++i) {
      rows.push_back(random_row(rng, kVariables));
      problem.add_linear(rows.back().terms, rows.back().bound);
    }
    Walk(problem, rows, rng).run(40);
  }
}

}  // namespace
