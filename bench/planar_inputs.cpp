#include "bench/planar_inputs.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace bench {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points uniform(std::size_t n, double scale) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  Points points(n);
  for (Eigen::Vector2d& p : points)
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

// Exactly on y = 3x.
Points collinear(std::size_t n) {
  Points points;
  for (std::size_t i = 0; i < n; ++i)
    points.emplace_back(static_cast<double>(i), static_cast<double>(3 * i));
  std::ranges::shuffle(points, std::mt19937_64(5));
  return points;
}

}  // namespace

std::vector<Eigen::Vector2d> planar_input(std::string_view kind,
                                          std::size_t n) {
  if (kind == "grid") return grid(n, 0, 1);
  if (kind == "cocircular") return cocircular(n);
  if (kind == "curve") return curve(n);
  if (kind == "ulp_grid") return grid(n, 0.5, 0x1p-53);
  if (kind == "collinear") return collinear(n);
  if (kind == "uniform_1e80") return uniform(n, 1e80);
  if (kind == "uniform_1e-80") return uniform(n, 1e-80);
  return uniform(n, 1);
}

}  // namespace bench
