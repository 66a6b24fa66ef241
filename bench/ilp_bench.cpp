// Holes in a torus grid: the triangles that belong there, and so many times as
// many misleading ones on near vertices.

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "ilp/improve.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Problem;
using ilp::Solver;
using ilp::VarId;

void count(benchmark::State& state, const Solver& solver,
           const Problem& problem) {
  state.counters["variables"] = static_cast<double>(problem.n_variables());
  state.counters["conflicts"] =
      static_cast<double>(solver.statistics().conflicts);
}

// Setting up and the least model, in a random order.
void BM_MinimizeWorstFirst(benchmark::State& state) {
  const Problem problem =
      support::torus_hole(static_cast<std::uint32_t>(state.range(0)),
                          static_cast<double>(state.range(1)), 1);
  std::mt19937_64 rng(1);
  const auto order = support::random_order(rng, problem.n_variables());
  for (auto _ : state) {
    Solver solver(problem);
    benchmark::DoNotOptimize(
        minimize_worst_first(solver, order, {.conflicts = 20'000},
                             static_cast<std::uint64_t>(state.range(2))));
    count(state, solver, problem);
  }
}
BENCHMARK(BM_MinimizeWorstFirst)
    ->ArgNames({"side", "extra", "in_order"})
    ->ArgsProduct({{10, 17, 32}, {3, 9}, {0, 2000}})
    ->Unit(benchmark::kMillisecond);

// Setting up alone.
void BM_Solver(benchmark::State& state) {
  const Problem problem =
      support::torus_hole(static_cast<std::uint32_t>(state.range(0)), 3, 1);
  for (auto _ : state) {
    Solver solver(problem);
    benchmark::DoNotOptimize(solver.statistics());
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(problem.n_variables()));
}
BENCHMARK(BM_Solver)->ArgName("side")->Arg(10)->Arg(32)->Arg(100);

}  // namespace
