#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ilp/linear_form.h"
#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"

namespace {

using ilp::Core;
using ilp::Limits;
using ilp::Literal;
using ilp::Model;
using ilp::Problem;
using ilp::Solver;
using ilp::Statistics;
using ilp::Status;
using ilp::Term;
using ilp::VarId;

using Generator = Problem (*)(std::mt19937_64&, std::uint32_t);

bool has_model(const Problem& problem) {
  std::mt19937_64 rng(1);
  const auto order = support::random_order(rng, problem.n_variables());
  return support::least_model(problem, order).has_value();
}

void expect_core(const Core& core, const Problem& problem,
                 std::vector<Literal> assumptions) {
  std::ranges::sort(assumptions);
  EXPECT_TRUE(std::ranges::includes(assumptions, core.assumptions));
  EXPECT_FALSE(has_model(support::with_fixed(
      support::part_of(problem, core.constraints), core.assumptions)));
}

// One solver, asked without, with and again without assumptions, finds a model
// exactly where enumeration does, and else a core and a proof.
void expect_agrees_with_enumeration(const Problem& problem,
                                    std::mt19937_64& rng) {
  std::vector<Literal> assumptions;
  for (const VarId v : support::random_order(rng, problem.n_variables()))
    if (rng() % 4 == 0) assumptions.emplace_back(v, rng() % 2 == 0);

  Solver solver(problem);
  support::CheckedLog checked(problem);
  solver.set_log(checked.log());
  solver.set_priority(support::random_order(rng, problem.n_variables()));
  for (const bool is_assumed : {false, true, false}) {
    const auto asked = is_assumed ? assumptions : std::vector<Literal>{};
    const Problem fixed = support::with_fixed(problem, asked);
    const Status status = solver.solve(asked);
    ASSERT_EQ(status, has_model(fixed) ? Status::Feasible : Status::Infeasible);
    if (status == Status::Feasible) {
      EXPECT_EQ(first_violation(fixed, solver.model()), "");
    } else {
      expect_core(solver.core(), problem, asked);
      EXPECT_EQ(checked.first_flaw(), "");
      EXPECT_TRUE(checked.excludes(asked));
      EXPECT_EQ(checked.checker().is_refuted(), !has_model(problem));
    }
  }
}

class SolverOnRandomPrograms
    : public testing::TestWithParam<std::pair<const char*, Generator>> {};

TEST_P(SolverOnRandomPrograms, AgreesWithEnumeration) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_agrees_with_enumeration(GetParam().second(rng, 11), rng);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , SolverOnRandomPrograms,
    testing::Values(std::pair{"surfaces", &support::random_surface_program},
                    std::pair{"programs", &support::random_program}),
    [](const auto& instance) { return std::string(instance.param.first); });

TEST(SlowSolver, AgreesWithEnumerationOnLargerPrograms) {
  std::mt19937_64 rng(7);
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_agrees_with_enumeration(support::random_surface_program(rng, 17),
                                   rng);
    expect_agrees_with_enumeration(support::random_program(rng, 14), rng);
    if (HasFailure()) return;
  }
}

// After 32 conflicts, 64 and 128 [Luby93]; the next decision restarts.
TEST(Solver, RestartsAsOftenAsItShould) {
  const Problem problem = support::torus_hole(9, 20, 1);
  std::mt19937_64 rng(4);
  const auto order = support::random_order(rng, problem.n_variables());
  for (const auto& [conflicts, restarts] :
       {std::pair{31U, 0U}, std::pair{60U, 1U}, std::pair{120U, 2U}}) {
    Solver solver(problem);
    solver.set_priority(order);
    ASSERT_EQ(solver.solve({}, {.conflicts = conflicts}), Status::Limit);
    EXPECT_EQ(solver.statistics().conflicts, conflicts);
    EXPECT_EQ(solver.statistics().restarts, restarts);
  }
}

// A hole whose own triangles close it; the extra ones only mislead.
TEST(Solver, ClosesHolesOfATorus) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Problem problem = support::torus_hole(8, 12, seed);
    std::mt19937_64 rng(seed);
    Solver solver(problem);
    solver.set_priority(support::random_order(rng, problem.n_variables()));
    ASSERT_EQ(solver.solve(), Status::Feasible);
    EXPECT_EQ(first_violation(problem, solver.model()), "");
  }
}

