#include <gtest/gtest.h>

#include <random>
#include <string>

#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using ilp::VarId;

using Generator = Problem (*)(std::mt19937_64&, std::uint32_t);

// solve() finds a model exactly where enumeration does.
void expect_agrees_with_enumeration(const Problem& problem,
                                    std::mt19937_64& rng) {
  const auto order = support::random_order(rng, problem.n_variables());
  const bool has_model = support::least_model(problem, order).has_value();
  Solver solver(problem);
  solver.set_priority(order);
  const Status status = solver.solve();
  ASSERT_EQ(status, has_model ? Status::Feasible : Status::Infeasible);
  if (has_model) {
    EXPECT_EQ(first_violation(problem, solver.model()), "");
  } else {
    const Problem core = support::part_of(problem, solver.core().constraints);
    EXPECT_FALSE(support::least_model(core, order)) << "core is feasible";
  }
}

class SolverOnRandomPrograms
    : public testing::TestWithParam<std::pair<const char*, Generator>> {};

TEST_P(SolverOnRandomPrograms, AgreesWithEnumeration) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_agrees_with_enumeration(GetParam().second(rng, 11), rng);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , SolverOnRandomPrograms,
    testing::Values(std::pair{"surfaces", &support::random_surface_program},
                    std::pair{"programs", &support::random_program}),
    [](const auto& instance) { return std::string(instance.param.first); });

}  // namespace
