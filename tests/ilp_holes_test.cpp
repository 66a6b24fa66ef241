// Holes cut into reconstructed surfaces, and what becomes of them when some
// triangles are forbidden or forced.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "ilp/baseline.h"
#include "ilp/improve.h"
#include "ilp/minimize.h"
#include "ilp/solver.h"
#include "tests/support/hole_programs.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"

namespace {

using ilp::Improvement;
using ilp::Minimum;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Status;
using ilp::Term;
using ilp::VarId;
using support::HoleMaker;
using support::HoleProgram;

const std::vector<HoleMaker>& shapes() {
  static const std::vector<HoleMaker> all = {
      HoleMaker({.name = "torus", .n_points = 300}),
      HoleMaker({.name = "cube", .n_points = 300}),
      HoleMaker({.name = "sphere", .n_points = 300, .noise = 0.3}),
      HoleMaker({.name = "plate", .n_points = 300})};
  return all;
}

TEST(Holes, AreClosedByTheTrianglesThatWereThere) {
  for (std::size_t s = 0; s < shapes().size(); ++s) {
    SCOPED_TRACE(testing::Message() << "shape " << s);
    ASSERT_TRUE(shapes()[s].is_closed());
    for (const std::size_t n : {5, 20, 80}) {
      for (const bool with_sides : {false, true}) {
        const HoleProgram hole = shapes()[s].hole(n, n, with_sides);
        EXPECT_LE(hole.n_vertices, n);
        EXPECT_GE(hole.n_vertices, 4U);
        EXPECT_EQ(first_violation(hole.problem, hole.old), "");
        Solver solver(hole.problem);
        const Improvement least =
            minimize_worst_first(solver, hole.worst_first);
        ASSERT_EQ(least.status, Status::Optimal);
        EXPECT_EQ(first_violation(hole.problem, least.model), "");
      }
    }
  }
}

// Sides say nothing new: with and without them the least model is the same.
TEST(Holes, HaveTheSameLeastModelWithSides) {
  for (std::size_t s = 0; s < shapes().size(); ++s)
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "shape " << s << " seed " << seed);
      const HoleProgram plain = shapes()[s].hole(40, seed);
      const HoleProgram sided = shapes()[s].hole(40, seed, true);
      Solver without(plain.problem), with(sided.problem);
      const auto least = minimize_worst_first(without, plain.worst_first);
      ASSERT_EQ(least.status, Status::Optimal);
      EXPECT_EQ(minimize_worst_first(with, sided.worst_first).model,
                least.model);
    }
}

std::vector<VarId> whole_order(const HoleProgram& hole) {
  std::vector<VarId> order = hole.worst_first;
  std::vector<bool> is_in(hole.problem.n_variables(), false);
  for (const VarId v : order) is_in[index(v)] = true;
  for (std::uint32_t v = 0; v < is_in.size(); ++v)
    if (!is_in[v]) order.push_back(VarId{v});
  return order;
}

// The least model of enumeration, proven, and the same by depth first.
void expect_least(const HoleProgram& hole) {
  const std::vector<VarId> order = whole_order(hole);
  const auto least = support::least_model(hole.problem, order);
  Solver solver(hole.problem);
  support::CheckedLog checked(hole.problem);
  solver.set_log(checked.log());
  const Improvement found = minimize_worst_first(solver, order);
  ASSERT_EQ(found.status, least ? Status::Optimal : Status::Infeasible);
  EXPECT_EQ(found.model, least.value_or(Model{}));
  EXPECT_EQ(checked.first_flaw(), "");
  if (least) {
    EXPECT_TRUE(checked.shows_least(*least, order));
  } else {
    EXPECT_TRUE(checked.checker().is_refuted());
  }
  const Minimum plain = depth_first(hole.problem, order);
  EXPECT_EQ(plain.model, least.value_or(Model{}));
  EXPECT_EQ(plain.status, least ? Status::Feasible : Status::Infeasible);
}

void expect_enumeration_agrees(int n_trials, std::size_t max_free) {
  std::mt19937_64 rng(20261122);
  int n_infeasible = 0, n_done = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const HoleMaker& shape = shapes()[rng() % shapes().size()];
    HoleProgram hole = shape.hole(3 + rng() % 8, rng());
    if (hole.worst_first.size() > max_free) continue;
    support::mutate(hole.problem, rng);
    expect_least(hole);
    ++n_done;
    Solver solver(hole.problem);
    if (solver.solve() == Status::Infeasible) ++n_infeasible;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(n_done, n_trials / 4);
  EXPECT_GT(n_infeasible, n_done / 10);
  EXPECT_LT(n_infeasible, n_done * 9 / 10);
}

TEST(Holes, AgreeWithEnumerationWhenMutated) {
  expect_enumeration_agrees(400, 12);
}

TEST(SlowHoles, AgreeWithEnumerationWhenMutated) {
  expect_enumeration_agrees(6000, 20);
}

TEST(Holes, HaveTheSameLeastAreaByDepthFirst) {
  std::mt19937_64 rng(3);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    HoleProgram hole = shapes()[rng() % shapes().size()].hole(10, rng());
    if (trial % 2 == 0) support::mutate(hole.problem, rng);
    std::vector<Term> area;
    for (std::uint32_t v = 0; v < hole.weights.size(); ++v)
      area.push_back({VarId{v}, hole.weights[v]});
    Solver solver(hole.problem);
    support::CheckedLog checked(hole.problem, area);
    solver.set_log(checked.log());
    const Minimum least = minimize_sum(solver, area);
    const Minimum plain = depth_first(hole.problem, hole.worst_first, area,
                                      {.conflicts = 20'000});
    EXPECT_EQ(checked.first_flaw(), "");
    EXPECT_TRUE(checked.checker().is_refuted());
    if (plain.status == Status::Feasible) continue;
    EXPECT_EQ(plain.status, least.status);
    EXPECT_EQ(plain.sum, least.sum);
  }
}

TEST(DepthFirst, StopsAtItsLimit) {
  const HoleProgram hole = shapes()[0].hole(30, 1);
  EXPECT_EQ(depth_first(hole.problem, hole.worst_first, {}, {.propagations = 3})
                .status,
            Status::Limit);
}

}  // namespace
