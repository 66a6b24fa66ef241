// How samples come to obey the statements of [Adamy02, Sec. 3.1] as they grow
// denser: curve_theory > FILE.csv, for scripts/plot_curve_theory.py. The rows
// are curve, epsilon, points, and over all trials: the share of samples that
// the filter gets right, the share with all right edges in the Delaunay
// triangulation, the largest lower bound of a right edge, the share of right
// edges that are Gabriel, and of wrong edges the least max(lower, 1 - upper).

#include "tests/support/curve_theory.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "tests/support/curve_instances.h"
#include "umbrella/curve.h"

namespace {

struct Row {
  double points = 0, exact = 0, delaunay = 0, lower = 0, gabriel = 0;
  double wrong = 1;
};

bool is_exact(const std::vector<Eigen::Vector2d>& sample) {
  const auto n = static_cast<std::uint32_t>(sample.size());
  std::vector<tests::CurveEdge> truth;
  for (std::uint32_t i = 0; i < n; ++i) truth.push_back({i, (i + 1) % n});
  return tests::in_order(umbrella::reconstruct_curve(
                             sample, {.mode = umbrella::CurveMode::Paper})
                             .edges) == tests::in_order(truth);
}

Row measure(std::string_view curve, double epsilon, int n_trials) {
  std::mt19937_64 rng(1);
  Row row;
  double n_right = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const auto sample = tests::sample_curve(curve, epsilon, rng);
    std::size_t n_missing = 0;
    const auto edges = tests::edge_intervals(sample, n_missing);
    row.points += static_cast<double>(sample.size()) / n_trials;
    row.exact += is_exact(sample) ? 1.0 / n_trials : 0;
    row.delaunay += n_missing == 0 ? 1.0 / n_trials : 0;
    for (const tests::EdgeInterval& edge : edges) {
      if (edge.is_right) {
        row.lower = std::max(row.lower, edge.lower);
        row.gabriel += edge.upper == 1 ? 1 : 0;
        ++n_right;
      } else {
        row.wrong = std::min(row.wrong, std::max(edge.lower, 1 - edge.upper));
      }
    }
  }
  row.gabriel /= n_right;
  return row;
}

}  // namespace

int main() {
  std::puts("curve,epsilon,points,exact,delaunay,lower,gabriel,wrong");
  for (const auto curves : {tests::regular_curves(), tests::benign_curves()}) {
    for (const std::string_view curve : curves) {
      for (double epsilon = 0.064; epsilon > 4e-4; epsilon /= 1.4142135623731) {
        const Row row = measure(curve, epsilon, 50);
        std::printf("%s,%.6f,%.1f,%.4f,%.4f,%.6g,%.5f,%.6g\n",
                    std::string(curve).c_str(), epsilon, row.points, row.exact,
                    row.delaunay, row.lower, row.gabriel, row.wrong);
      }
    }
  }
}