TEST(Solver, EnumeratesAllModelsByClauses) {
  const auto triangles = support::all_triangles(5);
  const Problem problem = support::surface_program(
      triangles, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  Solver solver(problem);
  support::CheckedLog checked(problem);
  solver.set_log(checked.log());
  int n_models = 0;
  while (solver.solve() == Status::Feasible && n_models < 100) {
    ++n_models;
    ASSERT_EQ(first_violation(problem, solver.model()), "");
    std::vector<Literal> other;
    for (std::uint32_t v = 0; v < triangles.size(); ++v)
      other.emplace_back(VarId{v}, !solver.model()[v]);
    EXPECT_EQ(solver.add_clause(other).index + 1,
              static_cast<std::uint32_t>(n_models));
  }
  EXPECT_EQ(n_models, 16);
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_TRUE(checked.checker().is_refuted());
  // The refutation needs the clause against each model.
  EXPECT_EQ(
      std::ranges::count(solver.core().constraints, ilp::ConstraintKind::Clause,
                         &ilp::ConstraintId::kind),
      16);
}

// Short clauses, units among them, whatever the last model left decided.
TEST(Solver, TakesClausesBetweenCalls) {
  std::mt19937_64 rng(20261127);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Problem problem = support::random_program(rng, 12);
    const auto order = support::random_order(rng, problem.n_variables());
    Solver solver(problem);
    support::CheckedLog checked(problem);
    solver.set_log(checked.log());
    solver.set_priority(order);
    solver.set_branching(trial % 2 == 0 ? ilp::Branching::Static
                                        : ilp::Branching::Adaptive);
    while (const auto least = support::least_model(problem, order)) {
      ASSERT_EQ(solver.solve(), Status::Feasible);
      ASSERT_EQ(first_violation(problem, solver.model()), "");
      if (trial % 2 == 0) {
        EXPECT_EQ(solver.model(), *least);
      }
      auto vars = support::random_order(rng, problem.n_variables());
      vars.resize(std::min<std::size_t>(vars.size(), 1 + rng() % 3));
      std::vector<Literal> clause;
      for (const VarId v : vars) clause.emplace_back(v, rng() % 2 == 0);
      problem.add_clause(clause);
      solver.add_clause(clause);
    }
    EXPECT_EQ(solver.solve(), Status::Infeasible);
    EXPECT_EQ(checked.first_flaw(), "");
  }
}

TEST(Solver, TakesLinearConstraintsBetweenCalls) {
  std::mt19937_64 rng(29);
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Problem problem = support::random_program(rng, 10);
    Solver solver(problem);
    support::CheckedLog checked(problem);
    solver.set_log(checked.log());
    solver.solve();
    for (int k = 0; k < 3; ++k) {
      std::vector<Term> terms;
      for (const VarId v : support::random_order(rng, problem.n_variables()))
        terms.push_back({v, static_cast<std::int64_t>(rng() % 7) - 3});
      const auto bound = static_cast<std::int64_t>(rng() % 5) - 2;
      const auto id = problem.add_linear(terms, bound);
      EXPECT_EQ(solver.add_linear(terms, bound), id);
      const Status status = solver.solve();
      ASSERT_EQ(status,
                has_model(problem) ? Status::Feasible : Status::Infeasible);
      if (status == Status::Infeasible) {
        EXPECT_EQ(checked.first_flaw(), "");
        EXPECT_TRUE(checked.checker().is_refuted());
        break;
      }
      EXPECT_EQ(first_violation(problem, solver.model()), "");
    }
  }
}

TEST(Solver, CountsPigeonsByLinearConstraints) {
  Problem problem;
  problem.add_variables(42);
  std::vector<Term> somewhere, here;
  for (std::uint32_t p = 0; p < 7; ++p) {
    somewhere.clear();
    for (std::uint32_t h = 0; h < 6; ++h)
      somewhere.push_back({VarId{6 * p + h}, -1});
    problem.add_linear(somewhere, -1);
  }
  for (std::uint32_t h = 0; h < 6; ++h) {
    here.clear();
    for (std::uint32_t p = 0; p < 7; ++p) here.push_back({VarId{6 * p + h}, 1});
    problem.add_linear(here, 1);
  }
  Solver solver(problem);
  EXPECT_EQ(solver.solve(), Status::Infeasible);
  EXPECT_EQ(solver.core().constraints.size(), 13U);
}

