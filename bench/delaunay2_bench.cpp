/// @file
/// Planar Delaunay triangulation over sizes and kinds of input, with CGAL as a
/// peer where it is installed. Items are points.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "delaunay/spatial_sort.h"
#include "delaunay/triangulation2.h"

#ifdef UMBRELLA_HAS_CGAL
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace {

using delaunay::Point2;
using Points = std::vector<Point2>;

Points uniform(std::size_t n, double scale) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  Points points(n);
  for (Point2& p : points)
    for (double& x : p) x = scale * unit(rng);
  return points;
}

// The square grid 0, step, 2 step, ... over `low`, in random order.
Points grid(std::size_t n, double low, double step) {
  const auto side = static_cast<std::size_t>(std::sqrt(n));
  Points points;
  for (std::size_t i = 0; i < side * side; ++i)
    points.emplace_back(low + step * static_cast<double>(i % side),
                        low + step * static_cast<double>(i / side));
  std::ranges::shuffle(points, std::mt19937_64(2));
  return points;
}

// Primes p = a^2 + b^2 as (a, b).
constexpr std::int64_t kPrimes[][2] = {
    {2, 1}, {2, 1}, {2, 1}, {3, 2}, {3, 2}, {4, 1}, {4, 1},  {5, 2}, {6, 1},
    {5, 4}, {7, 2}, {6, 5}, {8, 3}, {8, 5}, {9, 4}, {10, 1}, {10, 3}};

// Integer points of one circle: the Gaussian integers z whose square modulus
// is a given product of primes p = |a + bi|^2, one conjugate chosen for each.
Points cocircular(std::size_t n) {
  using Gaussian = std::complex<std::int64_t>;
  std::vector<Gaussian> circle = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (const auto& [a, b] : kPrimes) {
    std::vector<Gaussian> next;
    for (const Gaussian z : circle) {
      next.push_back(z * Gaussian(a, b));
      next.push_back(z * Gaussian(a, -b));
    }
    const auto less = [](Gaussian y, Gaussian z) {
      return std::pair(y.real(), y.imag()) < std::pair(z.real(), z.imag());
    };
    std::ranges::sort(next, less);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    circle = std::move(next);
    if (circle.size() >= n) break;
  }
  std::ranges::shuffle(circle, std::mt19937_64(3));
  Points points;
  for (const Gaussian z : circle)
    points.emplace_back(static_cast<double>(z.real()),
                        static_cast<double>(z.imag()));
  return points;
}

// A wavy closed curve, noise a tenth of the spacing.
Points curve(std::size_t n) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points points(n);
  const double spacing = 2 * std::numbers::pi / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = spacing * static_cast<double>(i);
    const double r = 1 + 0.3 * std::cos(7 * t) + 0.1 * spacing * unit(rng);
    points[i] = {r * std::cos(t), r * std::sin(t)};
  }
  std::ranges::shuffle(points, rng);
  return points;
}

enum Kind { Uniform, Grid, Cocircular, Curve, UlpGrid, Huge, Tiny };
constexpr std::array kNames = {"uniform",      "grid",     "cocircular",
                               "curve",        "ulp_grid", "uniform_1e80",
                               "uniform_1e-80"};

Points make(std::int64_t kind, std::size_t n) {
  switch (kind) {
    case Grid:
      return grid(n, 0, 1);
    case Cocircular:
      return cocircular(n);
    case Curve:
      return curve(n);
    case UlpGrid:
      return grid(n, 0.5, 0x1p-53);
    case Huge:
      return uniform(n, 1e80);
    case Tiny:
      return uniform(n, 1e-80);
    default:
      return uniform(n, 1);
  }
}

void finish(benchmark::State& state, const Points& points) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(points.size()));
  state.SetLabel(kNames[static_cast<std::size_t>(state.range(0))]);
}

void BM_Triangulation2(benchmark::State& state) {
  const Points points = make(state.range(0), state.range(1));
  for (auto _ : state) {
    const delaunay::Triangulation2 t(points);
    benchmark::DoNotOptimize(t.n_finite_cells());
  }
  finish(state, points);
}

void BM_SpatialOrder2(benchmark::State& state) {
  const Points points = make(state.range(0), state.range(1));
  for (auto _ : state)
    benchmark::DoNotOptimize(delaunay::spatial_order(points).points.data());
  finish(state, points);
}

#ifdef UMBRELLA_HAS_CGAL
void BM_Cgal2(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  for (const Point2& p : make(state.range(0), state.range(1)))
    points.emplace_back(p.x(), p.y());
  for (auto _ : state) {
    const CGAL::Delaunay_triangulation_2<Kernel> t(points.begin(),
                                                   points.end());
    benchmark::DoNotOptimize(t.number_of_vertices());
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(points.size()));
  state.SetLabel(kNames[static_cast<std::size_t>(state.range(0))]);
}
#endif

void sizes(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond);
  for (const std::int64_t n : {1000, 10000, 100000, 1000000}) {
    for (const Kind kind :
         {Uniform, Grid, Cocircular, Curve, UlpGrid, Huge, Tiny})
      if (kind != Cocircular || n <= 100000) b->Args({kind, n});
  }
}

BENCHMARK(BM_Triangulation2)->Apply(sizes);
BENCHMARK(BM_SpatialOrder2)->Apply(sizes);
#ifdef UMBRELLA_HAS_CGAL
BENCHMARK(BM_Cgal2)->Apply(sizes);
#endif

}  // namespace
