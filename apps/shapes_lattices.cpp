#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Int3 = std::array<std::int64_t, 3>;
using Pair = std::array<std::int64_t, 2>;

// pairs(k): every (a, b) with a^2 + b^2 = k, for k = 0 .. n.
class TwoSquares {
 public:
  explicit TwoSquares(std::int64_t n) : begin_(n + 2, 0) {
    for_all(n, [&](Pair, std::int64_t k) { ++begin_[k + 1]; });
    for (std::int64_t k = 0; k <= n; ++k) begin_[k + 1] += begin_[k];
    pairs_.resize(begin_.back());
    std::vector<std::size_t> end = begin_;
    for_all(n, [&](Pair p, std::int64_t k) { pairs_[end[k]++] = p; });
  }
  std::span<const Pair> pairs(std::int64_t k) const {
    return std::span(pairs_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
  }

 private:
  template <class Visit>
  static void for_all(std::int64_t n, const Visit& visit) {
    std::int64_t side = 0;
    while ((side + 1) * (side + 1) <= n) ++side;
    for (std::int64_t a = -side; a <= side; ++a)
      for (std::int64_t b = -side; b <= side; ++b)
        if (a * a + b * b <= n) visit({a, b}, a * a + b * b);
  }

  std::vector<std::size_t> begin_;
  std::vector<Pair> pairs_;
};

// The integer quaternions w + xi + yj + zk of norm m turn (0, 0, 1) into
// integer points at distance m: some 2 m different ones for odd m (Jacobi's
// four-square theorem, and four quaternions to a point).
std::vector<Int3> points_of_sphere(std::int64_t m) {
  const TwoSquares sums(m);
  std::vector<Int3> points;
  for (std::int64_t k = 0; k <= m; ++k)
    for (const auto& [w, z] : sums.pairs(k))
      for (const auto& [x, y] : sums.pairs(m - k))
        points.push_back({2 * (x * z + w * y), 2 * (y * z - w * x),
                          w * w + z * z - x * x - y * y});
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Of the smallest cubic lattice with n points or more.
std::size_t lattice_side(std::size_t n) {
  std::size_t side = 1;
  while (side * side * side < n) ++side;
  return side;
}

}  // namespace

std::vector<Site> uniform(std::size_t n, Random& random) {
  const double spacing = 1 / static_cast<double>(lattice_side(n));
  std::vector<Site> sites(n);
  for (Site& site : sites) {
    for (double& coordinate : site.position) coordinate = random.unit();
    site.spacing = spacing;
  }
  return sites;
}

std::vector<Site> lattice(std::size_t n) {
  const std::size_t side = lattice_side(n);
  std::vector<Site> sites;
  sites.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<std::size_t, 3> p = {i / (side * side), i / side % side,
                                          i % side};
    sites.push_back({{static_cast<double>(p[0]), static_cast<double>(p[1]),
                      static_cast<double>(p[2])},
                     1});
  }
  return sites;
}

std::vector<Site> lattice_sphere(std::size_t n, Random& random) {
  // 1, 3, 5 ... hold no fewer than 6 points each.
  std::int64_t m = static_cast<std::int64_t>(n / 2) | 1;
  std::vector<Int3> points = points_of_sphere(m);
  while (points.size() < n) points = points_of_sphere(m += 2);
  const double spacing =
      static_cast<double>(m) * std::sqrt(12 / static_cast<double>(n + 1));
  std::vector<Site> sites;
  sites.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {  // Fisher and Yates, cut after n
    std::swap(points[i], points[i + random.below(points.size() - i)]);
    const auto& [x, y, z] = points[i];
    sites.push_back({{static_cast<double>(x), static_cast<double>(y),
                      static_cast<double>(z)},
                     spacing});
  }
  return sites;
}

}  // namespace shapes