// Each is one simple cycle of its ring, and together with the rest of the form
// they refute what the search refuted.
TEST(Solver, NamesTheCyclesThatItNeeded) {
  std::mt19937_64 rng(31);
  std::size_t n_cycles = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = trial % 10 == 0
                                ? support::torus_hole(6, 10, rng())
                                : support::random_surface_program(rng, 14);
    Solver solver(problem);
    solver.keep_cycles();
    const Status status = solver.solve();
    for (const ilp::Cycle& cycle : solver.cycles()) {
      Problem ring;
      ring.add_variables(problem.n_variables());
      ring.add_ring(problem.ring(cycle.ring));
      Model model(problem.n_variables(), false);
      for (const VarId v : cycle.spokes) model[index(v)] = true;
      EXPECT_EQ(first_violation(ring, model), "");
      ++n_cycles;
    }
    if (status != Status::Infeasible) continue;
    Problem form;
    form.add_variables(problem.n_variables());
    support::add_rows(form, linear_form(problem, solver.cycles()));
    EXPECT_FALSE(has_model(form));
  }
  EXPECT_GT(n_cycles, 50U);
}

// Runs the same calls on a new solver; the statistics tell the trace.
std::tuple<Model, std::uint64_t, std::uint64_t> run(const Problem& problem) {
  std::mt19937_64 rng(3);
  Solver solver(problem);
  solver.set_priority(support::random_order(rng, problem.n_variables()));
  solver.solve();
  const Statistics s = solver.statistics();
  return {solver.model(), s.conflicts, s.propagations};
}

TEST(Solver, GoesTheSameWayOnEveryRun) {
  const Problem problem = support::torus_hole(7, 12, 2);
  const auto first = run(problem);
  EXPECT_GT(std::get<1>(first), 0U) << "too easy to tell";
  EXPECT_EQ(run(problem), first);
}

// Seven pigeons in six holes: a program that no search refutes quickly.
Problem pigeons() {
  constexpr std::uint32_t kHoles = 6;
  Problem problem;
  problem.add_variables((kHoles + 1) * kHoles);
  const auto in = [](std::uint32_t pigeon, std::uint32_t hole) {
    return VarId{pigeon * kHoles + hole};
  };
  for (std::uint32_t p = 0; p <= kHoles; ++p) {
    std::vector<Literal> somewhere;
    for (std::uint32_t h = 0; h < kHoles; ++h)
      somewhere.emplace_back(in(p, h), true);
    problem.add_clause(somewhere);
    for (std::uint32_t q = 0; q < p; ++q)
      for (std::uint32_t h = 0; h < kHoles; ++h)
        problem.add_clause(
            std::array{Literal(in(p, h), false), Literal(in(q, h), false)});
  }
  return problem;
}

TEST(Solver, StopsAtItsLimitsAndGoesOn) {
  const Problem problem = pigeons();
  Solver solver(problem);
  support::CheckedLog checked(problem);
  solver.set_log(checked.log());
  EXPECT_EQ(solver.solve({}, {.conflicts = 10}), Status::Limit);
  EXPECT_EQ(solver.statistics().conflicts, 10U);
  EXPECT_EQ(solver.solve({}, {.conflicts = 5}), Status::Limit);
  EXPECT_EQ(solver.statistics().conflicts, 15U);
  const auto before = solver.statistics().propagations;
  EXPECT_EQ(solver.solve({}, {.propagations = 100}), Status::Limit);
  EXPECT_LT(solver.statistics().propagations, before + 300);
  EXPECT_EQ(solver.solve({}, {.seconds = 0}), Status::Limit);
  const std::atomic<bool> stop = true;
  EXPECT_EQ(solver.solve({}, {.stop = &stop}), Status::Limit);
  EXPECT_EQ(solver.solve(), Status::Infeasible);
  EXPECT_EQ(solver.core().constraints.size(), problem.n_clauses());
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_TRUE(checked.checker().is_refuted());
}

// The second solver is told all assumptions anew each time; they go the same
// way, whatever was assumed and taken back before, with clauses between.
TEST(Solver, GoesTheSameWayWhenAssumptionsStay) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = support::random_surface_program(rng, 12);
    Solver stays(problem), anew(problem);
    std::vector<Literal> assumed;
    (void)stays.solve();
    (void)anew.solve();
    for (const VarId v : support::random_order(rng, problem.n_variables())) {
      for (; !assumed.empty() && rng() % 3 == 0; assumed.pop_back())
        stays.retract();
      assumed.emplace_back(v, rng() % 4 == 0);
      stays.assume(assumed.back());
      if (rng() % 3 == 0) continue;
      const Status status = anew.solve(assumed);
      ASSERT_EQ(stays.solve_assumed(), status);
      EXPECT_EQ(stays.model(), anew.model());
      EXPECT_EQ(stays.statistics().propagations,
                anew.statistics().propagations);
      if (status == Status::Infeasible) {
        EXPECT_EQ(stays.core().assumptions, anew.core().assumptions);
      }
      if (rng() % 8 > 0) continue;
      const std::array clause = {Literal(v, rng() % 2 == 0), !assumed.front()};
      stays.add_clause(clause);
      anew.add_clause(clause);
    }
    if (HasFailure()) return;
  }
}

