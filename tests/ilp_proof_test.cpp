#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "ilp/minimize.h"
#include "ilp/proof.h"
#include "ilp/proof_check.h"
#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Literal;
using ilp::Problem;
using ilp::ProofChecker;
using ilp::ProofLog;
using ilp::Solver;
using ilp::Spoke;
using ilp::Status;
using ilp::Term;
using ilp::VarId;
using ilp::Wall;

constexpr VarId kX{0}, kY{1}, kZ{2};

Problem with_variables(std::size_t n) {
  Problem problem;
  problem.add_variables(n);
  return problem;
}

std::string flaw(ProofChecker& checker, const std::string& lines) {
  std::istringstream log(lines);
  return checker.first_flaw(log);
}

std::string flaw(const Problem& problem, const std::string& lines) {
  ProofChecker checker(problem);
  return flaw(checker, lines);
}

TEST(ProofChecker, FollowsEachKindOfConstraint) {
  Problem pair = with_variables(3);
  pair.add_pair(std::array{kX, kY, kZ});
  EXPECT_EQ(flaw(pair, "l -1 2 3 0\nl -1 -2 -3 0\n"), "");
  EXPECT_EQ(flaw(pair, "l -1 2 0\n"), "line 1: does not follow");

  Problem ring = with_variables(5);
  ring.add_ring(std::array{Spoke{kX, 0, 1}, Spoke{kY, 1, 2}, Spoke{kZ, 2, 0},
                           Spoke{VarId{3}, 3, 4}, Spoke{VarId{4}, 4, 3}});
  EXPECT_EQ(flaw(ring, "l -1 -4 0\n"), "");
  EXPECT_EQ(flaw(ring, "l 1 0\n"), "line 1: does not follow");

  // x gives a second spoke to two nodes of a third, w, in one go.
  Problem tangle = with_variables(6);
  tangle.add_ring(std::array{Spoke{kX, 0, 1}, Spoke{kY, 1, 2}, Spoke{kZ, 2, 3},
                             Spoke{VarId{3}, 3, 1}, Spoke{VarId{4}, 3, 4},
                             Spoke{VarId{5}, 4, 0}});
  EXPECT_EQ(flaw(tangle, "l -1 -2 -3 5 0\nl -1 -2 -4 0\nl -3 -4 2 0\n"), "");
  EXPECT_EQ(flaw(tangle, "l -1 -2 -3 -5 0\n"), "line 1: does not follow");

  Problem sides = with_variables(3);
  sides.add_sides(std::array{Wall{kX, 0, 1}, Wall{kY, 1, 2}, Wall{kZ, 2, 0}});
  EXPECT_EQ(flaw(sides, "l 1 2 -3 0\nl -1 -2 -3 0\n"), "");
  EXPECT_EQ(flaw(sides, "l 1 2 3 0\n"), "line 1: does not follow");

  Problem linear = with_variables(3);
  linear.add_linear(std::array{Term{kX, 3}, Term{kY, -2}, Term{kZ, 1}}, 1);
  EXPECT_EQ(flaw(linear, "l -1 2 0\nl -1 -3 0\n"), "");
  EXPECT_EQ(flaw(linear, "l -1 0\n"), "line 1: does not follow");

  Problem clause = with_variables(3);
  clause.add_clause(std::array{Literal(kX, true), Literal(kY, false)});
  EXPECT_EQ(flaw(clause, "l 1 -2 3 0\nl 1 3 0\n"), "line 2: does not follow");
}

// y follows from the first two clauses, not y from the others.
TEST(ProofChecker, UsesWhatWasDerivedUntilItIsRemoved) {
  Problem problem = with_variables(3);
  for (const bool y : {true, false})
    for (const bool other : {false, true})
      problem.add_clause(
          std::array{Literal(y ? kX : kZ, other), Literal(kY, y)});
  EXPECT_EQ(flaw(problem, "l 0\n"), "line 1: does not follow");
  EXPECT_EQ(flaw(problem, "l 2 0\nl 0\n"), "");
  EXPECT_EQ(flaw(problem, "d 2 1 0\nl 2 0\n"), "line 2: does not follow");
  EXPECT_EQ(flaw(problem, "d 1 3 0\n"), "line 1: removes what is not there");
  EXPECT_EQ(flaw(problem, "a -1 0\nl 0\n"), "");
  EXPECT_EQ(flaw(problem, "b 4 5 2 0\nl 0\n"), "");
  EXPECT_EQ(flaw(problem, "b 5 5 2 0\nl 0\n"), "line 2: does not follow");
}

