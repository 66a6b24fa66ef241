// The stages after the triangulation, each alone, on a surface that exercises
// all of them; lambda also on lattices, where ranks tie in masses.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>

#include "apps/shapes.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/closing.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/holes.h"
#include "umbrella/reconstruct.h"

namespace {

using delaunay::Triangulation3;

/// Input of every stage.
struct Stages {
  Triangulation3 triangulation;
  std::size_t n = triangulation.points().size();
  umbrella::Circumspheres spheres{triangulation};
  std::vector<umbrella::RankedTriangle> ranked =
      umbrella::ranked_triangles(triangulation, spheres);
  umbrella::FilterResult filtered = umbrella::umbrella_filter(n, ranked);
  umbrella::CleanUpResult clean = umbrella::clean_up(n, filtered.triangles);
  std::vector<umbrella::Hole> holes = umbrella::find_holes(
      n, clean.triangles, clean.deleted, clean.without_umbrella);

  Stages(const std::string& shape, std::int64_t size)
      : triangulation(shapes::sample(shape, static_cast<std::size_t>(size))) {}
};

void count_points(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void circumspheres(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state) {
    umbrella::Circumspheres spheres(s.triangulation);
    benchmark::DoNotOptimize(spheres);
  }
  count_points(state);
}

void ranks(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::ranked_triangles(s.triangulation, s.spheres));
  count_points(state);
}

void filter(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::umbrella_filter(s.n, s.ranked));
  count_points(state);
}

void clean_up(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::clean_up(s.n, s.filtered.triangles));
  count_points(state);
}

void holes(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::find_holes(
        s.n, s.clean.triangles, s.clean.deleted, s.clean.without_umbrella));
  count_points(state);
}

void closing(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::close_holes(s.triangulation, s.clean.triangles, s.holes));
  count_points(state);
}

void whole(benchmark::State& state, const char* shape) {
  const auto points =
      shapes::sample(shape, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(umbrella::reconstruct(points));
  count_points(state);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->RangeMultiplier(10)->Range(1000, 100'000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(circumspheres, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(circumspheres, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, cospherical, "cospherical")->Apply(sizes);
BENCHMARK_CAPTURE(filter, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(clean_up, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(holes, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(closing, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(whole, knot, "knot")->Apply(sizes);

}  // namespace
