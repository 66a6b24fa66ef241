/// @file
/// The stages of the planar pipeline after the triangulation, and the whole,
/// on a wavy closed curve. Items are points.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "umbrella/curve.h"

namespace {

using delaunay::Point2;

std::vector<Point2> wavy_curve(std::size_t n) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(0, 0.8);
  const double spacing = 2 * std::numbers::pi / static_cast<double>(n);
  std::vector<Point2> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = spacing * (static_cast<double>(i) + unit(rng));
    const double r = 1 + 0.3 * std::cos(7 * t);
    points.emplace_back(r * std::cos(t), r * std::sin(t));
  }
  return points;
}

void count(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void BM_DelaunayEdges(benchmark::State& state) {
  const delaunay::Triangulation2 t(wavy_curve(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::delaunay_edges(t).data());
  count(state);
}

void BM_CurveFilter(benchmark::State& state) {
  const delaunay::Triangulation2 t(wavy_curve(state.range(0)));
  const auto edges = umbrella::delaunay_edges(t);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::curve_filter(t.points().size(), edges).edges.data());
  count(state);
}

void BM_CloseCurve(benchmark::State& state) {
  const delaunay::Triangulation2 t(wavy_curve(state.range(0)));
  const auto edges = umbrella::delaunay_edges(t);
  const auto agreed = umbrella::curve_filter(t.points().size(), edges).agreed;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        umbrella::close_curve(t.points().size(), edges, agreed).edges.data());
  count(state);
}

void BM_ReconstructCurve(benchmark::State& state) {
  const std::vector<Point2> points = wavy_curve(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(umbrella::reconstruct_curve(points).edges.data());
  count(state);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->RangeMultiplier(10)->Range(1000, 1000000);
}

BENCHMARK(BM_DelaunayEdges)->Apply(sizes);
BENCHMARK(BM_CurveFilter)->Apply(sizes);
BENCHMARK(BM_CloseCurve)->Apply(sizes);
BENCHMARK(BM_ReconstructCurve)->Apply(sizes);

}  // namespace
