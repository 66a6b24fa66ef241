#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ilp/formats.h"
#include "ilp/linear_form.h"
#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Cycle;
using ilp::LinearForm;
using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Program;
using ilp::Solver;
using ilp::Spoke;
using ilp::Status;
using ilp::Term;
using ilp::VarId;

Program read(const std::string& text) { return ilp::read_opb(text, "p.opb"); }

std::string opb(const LinearForm& form) {
  std::ostringstream out;
  ilp::write_opb(out, form);
  return out.str();
}

Model model_of_bits(std::size_t n, unsigned bits) {
  Model model;
  for (std::size_t v = 0; v < n; ++v) model.push_back((bits >> v & 1U) != 0);
  return model;
}

std::vector<Literal> literals(const Model& model) {
  std::vector<Literal> result;
  for (std::uint32_t v = 0; v < model.size(); ++v)
    result.emplace_back(VarId{v}, model[v]);
  return result;
}

// A model of the program can be completed to one of its file, has no excess
// cycle, and keeps to every cycle; any other breaks one of these.
void expect_same_models(const Problem& problem) {
  const Program file = read(opb(linear_form(problem)));
  Solver solver(file.problem);
  const std::size_t n = problem.n_variables();
  for (unsigned bits = 0; bits < 1U << n; ++bits) {
    const Model model = model_of_bits(n, bits);
    const auto values = literals(model);
    bool expected = solver.solve(values) == Status::Feasible;
    if (expected) {
      const std::vector<Cycle> excess = excess_cycles(problem, model);
      expected = excess.empty();
      const Program cut = read(opb(linear_form(problem, excess)));
      EXPECT_EQ(Solver(cut.problem).solve(values) == Status::Feasible,
                expected);
    }
    EXPECT_EQ(first_violation(problem, model).empty(), expected) << bits;
  }
}

TEST(LinearForm, HasTheModelsOfTheProgramButForExcessCycles) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_same_models(support::random_program(rng, 7));
    expect_same_models(support::random_surface_program(rng, 9));
    if (HasFailure()) return;
  }
}

// Two tetrahedra that share a vertex: the ring there has two cycles.
TEST(LinearForm, CutsASecondCycleAtAVertex) {
  const std::vector<support::Triangle> triangles = {
      {0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3},
      {0, 4, 5}, {0, 4, 6}, {0, 5, 6}, {4, 5, 6}};
  const Problem problem = support::surface_program(triangles);
  const Model both(8, true);
  EXPECT_EQ(first_violation(problem, both), "ring 0");
  const std::vector<Cycle> excess = excess_cycles(problem, both);
  ASSERT_EQ(excess.size(), 1U);
  EXPECT_EQ(excess[0].ring, 0U);
  EXPECT_EQ(excess[0].spokes.size(), 3U);
  EXPECT_EQ(linear_form(problem, excess).rows.size(),
            linear_form(problem).rows.size() + 3);
}

// 2 x1 - x2 + x3 with a pair, a clause and an equation.
LinearForm small_form() {
  Problem problem;
  problem.add_variables(3);
  constexpr VarId kX{0}, kY{1}, kZ{2};
  problem.add_pair(std::array{kX, kY});
  problem.add_clause(std::array{Literal(kX, true), Literal(kZ, false)});
  problem.add_linear(std::array{Term{kX, 3}, Term{kZ, -2}}, 2);
  problem.fix(kZ, true);
  LinearForm form = linear_form(problem);
  form.objective = {{kX, 2}, {kY, -1}, {kZ, 1}};
  return form;
}

TEST(Formats, WriteOpb) {
  EXPECT_EQ(opb(small_form()),
            "* #variable= 3 #constraint= 5\n"
            "min: +2 x1 -1 x2 +1 x3 ;\n"
            "+1 x3 = 1 ;\n"
            "-1 x1 +1 x2 >= 0 ;\n"
            "+1 x1 -1 x2 >= 0 ;\n"
            "+1 x1 -1 x3 >= 0 ;\n"
            "-3 x1 +2 x3 >= -2 ;\n");
}

