#include "tests/support/curve_theory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_filter.h"

namespace tests {
namespace {

using delaunay::Cell2;
using delaunay::Triangulation2;
using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

constexpr std::array<std::string_view, 3> kRegular = {"circle", "ellipse",
                                                      "wave"};
constexpr std::array<std::string_view, 3> kBenign = {"square", "drop", "star"};

std::vector<Vector2d> polygon(std::string_view curve) {
  std::vector<Vector2d> corners;
  if (curve == "square") return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (curve == "star") {
    for (int i = 0; i < 10; ++i) {
      const double r = i % 2 == 0 ? 1 : 0.4;
      corners.emplace_back(r * std::cos(kPi * i / 5),
                           r * std::sin(kPi * i / 5));
    }
    return corners;
  }
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * kPi * i / kSteps;
    const double r = curve == "wave" ? 1 + 0.3 * std::cos(5 * t) : 1;
    const double flat = curve == "ellipse" ? 0.3 : 1;
    corners.emplace_back(r * std::cos(t), flat * r * std::sin(t));
  }
  if (curve == "drop") {  // half a circle, and a corner of 45 degrees
    std::erase_if(corners,
                  [](const Vector2d& p) { return p.x() > std::sin(kPi / 8); });
    corners.insert(corners.begin(), Vector2d(1 / std::sin(kPi / 8), 0));
    std::ranges::sort(corners.begin() + 1, corners.end(), {},
                      [](const Vector2d& p) {
                        const double a = std::atan2(p.y(), p.x());
                        return a < 0 ? a + 2 * kPi : a;
                      });
  }
  return corners;
}

}  // namespace

std::span<const std::string_view> regular_curves() { return kRegular; }
std::span<const std::string_view> benign_curves() { return kBenign; }

std::vector<Vector2d> sample_curve(std::string_view curve, double epsilon,
                                   std::mt19937_64& rng) {
  if (std::ranges::count(kRegular, curve) +
          std::ranges::count(kBenign, curve) ==
      0)
    throw std::invalid_argument("no curve: " + std::string(curve));
  const std::vector<Vector2d> corners = polygon(curve);
  const std::size_t n = corners.size();
  double total = 0;
  for (std::size_t i = 0; i < n; ++i)
    total += (corners[(i + 1) % n] - corners[i]).norm();

  // Steps of up to 2 epsilon along the curve, the last one to the first point.
  std::uniform_real_distribution<double> step(0.2, 2);
  std::vector<Vector2d> points;
  double at = epsilon * step(rng) / 2;
  const double last = 1 - 2 * epsilon + at;
  double passed = 0;
  for (std::size_t i = 0; i < n && at <= std::max(last, 0.0) + 2 * epsilon;
       ++i) {
    const Vector2d side = corners[(i + 1) % n] - corners[i];
    const double length = side.norm() / total;
    for (; at < passed + length; at += epsilon * step(rng))
      points.push_back((corners[i] + (at - passed) / length * side) / total);
    passed += length;
  }
  return points;
}

std::vector<EdgeInterval> edge_intervals(const std::vector<Vector2d>& sample,
                                         std::size_t& n_missing) {
  const Triangulation2 t(sample);
  const auto n = static_cast<std::uint32_t>(sample.size());
  std::vector<std::uint32_t> row(n);
  for (std::uint32_t i = 0; i < n; ++i) row[index(t.vertex_of_row()[i])] = i;
  const auto sine = [&](const Cell2& cell, unsigned i) {
    if (cell.vertex[i] == delaunay::kInfinite) return 0.0;
    const auto& [j, k] = delaunay::kSideCorners[i];
    const Vector2d u = t.point(cell.vertex[j]) - t.point(cell.vertex[i]);
    const Vector2d v = t.point(cell.vertex[k]) - t.point(cell.vertex[i]);
    return std::abs(u.x() * v.y() - u.y() * v.x()) / (u.norm() * v.norm());
  };
  std::vector<EdgeInterval> intervals;
  n_missing = n;
  const auto edges = umbrella::delaunay_edges(t);
  for (std::uint32_t c = 0; c < t.n_finite_cells(); ++c) {
    const Cell2& cell = t.cells()[c];
    for (unsigned i = 0; i < 3; ++i) {
      const delaunay::Side there = cell.neighbor[i];
      if (there.cell() < delaunay::CellId{c}) continue;
      umbrella::Edge ends = {cell.vertex[delaunay::kSideCorners[i][0]],
                             cell.vertex[delaunay::kSideCorners[i][1]]};
      std::ranges::sort(ends);
      const auto edge = std::ranges::lower_bound(edges, ends, {},
                                                 &umbrella::DelaunayEdge::ends);
      const double other =
          std::max(sine(cell, i), sine(t.cell(there.cell()), there.index()));
      const std::uint32_t gap =
          (row[index(ends[0])] + n - row[index(ends[1])]) % n;
      const bool is_right = gap == 1 || gap == n - 1;
      n_missing -= is_right ? 1 : 0;
      intervals.push_back(
          {edge->lambda_lower, edge->is_gabriel ? 1 : other, is_right});
    }
  }
  return intervals;
}

std::vector<Vector2d> cusp_sample(unsigned n) {
  const double m = n;
  const auto on_parabola = [](double x) { return Vector2d(x, x * x); };
  std::vector<Vector2d> points = {{1 / m, 0},
                                  on_parabola(1 / (m * m * m)),
                                  on_parabola(2 / (m * m * m)),
                                  on_parabola(1 / (m * m))};
  for (unsigned i = 2; i <= n; ++i) {
    points.emplace_back(i / m, 0);
    points.push_back(on_parabola(i / m));
  }
  // From (1, 1) to (1, 0), around below.
  const std::array<Vector2d, 6> corners = {Vector2d(1, 1),    Vector2d(2, 1),
                                           Vector2d(2, -1),   Vector2d(0, -1),
                                           Vector2d(1, -0.5), Vector2d(1, 0)};
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    for (unsigned i = 1; i <= n; ++i)
      if (k + 2 < corners.size() || i < n)
        points.emplace_back(corners[k] + i / m * (corners[k + 1] - corners[k]));
  return points;
}

}  // namespace tests
