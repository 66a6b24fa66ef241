// The stages after the triangulation, each alone, over kinds of input: a
// surface as they are made for, and points where triangles or ties abound.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/closing.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/holes.h"
#include "umbrella/reconstruct.h"
#include "umbrella/surface.h"

namespace {

using delaunay::Triangulation3;

/// Input of every stage.
struct Stages {
  Triangulation3 triangulation;
  std::size_t n = triangulation.points().size();
  umbrella::Circumspheres spheres{triangulation};
  umbrella::RankedTriangles ranked =
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

void gabriel(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  const auto facets = umbrella::facets(s.triangulation);
  for (auto _ : state) {
    std::size_t n = 0;
    for (const delaunay::Facet f : facets) n += s.spheres.is_gabriel(f) ? 1 : 0;
    benchmark::DoNotOptimize(n);
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
  for (auto _ : state) {
    state.PauseTiming();
    auto ranked = s.ranked;
    state.ResumeTiming();
    benchmark::DoNotOptimize(umbrella::umbrella_filter(s.n, std::move(ranked)));
  }
  count_points(state);
}

void clean_up(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    auto filtered = s.filtered;
    state.ResumeTiming();
    benchmark::DoNotOptimize(umbrella::clean_up(
        s.n, std::move(filtered.triangles), {}, filtered.unsettled));
  }
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

/// A surface without its triangles at the first `size` vertices, which lie
/// together: one region of some more vertices than that.
struct Torn {
  std::vector<umbrella::RankedTriangle> kept, torn;
  std::vector<umbrella::Hole> holes;

  Torn(const Stages& s, std::size_t size) {
    const auto closed =
        umbrella::close_holes(s.triangulation, s.clean.triangles, s.holes);
    std::vector<bool> is_bare(s.n);
    for (const auto& [corners, facet] : closed.triangles) {
      const bool is_torn = index(corners[0]) < size;
      (is_torn ? torn : kept).push_back({corners, facet, {}});
      for (const umbrella::VertexId v : corners)
        is_bare[index(v)] = is_bare[index(v)] || is_torn;
    }
    std::vector<umbrella::VertexId> bare;
    for (std::uint32_t v = 0; v < s.n; ++v)
      if (is_bare[v]) bare.push_back(umbrella::VertexId{v});
    holes = umbrella::find_holes(s.n, kept, torn, bare);
  }
};

void one_region(benchmark::State& state) {
  const Stages s("knot", 10'000);
  const Torn t(s, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::close_holes(s.triangulation, t.kept, t.holes));
  count_points(state);
}

std::vector<umbrella::LocatedTriangle> closed(const Stages& s) {
  return umbrella::close_holes(s.triangulation, s.clean.triangles, s.holes)
      .triangles;
}

void orientation(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  const auto triangles = closed(s);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::orient(s.triangulation.points(), triangles));
  count_points(state);
}

void certificate(benchmark::State& state, const char* shape) {
  const Stages s(shape, state.range(0));
  const auto surface = umbrella::orient(s.triangulation.points(), closed(s));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::check_surface(s.triangulation.points(), surface.triangles));
  count_points(state);
}

void whole(benchmark::State& state, const char* shape, umbrella::Stage stage) {
  const auto points =
      shapes::sample(shape, static_cast<std::size_t>(state.range(0)));
  umbrella::ReconstructOptions options;
  options.stage = stage;
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::reconstruct(points, options));
  count_points(state);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->RangeMultiplier(10)->Range(1000, 1'000'000)->Unit(benchmark::kMillisecond);
}

// Lattice spheres of a million points leave the doubles' integers.
void lattice_sizes(benchmark::internal::Benchmark* b) {
  b->RangeMultiplier(10)->Range(1000, 10'000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(gabriel, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(gabriel, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(gabriel, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(gabriel, cospherical, "cospherical")->Apply(lattice_sizes);
BENCHMARK_CAPTURE(ranks, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(ranks, cospherical, "cospherical")->Apply(lattice_sizes);
BENCHMARK_CAPTURE(filter, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(filter, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(filter, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(filter, cospherical, "cospherical")->Apply(lattice_sizes);
BENCHMARK_CAPTURE(clean_up, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(clean_up, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(clean_up, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(clean_up, cospherical, "cospherical")->Apply(lattice_sizes);
BENCHMARK_CAPTURE(holes, uniform, "uniform")->Apply(sizes);
BENCHMARK_CAPTURE(holes, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(holes, grid, "grid")->Apply(sizes);
BENCHMARK_CAPTURE(holes, cospherical, "cospherical")->Apply(lattice_sizes);
BENCHMARK_CAPTURE(orientation, knot, "knot")->Apply(sizes);
BENCHMARK_CAPTURE(certificate, knot, "knot")->Apply(sizes);

// Points that are no surface have no closed one worth waiting for.
BENCHMARK_CAPTURE(closing, knot, "knot")->Apply(sizes);
BENCHMARK(one_region)
    ->Arg(10)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole, knot, "knot", umbrella::Stage::Closed)->Apply(sizes);
BENCHMARK_CAPTURE(whole, uniform, "uniform", umbrella::Stage::Clean)
    ->Apply(sizes);
BENCHMARK_CAPTURE(whole, grid, "grid", umbrella::Stage::Clean)->Apply(sizes);
BENCHMARK_CAPTURE(whole, cospherical, "cospherical", umbrella::Stage::Clean)
    ->Apply(lattice_sizes);

}  // namespace
