#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ilp/problem.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Spoke;
using ilp::Term;
using ilp::VarId;
using ilp::Wall;

constexpr VarId kX{0}, kY{1}, kZ{2}, kU{3}, kV{4}, kW{5};

Problem with_variables(std::size_t n) {
  Problem problem;
  problem.add_variables(n);
  return problem;
}

TEST(FirstViolation, OfAPairIsOneOrThreeTrue) {
  Problem problem = with_variables(3);
  problem.add_pair(std::array{kX, kY, kZ});
  EXPECT_EQ(first_violation(problem, {false, false, false}), "");
  EXPECT_EQ(first_violation(problem, {true, false, true}), "");
  EXPECT_EQ(first_violation(problem, {false, true, false}), "pair 0");
  EXPECT_EQ(first_violation(problem, {true, true, true}), "pair 0");
}

TEST(FirstViolation, OfARingIsAllButOneSimpleCycle) {
  // Triangles 0 1 2 and 2 3 4, which share a node.
  const std::array<Spoke, 6> spokes = {Spoke{kX, 0, 1}, {kY, 1, 2}, {kZ, 2, 0},
                                       {kU, 2, 3},      {kV, 3, 4}, {kW, 4, 2}};
  Problem required = with_variables(6), optional = with_variables(6);
  required.add_ring(spokes);
  optional.add_ring(spokes, true);
  const Model none(6, false), all(6, true);
  const Model one = {true, true, true, false, false, false};
  const Model open = {true, true, false, false, false, false};
  EXPECT_EQ(first_violation(required, none), "ring 0");
  EXPECT_EQ(first_violation(optional, none), "");
  for (const Problem& problem : {required, optional}) {
    EXPECT_EQ(first_violation(problem, one), "");
    EXPECT_EQ(first_violation(problem, all), "ring 0");
    EXPECT_EQ(first_violation(problem, open), "ring 0");
  }
}

TEST(FirstViolation, OfARingIsTwoDisjointCycles) {
  Problem problem = with_variables(4);
  problem.add_ring(std::array<Spoke, 4>{
      Spoke{kX, 0, 1}, {kY, 1, 0}, {kZ, 2, 3}, {kU, 3, 2}});
  EXPECT_EQ(first_violation(problem, {true, true, false, false}), "");
  EXPECT_EQ(first_violation(problem, {true, true, true, true}), "ring 0");
}

TEST(FirstViolation, OfSidesIsAnOddCycleOfWalls) {
  Problem problem = with_variables(3);
  problem.add_sides(
      std::array{Wall{kX, 0, 1}, Wall{kY, 1, 2}, Wall{kZ, 2, 0, true}});
  EXPECT_EQ(first_violation(problem, {false, false, true}), "");
  EXPECT_EQ(first_violation(problem, {true, false, false}), "");
  EXPECT_EQ(first_violation(problem, {false, false, false}), "sides 0");
  EXPECT_EQ(first_violation(problem, {true, false, true}), "sides 0");
}

TEST(FirstViolation, OfALinearConstraintIsASumAboveItsBound) {
  Problem problem = with_variables(3);
  problem.add_linear(std::array{Term{kX, 3}, Term{kY, -2}, Term{kZ, 1}}, 1);
  EXPECT_EQ(first_violation(problem, {false, false, true}), "");
  EXPECT_EQ(first_violation(problem, {true, true, false}), "");
  EXPECT_EQ(first_violation(problem, {true, true, true}), "linear 0");
  EXPECT_EQ(first_violation(problem, {true, false, false}), "linear 0");
}

TEST(FirstViolation, NamesClausesFixedVariablesAndSize) {
  Problem problem = with_variables(2);
  problem.add_clause(std::array{Literal(kX, true), Literal(kY, false)});
  EXPECT_EQ(first_violation(problem, {false, true}), "clause 0");
  EXPECT_EQ(first_violation(problem, {true, true}), "");
  problem.fix(kY, false);
  EXPECT_EQ(first_violation(problem, {true, true}), "fixed variable 1");
  EXPECT_NE(first_violation(problem, {true}), "");
}

