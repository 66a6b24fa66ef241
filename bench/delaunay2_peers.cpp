/// @file
/// Ours against CGAL in the plane, in one process and in turn: prints the
/// median user and wall seconds of both (bench/seconds.h) and the medians of
/// their ratios, which hold when the machine's speed drifts.
/// Usage: delaunay2_peers [RUNS [POINTS [KIND]]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/cgal_delaunay2.h"
#include "bench/comparison.h"
#include "bench/planar_inputs.h"
#include "delaunay/triangulation2.h"

namespace {

void compare(std::string_view kind, std::size_t n, int n_runs) {
  const auto points = bench::planar_input(kind, n);
  bench::Comparison comparison;
  for (int run = 0; run < n_runs; ++run) {
    std::size_t n_cells = 0;
    const bench::Seconds ours = bench::seconds_of(
        [&points] { return delaunay::Triangulation2(points); },
        [&n_cells](const auto& t) { n_cells = t.n_finite_cells(); });
    const bench::CgalDelaunay2 peer = bench::cgal_delaunay2(points);
    if (peer.n_finite_cells != n_cells)
      std::printf("cells differ: %zu, CGAL %zu\n", n_cells,
                  peer.n_finite_cells);
    comparison.add(ours, peer.seconds);
  }
  std::printf("%-14s %8zu %s\n", std::string(kind).c_str(), points.size(),
              comparison.row().c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::size_t n =
      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1'000'000;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf("%-14s %8s %s\n", "input", "points",
              bench::Comparison::header().c_str());
  // CGAL takes quadratic time on a line.
  constexpr std::size_t kMaxCollinear = 20'000;
  for (const std::string_view kind : bench::kPlanarInputs)
    if (only.empty() || kind == only)
      compare(kind, kind == "collinear" ? std::min(n, kMaxCollinear) : n,
              n_runs);
}
