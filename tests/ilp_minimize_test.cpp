#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "ilp/minimize.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"

namespace {

using ilp::Minimum;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using ilp::Term;
using ilp::VarId;

std::int64_t sum_of(const std::vector<Term>& terms, const Model& model) {
  std::int64_t sum = 0;
  for (const Term& t : terms)
    if (model[index(t.var)]) sum += t.coefficient;
  return sum;
}

std::optional<std::int64_t> least_sum(const Problem& problem,
                                      const std::vector<Term>& terms) {
  std::optional<std::int64_t> least;
  Model model(problem.n_variables());
  for (std::uint32_t bits = 0; bits < 1U << model.size(); ++bits) {
    for (std::size_t v = 0; v < model.size(); ++v)
      model[v] = (bits >> v & 1U) != 0;
    const std::int64_t sum = sum_of(terms, model);
    if ((!least || sum < *least) && first_violation(problem, model).empty())
      least = sum;
  }
  return least;
}

std::vector<Term> random_weights(std::mt19937_64& rng, std::size_t n,
                                 std::int64_t range) {
  std::vector<Term> terms;
  for (const VarId v : support::random_order(rng, n))
    if (rng() % 5 != 0)
      terms.push_back({v, static_cast<std::int64_t>(rng()) % (range + 1)});
  return terms;
}

void expect_minimum(const Problem& problem, const std::vector<Term>& terms) {
  Solver solver(problem);
  support::CheckedLog checked(problem, terms);
  solver.set_log(checked.log());
  const Minimum found = minimize_sum(solver, terms);
  const auto least = least_sum(problem, terms);
  ASSERT_EQ(found.status, least ? Status::Optimal : Status::Infeasible);
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_TRUE(checked.checker().is_refuted());
  EXPECT_EQ(checked.checker().best(), least);
  if (!least) return;
  EXPECT_EQ(found.sum, *least);
  EXPECT_EQ(sum_of(terms, found.model), *least);
  EXPECT_EQ(first_violation(problem, found.model), "");
}

TEST(MinimizeSum, FindsAndProvesTheLeastSum) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    for (const Problem& problem : {support::random_program(rng, 10),
                                   support::random_surface_program(rng, 12)}) {
      const std::int64_t range = trial % 2 == 0 ? 5 : std::int64_t{1} << 50U;
      expect_minimum(problem,
                     random_weights(rng, problem.n_variables(), range));
    }
    if (HasFailure()) return;
  }
}

// Each report is better than the last; a limit keeps the last.
TEST(MinimizeSum, ReportsBetterAndBetterModels) {
  const Problem problem = support::torus_hole(6, 6, 1);
  std::mt19937_64 rng(2);
  const auto terms = random_weights(rng, problem.n_variables(), 1000);
  Solver complete(problem);
  std::vector<std::int64_t> sums;
  const Minimum least = minimize_sum(
      complete, terms, {}, [&](const Model& model, std::int64_t sum) {
        EXPECT_EQ(first_violation(problem, model), "");
        EXPECT_EQ(sum_of(terms, model), sum);
        sums.push_back(sum);
      });
  ASSERT_EQ(least.status, Status::Optimal);
  ASSERT_GE(sums.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(sums, std::ranges::greater{}));
  EXPECT_EQ(std::ranges::adjacent_find(sums), sums.end());
  EXPECT_EQ(sums.back(), least.sum);

  Solver limited(problem);
  const std::uint64_t conflicts = complete.statistics().conflicts - 1;
  const Minimum some = minimize_sum(limited, terms, {.conflicts = conflicts});
  EXPECT_EQ(some.status, Status::Feasible);
  EXPECT_GE(some.sum, least.sum);
  EXPECT_EQ(limited.statistics().conflicts, conflicts);
}

TEST(MinimizeSum, OfNothingIsZero) {
  Problem problem;
  problem.add_variables(3);
  Solver solver(problem);
  const Minimum found = minimize_sum(solver, {});
  EXPECT_EQ(found.status, Status::Optimal);
  EXPECT_EQ(found.sum, 0);
}

}  // namespace