TEST(Problem, RefusesWhatMakesNoSense) {
  Problem problem = with_variables(2);
  using Error = std::invalid_argument;
  EXPECT_THROW(problem.add_pair(std::array{kX, kX}), Error);
  EXPECT_THROW(problem.add_pair(std::array{kX, kZ}), Error);
  EXPECT_THROW(problem.add_ring(std::array{Spoke{kX, 1, 1}}), Error);
  EXPECT_THROW(problem.add_ring(std::array{Spoke{kX, 0, 2}}), Error);
  EXPECT_THROW(problem.add_ring_of_pairs(std::array{Spoke{kX, 0, 1}}), Error);
  EXPECT_THROW(problem.add_sides(std::array{Wall{kX, 0, 2}}), Error);
  EXPECT_THROW(problem.add_clause(std::array{Literal(kZ, true)}), Error);
  EXPECT_THROW(problem.add_linear(std::array{Term{kZ, 1}}, 0), Error);
  EXPECT_THROW(problem.add_linear(std::array{Term{kX, 1}, Term{kX, 1}}, 0),
               Error);
  EXPECT_THROW(problem.fix(kZ, true), Error);
  EXPECT_EQ(problem.n_pairs() + problem.n_rings() + problem.n_sides() +
                problem.n_clauses() + problem.n_linear() +
                problem.fixed().size(),
            0U);
}

TEST(Problem, RefusesMoreVariablesThanItCanNumber) {
  Problem problem = with_variables(3);
  EXPECT_THROW(problem.add_variables(ilp::kMaxVariables - 2),
               std::length_error);
  EXPECT_THROW(problem.add_variables(std::numeric_limits<std::size_t>::max()),
               std::length_error);
  EXPECT_EQ(problem.n_variables(), 3U);
}

// Pairs of x y, of y z and of x z, and of all three.
TEST(Problem, RefusesRingsWhosePairsHaveOtherVariables) {
  Problem problem = with_variables(4);
  problem.add_pair(std::array{kX, kY});
  problem.add_pair(std::array{kZ, kY});
  problem.add_pair(std::array{kX, kZ});
  problem.add_pair(std::array{kX, kY, kZ});
  const std::array<Spoke, 3> right = {Spoke{kY, 0, 1}, {kX, 2, 0}, {kZ, 1, 2}};
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::uint32_t wrong : {0U, 1U, 2U, 3U}) {
      std::array<Spoke, 3> spokes = right;
      if (wrong == right[i].a || wrong == right[i].b) continue;
      spokes[i].b = wrong;
      EXPECT_THROW(problem.add_ring_of_pairs(spokes), std::invalid_argument);
    }
  std::array<Spoke, 3> spokes = right;
  spokes[0].var = kU;
  EXPECT_THROW(problem.add_ring_of_pairs(spokes), std::invalid_argument);
  EXPECT_THROW(problem.add_ring_of_pairs(std::span(right).first(2)),
               std::invalid_argument);
  EXPECT_EQ(problem.n_rings(), 0U);
  EXPECT_EQ(problem.add_ring_of_pairs(right).index, 0U);
  EXPECT_TRUE(problem.is_of_pairs(0));
}

TEST(Problem, RefusesLinearConstraintsThatMightOverflow) {
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  Problem problem = with_variables(2);
  const auto add = [&problem](std::int64_t a, std::int64_t b) {
    problem.add_linear(std::array{Term{kX, a}, Term{kY, a}}, b);
  };
  constexpr std::int64_t kQuarter = ilp::kMaxLinearSum / 4;
  EXPECT_NO_THROW(add(kQuarter, 2 * kQuarter));
  EXPECT_NO_THROW(add(-kQuarter, -2 * kQuarter));
  EXPECT_THROW(add(kQuarter, 2 * kQuarter + 1), std::invalid_argument);
  EXPECT_THROW(add(kMin, 0), std::invalid_argument);
  EXPECT_THROW(add(0, kMin), std::invalid_argument);
  EXPECT_EQ(problem.n_linear(), 2U);
}

// The boundary of a 4-simplex: ten triangles between five cells. Cell i lacks
// vertex i, so triangle a b c lies between the two cells of the other vertices.
TEST(Problem, SidesFollowFromPairsWhereCellsFillASphere) {
  const std::vector<support::Triangle> triangles = support::all_triangles(5);
  const std::array<std::uint32_t, 5> optional = {0, 1, 2, 3, 4};
  const Problem plain = support::surface_program(triangles, optional);
  std::vector<Wall> walls;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    std::vector<std::uint32_t> cells;
    for (std::uint32_t v = 0; v < 5; ++v)
      if (std::ranges::find(triangles[t], v) == triangles[t].end())
        cells.push_back(v);
    walls.push_back({VarId{t}, cells[0], cells[1]});
  }
  Problem with_sides = plain;
  with_sides.add_sides(walls);

  int n_models = 0;
  for (unsigned bits = 0; bits < 1U << 10U; ++bits) {
    Model model;
    for (unsigned t = 0; t < 10; ++t) model.push_back((bits >> t & 1U) != 0);
    if (!first_violation(plain, model).empty()) continue;
    EXPECT_EQ(first_violation(with_sides, model), "") << "model " << bits;
    ++n_models;
  }
  EXPECT_EQ(n_models, 16);  // nothing, 5 single cells, 10 joined pairs
}

}  // namespace
