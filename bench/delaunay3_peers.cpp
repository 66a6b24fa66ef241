/// @file
/// Ours against CGAL in one process, run in turn: prints the median seconds of
/// both and the median of the ratios, which holds when the machine's speed
/// drifts. Usage: delaunay3_peers [RUNS [LARGEST_N]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "bench/cgal_delaunay3.h"
#include "delaunay/triangulation3.h"

namespace {

struct Input {
  const char* shape;
  std::size_t n;
  double noise;
};

// A sphere with noise of its spacing is a scan; without, it is rounded.
constexpr Input kInputs[] = {
    {"uniform", 1'000'000, 0},   {"torus", 1'000'000, 0.05},
    {"sphere", 1'000'000, 0.05}, {"bumpy", 400'000, 0},
    {"uniform", 100'000, 0},     {"grid", 1'000'000, 0},
    {"sphere", 10'000, 0},       {"cospherical", 10'000, 0}};

double median(std::vector<double> values) {
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void compare(const Input& input, int n_runs) {
  const auto points =
      shapes::sample(input.shape, input.n, {.noise = input.noise});
  std::vector<double> ours;
  std::vector<double> cgal;
  std::vector<double> ratios;
  for (int run = 0; run < n_runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const delaunay::Triangulation3 t(points);
    const std::chrono::duration<double> time =
        std::chrono::steady_clock::now() - start;
    const bench::CgalDelaunay3 peer = bench::cgal_delaunay3(points);
    if (peer.n_finite_cells != t.n_finite_cells())
      std::printf("cells differ: %zu, CGAL %zu\n", t.n_finite_cells(),
                  peer.n_finite_cells);
    ours.push_back(time.count());
    cgal.push_back(peer.seconds);
    ratios.push_back(time.count() / peer.seconds);
  }
  std::printf("%-12s %8zu %9.3f %9.3f %7.2f\n", input.shape, points.size(),
              median(ours), median(cgal), median(ratios));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::size_t largest =
      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t{1} << 40U;
  std::printf("%-12s %8s %9s %9s %7s\n", "input", "points", "ours s", "CGAL s",
              "ratio");
  for (const Input& input : kInputs)
    if (input.n <= largest) compare(input, n_runs);
}