TEST(ProofChecker, TakesOnlyModelsThatAreBetter) {
  Problem problem = with_variables(2);
  problem.add_clause(std::array{Literal(kX, true), Literal(kY, true)});
  const std::array sum = {Term{kX, 2}, Term{kY, 1}};
  ProofChecker checker(problem, sum);
  EXPECT_EQ(flaw(checker, "m -1 -2 0\n"), "line 1: no model: clause 0");
  EXPECT_EQ(flaw(checker, "m 1 2 0\n"), "");
  EXPECT_FALSE(checker.is_refuted());
  EXPECT_EQ(flaw(checker, "m 1 2 0\n"), "line 1: breaks a bound before");
  EXPECT_EQ(flaw(checker, "l 0\n"), "line 1: does not follow");
  EXPECT_EQ(flaw(checker, "m -1 2 0\n"), "");
  EXPECT_EQ(checker.best(), 1);
  EXPECT_TRUE(checker.is_refuted());

  ProofChecker joined(problem, sum);
  EXPECT_EQ(flaw(joined, "a 1 0\nm -1 2 0\n"), "line 2: breaks a line before");
}

TEST(ProofChecker, SaysWhatIsNoLog) {
  const Problem problem = with_variables(2);
  EXPECT_EQ(flaw(problem, "l 1 2\n"), "line 1: no 0 at its end");
  EXPECT_EQ(flaw(problem, "l 3 0\n"), "line 1: no such variable");
  EXPECT_EQ(flaw(problem, "q 1 0\n"), "line 1: no such kind of line");
  EXPECT_EQ(flaw(problem, "b 1 1 7 0\n"), "line 1: no such variable");
  EXPECT_EQ(flaw(problem, "b 1 9223372036854775807 1 0\n"),
            "line 1: out of range");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Problem random_clauses(std::mt19937_64& rng) {
  constexpr std::uint32_t kVariables = 30;
  Problem problem = with_variables(kVariables);
  for (int k = 0; k < 5 * static_cast<int>(kVariables); ++k) {
    std::vector<Literal> clause;
    for (int i = 0; i < 3; ++i)
      clause.emplace_back(VarId{static_cast<std::uint32_t>(rng() % kVariables)},
                          rng() % 2 == 0);
    problem.add_clause(clause);
  }
  return problem;
}

TEST(ProofChecker, MissesWhatIsTakenOutOfALog) {
  std::mt19937_64 rng(4);
  int n_logs = 0, n_refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Problem problem = random_clauses(rng);
    std::ostringstream text;
    ProofLog log(text);
    Solver solver(problem);
    solver.set_log(&log);
    if (solver.solve() != Status::Infeasible) continue;
    EXPECT_EQ(flaw(problem, text.str()), "");
    const auto lines = lines_of(text.str());
    EXPECT_NE(flaw(problem, lines.back() + "\n"), "") << "needs no search";
    std::string rest;
    for (std::size_t i = lines.size() / 2; i < lines.size(); ++i)
      rest += lines[i] + "\n";
    ++n_logs;
    if (!flaw(problem, rest).empty()) ++n_refused;
  }
  EXPECT_GT(n_logs, 10);
  EXPECT_GT(n_refused, n_logs / 2);
}

// No line that some model breaks is taken.
TEST(ProofChecker, TakesNothingThatDoesNotFollow) {
  std::mt19937_64 rng(8);
  int n_taken = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = trial % 2 == 0
                                ? support::random_program(rng, 9)
                                : support::random_surface_program(rng, 10);
    const auto n = static_cast<std::uint32_t>(problem.n_variables());
    ProofChecker checker(problem);
    for (int k = 0; k < 20; ++k) {
      std::vector<Literal> clause, opposite;
      for (std::uint32_t size = 1 + k % 3; size > 0; --size)
        clause.emplace_back(VarId{static_cast<std::uint32_t>(rng() % n)},
                            rng() % 2 == 0);
      if (!checker.implies(clause)) continue;
      ++n_taken;
      for (const Literal l : clause) opposite.push_back(!l);
      const auto order = support::random_order(rng, n);
      EXPECT_EQ(
          support::least_model(support::with_fixed(problem, opposite), order),
          std::nullopt);
    }
  }
  EXPECT_GT(n_taken, 500);
}

}  // namespace