TEST(Solver, CoreLeavesOutWhatIsElsewhere) {
  Problem problem = pigeons();
  const VarId first = problem.add_variables(20);
  for (std::uint32_t i = 0; i + 1 < 20; ++i) {
    const VarId v{static_cast<std::uint32_t>(first) + i};
    const VarId next{static_cast<std::uint32_t>(v) + 1};
    problem.add_pair(std::array{v, next});
  }
  Solver solver(problem);
  ASSERT_EQ(solver.solve(), Status::Infeasible);
  for (const auto& [kind, i] : solver.core().constraints)
    EXPECT_EQ(kind, ilp::ConstraintKind::Clause) << i;
}

Status answer(const Problem& problem) {
  Solver solver(problem);
  support::CheckedLog checked(problem);
  solver.set_log(checked.log());
  const Status status = solver.solve();
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_EQ(checked.checker().is_refuted(), status == Status::Infeasible);
  if (status == Status::Feasible) {
    EXPECT_EQ(first_violation(problem, solver.model()), "");
  } else {
    expect_core(solver.core(), problem, {});
  }
  return status;
}

// What is added to a program, and whether it has a model then.
struct LeastProgram {
  void (*add)(Problem&);
  bool has_model;
};

constexpr VarId kX{0}, kY{1};

// Without variables.
const std::vector<LeastProgram> kOfNothing = {
    {[](Problem&) {}, true},
    {[](Problem& p) { p.add_pair({}); }, true},
    {[](Problem& p) { p.add_ring({}); }, false},
    {[](Problem& p) { p.add_ring({}, true); }, true},
    {[](Problem& p) { p.add_ring_of_pairs({}); }, false},
    {[](Problem& p) { p.add_sides({}); }, true},
    {[](Problem& p) { p.add_clause({}); }, false},
    {[](Problem& p) { p.add_linear({}, 0); }, true},
    {[](Problem& p) { p.add_linear({}, -1); }, false}};
// With two.
const std::vector<LeastProgram> kOfTwoVariables = {
    {[](Problem& p) { p.add_pair(std::array{kX}); }, true},
    {[](Problem& p) {
       p.add_pair(std::array{kX});
       p.fix(kX, true);
     },
     false},
    {[](Problem& p) {
       p.add_ring(std::array{ilp::Spoke{kX, 0, 1}});
     },
     false},
    {[](Problem& p) {
       p.add_ring(std::array{ilp::Spoke{kX, 0, 1}}, true);
     },
     true},
    {[](Problem& p) {
       p.add_ring(std::array<ilp::Spoke, 2>{ilp::Spoke{kX, 0, 1}, {kY, 1, 0}});
     },
     true},
    {[](Problem& p) {
       const Literal x(kX, true);
       p.add_clause(std::array{x, x, x});
       p.fix(kX, false);
     },
     false},
    {[](Problem& p) {
       p.add_clause(std::array{Literal(kX, true), Literal(kX, false)});
     },
     true},
    {[](Problem& p) {
       p.fix(kX, true);
       p.fix(kX, true);
     },
     true},
    {[](Problem& p) {
       p.fix(kX, true);
       p.fix(kX, false);
     },
     false}};
void expect_answers(const std::vector<LeastProgram>& programs,
                    std::size_t n_variables) {
  for (std::size_t i = 0; i < programs.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "program " << i);
    Problem problem;
    problem.add_variables(n_variables);
    programs[i].add(problem);
    EXPECT_EQ(answer(problem),
              programs[i].has_model ? Status::Feasible : Status::Infeasible);
  }
}

TEST(Solver, AnswersTheLeastProgramsOfEachKind) {
  expect_answers(kOfNothing, 0);
  expect_answers(kOfTwoVariables, 2);
}

TEST(Solver, RefusesUnknownVariables) {
  Solver solver(pigeons());
  const std::array unknown = {Literal(VarId{42}, true)};
  EXPECT_THROW(solver.solve(unknown), std::invalid_argument);
  EXPECT_THROW(solver.assume(unknown[0]), std::invalid_argument);
  EXPECT_THROW(solver.add_clause(unknown), std::invalid_argument);
  EXPECT_THROW(solver.add_linear(std::array{Term{VarId{42}, 1}}, 0),
               std::invalid_argument);
}

}  // namespace
