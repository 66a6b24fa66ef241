// The answers of CaDiCaL, another solver, on thousands of programs.

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "ilp/solver.h"
#include "tests/support/clause_peer.h"
#include "tests/support/hole_programs.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"

namespace {

using ilp::Minimum;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using support::HoleMaker;

Problem random_case(std::mt19937_64& rng,
                    const std::vector<HoleMaker>& shapes) {
  switch (rng() % 4) {
    case 0:
      return support::random_program(rng, 40);
    case 1:
      return support::random_surface_program(rng, 60);
    default:
      Problem problem = shapes[rng() % shapes.size()]
                            .hole(5 + rng() % 40, rng(), rng() % 2 == 0)
                            .problem;
      support::mutate(problem, rng);
      return problem;
  }
}

void expect_agreement(int n_trials, std::uint64_t seed) {
  const std::vector<HoleMaker> shapes = {
      HoleMaker({.name = "torus", .n_points = 300}),
      HoleMaker({.name = "cube", .n_points = 300}),
      HoleMaker({.name = "sphere", .n_points = 300, .noise = 0.5}),
      HoleMaker({.name = "two-spheres", .n_points = 400}),
      HoleMaker({.name = "plate", .n_points = 300})};
  constexpr std::uint64_t kConflicts = 1500;
  std::mt19937_64 rng(seed);
  int n_infeasible = 0, n_given_up = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = random_case(rng, shapes);
    Solver solver(problem);
    support::CheckedLog checked(problem);
    solver.set_log(checked.log());
    const Status status = solver.solve({}, {.conflicts = kConflicts});
    const Minimum peer =
        support::solve_by_clauses(problem, {.conflicts = kConflicts});
    if (status == Status::Limit || peer.status == Status::Limit) {
      ++n_given_up;
      continue;
    }
    ASSERT_EQ(status, peer.status);
    if (status == Status::Feasible) {
      EXPECT_EQ(first_violation(problem, solver.model()), "");
      EXPECT_EQ(first_violation(problem, peer.model), "");
    } else {
      ++n_infeasible;
      EXPECT_EQ(checked.first_flaw(), "");
      EXPECT_TRUE(checked.checker().is_refuted());
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(n_given_up, 0);
  EXPECT_GT(n_infeasible, n_trials / 10);
  EXPECT_LT(n_infeasible, n_trials * 9 / 10);
}

TEST(ClausePeer, AgreesOnSomePrograms) { expect_agreement(150, 1); }

TEST(SlowClausePeer, AgreesOnFiveThousandPrograms) {
  expect_agreement(5000, 20261122);
}

}  // namespace
