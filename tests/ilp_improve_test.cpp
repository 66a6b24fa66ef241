#include <gtest/gtest.h>

#include <random>

#include "ilp/improve.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Improvement;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using ilp::VarId;

void expect_least(const Problem& problem, std::mt19937_64& rng) {
  const auto order = support::random_order(rng, problem.n_variables());
  const auto least = support::least_model(problem, order);
  Solver solver(problem);
  const Improvement found = minimize_worst_first(solver, order);
  ASSERT_EQ(found.status, least ? Status::Optimal : Status::Infeasible);
  if (least) {
    EXPECT_EQ(found.model, *least);
  }
}

TEST(MinimizeWorstFirst, FindsTheLeastModelOfEnumeration) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_least(support::random_surface_program(rng, 12), rng);
    expect_least(support::random_program(rng, 10), rng);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