TEST(Formats, WriteLp) {
  std::ostringstream out;
  ilp::write_lp(out, small_form());
  EXPECT_EQ(out.str(),
            "Minimize\n"
            " obj: + 2 x1 - 1 x2 + 1 x3\n"
            "Subject To\n"
            " c1: + 1 x3 = 1\n"
            " c2: - 1 x1 + 1 x2 >= 0\n"
            " c3: + 1 x1 - 1 x2 >= 0\n"
            " c4: + 1 x1 - 1 x3 >= 0\n"
            " c5: - 3 x1 + 2 x3 >= -2\n"
            "Binary\n"
            " x1\n"
            " x2\n"
            " x3\n"
            "End\n");
}

TEST(Formats, WriteMps) {
  std::ostringstream out;
  ilp::write_mps(out, small_form());
  EXPECT_EQ(out.str(),
            "NAME umbrella FREE\n"
            "ROWS\n N obj\n E c1\n G c2\n G c3\n G c4\n G c5\n"
            "COLUMNS\n MARKER 'MARKER' 'INTORG'\n"
            " x1 obj 2\n x1 c2 -1\n x1 c3 1\n x1 c4 1\n x1 c5 -3\n"
            " x2 obj -1\n x2 c2 1\n x2 c3 -1\n"
            " x3 obj 1\n x3 c1 1\n x3 c4 -1\n x3 c5 2\n"
            " MARKER 'MARKER' 'INTEND'\n"
            "RHS\n RHS c1 1\n RHS c5 -2\n"
            "BOUNDS\n BV BND x1\n BV BND x2\n BV BND x3\n"
            "ENDATA\n");
}

TEST(Formats, WriteProgramsWithoutAnything) {
  Problem problem;
  EXPECT_EQ(opb(linear_form(problem)), "* #variable= 1 #constraint= 0\n");
  problem.add_clause({});
  const std::string contradiction = opb(linear_form(problem));
  EXPECT_EQ(contradiction, "* #variable= 1 #constraint= 1\n+0 x1 >= 1 ;\n");
  EXPECT_EQ(Solver(read(contradiction).problem).solve(), Status::Infeasible);
}

TEST(ReadOpb, TakesAllThatTheStandardHas) {
  const Program program = read(
      "* #variable= 4 #constraint= 3\n"
      "* a comment\n"
      "min: +2 x1 -3 ~x2 ;\n"
      "+1 x1 +2 ~x2 -3 x3 >= -1 ;\r\n"
      "  1 x1\n\t+ 1 x2 = 1;\n"
      "-x1 <= 0;");
  EXPECT_TRUE(program.has_objective);
  EXPECT_EQ(program.offset, -3);
  ASSERT_EQ(program.objective.size(), 2U);
  EXPECT_EQ(program.objective[1].coefficient, 3);
}

TEST(ReadOpb, ReadsWhatItSays) {
  const Program program = read(
      "* #variable= 4 #constraint= 3\n"
      "+1 x1 +2 ~x2 -3 x3 >= -1 ;\n"
      "1 x1 + 1 x2 = 1;\n"
      "x1 +x3 <= 1;");
  EXPECT_FALSE(program.has_objective);
  EXPECT_EQ(program.problem.n_variables(), 4U);
  for (unsigned bits = 0; bits < 16; ++bits) {
    const int x1 = bits & 1U, x2 = bits >> 1U & 1U, x3 = bits >> 2U & 1U;
    const bool expected =
        x1 + 2 * (1 - x2) - 3 * x3 >= -1 && x1 + x2 == 1 && x1 + x3 <= 1;
    EXPECT_EQ(first_violation(program.problem, model_of_bits(4, bits)).empty(),
              expected)
        << bits;
  }
}

