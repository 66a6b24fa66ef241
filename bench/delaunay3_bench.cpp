/// @file
/// Delaunay triangulation in space and its spatial sort, over sizes and kinds
/// of input, with CGAL as a peer where it is installed. Items are points.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <vector>

#include "apps/shapes.h"
#include "delaunay/spatial_sort.h"
#include "delaunay/triangulation3.h"

#ifdef UMBRELLA_HAS_CGAL
#include "bench/cgal_delaunay3.h"
#endif

namespace {

using delaunay::Point3;

constexpr std::array kShapes = {"uniform", "torus", "grid", "cospherical"};

std::vector<Point3> make(const benchmark::State& state) {
  return shapes::sample(kShapes[state.range(0)], state.range(1));
}

template <class Run>
void time_points(benchmark::State& state, Run run) {
  const std::vector<Point3> points = make(state);
  for (auto _ : state) benchmark::DoNotOptimize(run(points));
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(points.size()));
  state.SetLabel(kShapes[state.range(0)]);
}

/// For each point, in builds with -DDELAUNAY_COUNTERS=ON.
void show(const delaunay::Counters& counters, benchmark::State& state) {
  if (!delaunay::kCounting) return;
  const auto n = static_cast<double>(state.range(1));
  const auto each = [n](std::uint64_t total) {
    return static_cast<double>(total) / n;
  };
  state.counters["tests"] = each(counters.sphere_tests);
  state.counters["exact"] = each(counters.exact_tests);
  state.counters["steps"] = each(counters.walk_steps);
  state.counters["cells"] = each(counters.cells_made);
}

void BM_Triangulation3(benchmark::State& state) {
  time_points(state, [&state](const std::vector<Point3>& points) {
    const delaunay::Triangulation3 t(points);
    show(t.counters(), state);
    return t.n_finite_cells();
  });
}

void BM_SpatialOrder3(benchmark::State& state) {
  time_points(state, [](const std::vector<Point3>& points) {
    return delaunay::spatial_order(points).points.size();
  });
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond);
  for (const std::int64_t n : {1000, 10000, 100000, 1000000})
    for (std::size_t shape = 0; shape < kShapes.size(); ++shape)
      // Lattice spheres of a million points leave the doubles' integers.
      if (kShapes[shape] != std::string_view("cospherical") || n <= 10000)
        b->Args({static_cast<std::int64_t>(shape), n});
}

BENCHMARK(BM_Triangulation3)->Apply(sizes);
BENCHMARK(BM_SpatialOrder3)->Apply(sizes);

#ifdef UMBRELLA_HAS_CGAL
void BM_Cgal3(benchmark::State& state) {
  time_points(state, [](const std::vector<Point3>& points) {
    return bench::cgal_delaunay3(points).n_finite_cells;
  });
}
BENCHMARK(BM_Cgal3)->Apply(sizes);
#endif

}  // namespace
