#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "ilp/improve.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"

namespace {

using ilp::Improvement;
using ilp::Limits;
using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using ilp::VarId;

// In the order alone, after few conflicts in it, and without.
constexpr std::array<std::uint64_t, 3> kInOrder = {1'000'000, 2, 0};

void expect_proof(support::CheckedLog& checked, const Improvement& found,
                  const std::vector<VarId>& order) {
  EXPECT_EQ(checked.first_flaw(), "");
  if (found.status == Status::Optimal) {
    EXPECT_TRUE(checked.shows_least(found.model, order));
  } else {
    EXPECT_TRUE(checked.checker().is_refuted());
  }
}

void expect_least(Solver& solver, support::CheckedLog& checked,
                  const Problem& problem, const std::vector<VarId>& order) {
  const auto least = support::least_model(problem, order);
  for (const std::uint64_t in_order : kInOrder) {
    const Improvement found = minimize_worst_first(solver, order, {}, in_order);
    ASSERT_EQ(found.status, least ? Status::Optimal : Status::Infeasible);
    EXPECT_EQ(found.n_proven, least ? order.size() : 0);
    EXPECT_EQ(found.model, least.value_or(Model{}));
    expect_proof(checked, found, order);
  }
}

TEST(MinimizeWorstFirst, FindsTheLeastModelOfEnumeration) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    for (const Problem& problem : {support::random_surface_program(rng, 12),
                                   support::random_program(rng, 10)}) {
      Solver solver(problem);
      support::CheckedLog checked(problem);
      solver.set_log(checked.log());
      const std::size_t n = problem.n_variables();
      for (int k = 0; k < 2; ++k)
        expect_least(solver, checked, problem, support::random_order(rng, n));
    }
    if (HasFailure()) return;
  }
}

// Each way by a solver that has learned nothing by another.
TEST(MinimizeWorstFirst, FindsTheLeastModelByEachWayAlone) {
  std::mt19937_64 rng(20261123);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = support::torus_hole(5, 6, rng());
    const auto order = support::random_order(rng, problem.n_variables());
    std::vector<Improvement> found;
    for (const std::uint64_t in_order : kInOrder) {
      Solver solver(problem);
      support::CheckedLog checked(problem);
      solver.set_log(checked.log());
      found.push_back(minimize_worst_first(solver, order, {}, in_order));
      ASSERT_EQ(found.back().status, Status::Optimal);
      EXPECT_EQ(found.back().model, found.front().model);
      expect_proof(checked, found.back(), order);
    }
  }
}

// Hundreds of levels deep, where a conflict may owe to the first of them only.
TEST(MinimizeWorstFirst, FindsTheLeastModelOfADeepSearch) {
  const Problem problem = support::torus_hole(8, 12, 4);
  std::mt19937_64 rng(9);
  const auto order = support::random_order(rng, problem.n_variables());
  std::vector<Improvement> found;
  for (const std::uint64_t in_order : kInOrder) {
    Solver solver(problem);
    found.push_back(minimize_worst_first(solver, order, {}, in_order));
    ASSERT_EQ(found.back().status, Status::Optimal);
    EXPECT_EQ(first_violation(problem, found.back().model), "");
    EXPECT_EQ(found.back().model, found.front().model);
    EXPECT_GT(solver.statistics().conflicts, 100U);
  }
}

TEST(MinimizeWorstFirst, FindsTheLeastModelAfterEachCut) {
  std::mt19937_64 rng(5);
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Problem problem = support::random_surface_program(rng, 12);
    const auto order = support::random_order(rng, problem.n_variables());
    Solver solver(problem);
    support::CheckedLog checked(problem);
    solver.set_log(checked.log());
    while (const auto least = support::least_model(problem, order)) {
      expect_least(solver, checked, problem, order);
      std::vector<Literal> cut;
      for (const VarId v : order)
        if (rng() % 2 == 0) cut.emplace_back(v, !(*least)[index(v)]);
      problem.add_clause(cut);
      solver.add_clause(cut);
    }
    expect_least(solver, checked, problem, order);
    if (HasFailure()) return;
  }
}

TEST(MinimizeWorstFirst, CountsNothingButTheVariablesOfTheOrder) {
  std::mt19937_64 rng(11);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = support::random_surface_program(rng, 12);
    auto order = support::random_order(rng, problem.n_variables());
    const auto least = support::least_model(problem, order);
    if (!least) continue;
    order.resize(order.size() / 2);
    for (const std::uint64_t in_order : kInOrder) {
      Solver solver(problem);
      const auto found = minimize_worst_first(solver, order, {}, in_order);
      ASSERT_EQ(found.status, Status::Optimal);
      for (const VarId v : order)
        EXPECT_EQ(found.model[index(v)], (*least)[index(v)]);
    }
  }
}

// Whatever the limit, what is called proven agrees with the least model, and
// more conflicts never prove less.
TEST(MinimizeWorstFirst, KeepsTheBestModelAtALimit) {
  const Problem problem = support::torus_hole(7, 12, 2);
  std::mt19937_64 rng(3);
  const auto order = support::random_order(rng, problem.n_variables());
  Solver complete(problem);
  support::CheckedLog checked(problem);
  complete.set_log(checked.log());
  const Improvement least = minimize_worst_first(complete, order);
  ASSERT_EQ(least.status, Status::Optimal);
  expect_proof(checked, least, order);
  ASSERT_EQ(first_violation(problem, least.model), "");

  std::size_t n_feasible = 0;
  for (std::uint64_t conflicts = 0; conflicts < 400; conflicts += 10) {
    SCOPED_TRACE(testing::Message() << conflicts << " conflicts");
    Solver solver(problem);
    const Improvement found =
        minimize_worst_first(solver, order, {.conflicts = conflicts}, 0);
    EXPECT_LE(solver.statistics().conflicts, conflicts);
    if (found.status == Status::Limit) continue;
    if (found.status == Status::Feasible) ++n_feasible;
    EXPECT_EQ(first_violation(problem, found.model), "");
    for (std::size_t i = 0; i < found.n_proven; ++i)
      EXPECT_EQ(found.model[index(order[i])], least.model[index(order[i])]);
  }
  EXPECT_GT(n_feasible, 0U) << "no limit fell between";
}

}  // namespace