TEST(ReadOpb, SaysWhereAFileIsWrong) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"1 x1 >= 1", "p.opb:1:10: expected ';', not the end of the file"},
      {"* c\n1 x1 > 1 ;", "p.opb:2:6: expected '>=', '<=' or '=', not '>'"},
      {"1 x1 >= one ;", "p.opb:1:9: expected a number, not 'one'"},
      {"1 y1 >= 1 ;", "p.opb:1:3: expected a variable, not 'y1'"},
      {"1 x0 >= 1 ;", "p.opb:1:3: no such variable: 'x0'"},
      {"* #variable= 2 #constraint= 1\n1 x3 >= 1 ;",
       "p.opb:2:3: no such variable: 'x3'"},
      {"* #variable= 1 #constraint= 2\n1 x1 >= 1 ;\n",
       "p.opb:3:1: the header says 2 constraints, there are 1"},
      {"* #variable= 999999999999 #constraint= 2\n",
       "p.opb:1:3: more than 2^29 variables"},
      {"* #variable= many\n", "p.opb:1:3: no number after #variable="},
      {"1 x1 x2 >= 1 ;", "p.opb:1:6: products of variables are not read: 'x2'"},
      {"99999999999999999999 x1 >= 1 ;",
       "p.opb:1:1: number out of range: '99999999999999999999'"},
      {"1 x1\n+4611686018427387904 x2 >= 1 ;",
       "p.opb:2:1: number out of range: '+4611686018427387904'"},
      {"1152921504606846976 x1 +1152921504606846976 x2 >= 1 ;",
       "p.opb:1:1: the sum is out of range"},
      {"1 x1 >= 1 ;\nmin: 1 x1 ;",
       "p.opb:2:1: an objective must come first, and once"},
      {"min: 1 x1 >= 1 ;", "p.opb:1:11: expected ';', not '>='"},
  };
  for (const auto& [text, message] : wrong) {
    SCOPED_TRACE(text);
    EXPECT_THAT([&text = text] { read(text); },
                testing::ThrowsMessage<std::invalid_argument>(message));
  }
}

// The rest of the text may lie behind it in memory.
TEST(ReadOpb, LooksNoFurtherThanItsText) {
  const auto outcome = [](std::string_view text) -> std::string {
    try {
      const Program program = ilp::read_opb(text, "p.opb");
      return opb(linear_form(program.problem));
    } catch (const std::invalid_argument& problem) {
      return problem.what();
    }
  };
  const std::string whole =
      "* #variable= 12 #constraint= 2\nmin: -3 x1 +12 ~x12 ;\n"
      "+11 x11 -2 x1 >= -15 ;\n* star\nx2 = 1 ;\n";
  for (std::size_t n = 0; n <= whole.size(); ++n) {
    SCOPED_TRACE(testing::Message() << n << " characters");
    EXPECT_EQ(outcome(std::string_view(whole).substr(0, n)),
              outcome(whole.substr(0, n)));
  }
}

// Whatever the bytes, the reader ends with a program or with one line.
TEST(ReadOpb, WithstandsMutation) {
  const std::string sound = opb(linear_form(support::torus_hole(3, 1, 1)));
  std::mt19937_64 rng(1);
  int n_read = 0, n_refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::string text = sound.substr(0, 1 + rng() % 400);
    for (int k = 0; k < 2; ++k) {
      constexpr std::string_view kBytes = "x~+-0123456789;>=< \n*:min\xff";
      text[rng() % text.size()] = kBytes[rng() % kBytes.size()];
    }
    try {
      read("* #variable= 500\n" + text + ";");
      ++n_read;
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(e.what(), testing::MatchesRegex("p.opb:[0-9]+:[0-9]+: .*"));
      ++n_refused;
    }
  }
  EXPECT_GT(n_read, 0);
  EXPECT_GT(n_refused, 0);
}

}  // namespace
