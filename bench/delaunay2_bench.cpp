/// @file
/// Planar Delaunay triangulation over sizes and kinds of input, with CGAL as a
/// peer where it is installed. Items are points.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/planar_inputs.h"
#include "delaunay/spatial_sort.h"
#include "delaunay/triangulation2.h"

#ifdef UMBRELLA_HAS_CGAL
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace {

using delaunay::Point2;
using Points = std::vector<Point2>;

std::string_view kind(const benchmark::State& state) {
  return bench::kPlanarInputs[static_cast<std::size_t>(state.range(0))];
}

Points make(const benchmark::State& state) {
  return bench::planar_input(kind(state),
                             static_cast<std::size_t>(state.range(1)));
}

void finish(benchmark::State& state, const Points& points) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(points.size()));
  state.SetLabel(std::string(kind(state)));
}

void BM_Triangulation2(benchmark::State& state) {
  const Points points = make(state);
  for (auto _ : state) {
    const delaunay::Triangulation2 t(points);
    benchmark::DoNotOptimize(t.n_finite_cells());
  }
  finish(state, points);
}

void BM_SpatialOrder2(benchmark::State& state) {
  const Points points = make(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(delaunay::spatial_order(points).points.data());
  finish(state, points);
}

#ifdef UMBRELLA_HAS_CGAL
void BM_Cgal2(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  for (const Point2& p : make(state)) points.emplace_back(p.x(), p.y());
  for (auto _ : state) {
    const CGAL::Delaunay_triangulation_2<Kernel> t(points.begin(),
                                                   points.end());
    benchmark::DoNotOptimize(t.number_of_vertices());
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(points.size()));
  state.SetLabel(std::string(kind(state)));
}
#endif

void sizes(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond);
  for (const std::int64_t n : {1000, 10000, 100000, 1000000})
    for (std::size_t k = 0; k < bench::kPlanarInputs.size(); ++k)
      if (bench::kPlanarInputs[k] != "cocircular" || n <= 100000)
        b->Args({static_cast<std::int64_t>(k), n});
}

BENCHMARK(BM_Triangulation2)->Apply(sizes);
BENCHMARK(BM_SpatialOrder2)->Apply(sizes);
#ifdef UMBRELLA_HAS_CGAL
BENCHMARK(BM_Cgal2)->Apply(sizes);
#endif

}  // namespace
