/// @file
/// Ours against CGAL in the plane, in one process and in turn: prints the
/// median seconds of both and the median of the ratios, which holds when the
/// machine's speed drifts. Usage: delaunay2_peers [RUNS [POINTS [KIND]]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/cgal_delaunay2.h"
#include "bench/planar_inputs.h"
#include "delaunay/triangulation2.h"

namespace {

double median(std::vector<double> values) {
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void compare(std::string_view kind, std::size_t n, int n_runs) {
  const auto points = bench::planar_input(kind, n);
  std::vector<double> ours, cgal, ratios;
  for (int run = 0; run < n_runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const delaunay::Triangulation2 t(points);
    const std::chrono::duration<double> time =
        std::chrono::steady_clock::now() - start;
    const bench::CgalDelaunay2 peer = bench::cgal_delaunay2(points);
    if (peer.n_finite_cells != t.n_finite_cells())
      std::printf("cells differ: %zu, CGAL %zu\n", t.n_finite_cells(),
                  peer.n_finite_cells);
    ours.push_back(time.count());
    cgal.push_back(peer.seconds);
    ratios.push_back(time.count() / peer.seconds);
  }
  std::printf("%-14s %8zu %9.3f %9.3f %7.2f\n", std::string(kind).c_str(),
              points.size(), median(ours), median(cgal), median(ratios));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::size_t n =
      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1'000'000;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf("%-14s %8s %9s %9s %7s\n", "input", "points", "ours s", "CGAL s",
              "ratio");
  // CGAL takes quadratic time on a line.
  constexpr std::size_t kMaxCollinear = 20'000;
  for (const std::string_view kind : bench::kPlanarInputs)
    if (only.empty() || kind == only)
      compare(kind, kind == "collinear" ? std::min(n, kMaxCollinear) : n,
              n_runs);
}
