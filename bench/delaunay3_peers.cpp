/// @file
/// Ours against CGAL in one process, run in turn: prints the median user and
/// wall seconds of both (bench/seconds.h), the medians of their ratios, which
/// hold when the machine's speed drifts, and by how much each raises the peak
/// of resident memory, in MB.
/// Usage: delaunay3_peers [RUNS [LARGEST_N [INPUT]]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "bench/cgal_delaunay3.h"
#include "bench/comparison.h"
#include "bench/memory.h"
#include "delaunay/triangulation3.h"
#include "io/points.h"

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

constexpr const char* kDragon = "data/real/dragon_vrip.ply";

/// By how much `run` raises the peak.
template <class Run>
double added_memory(const Run& run) {
  bench::reset_peak_memory();
  const double before = bench::resident_memory();
  run();
  return bench::peak_memory() - before;
}

void compare(const char* name, const std::vector<Eigen::Vector3d>& points,
             int n_runs) {
  bench::Comparison comparison;
  double our_memory = 0;
  double cgal_memory = 0;
  for (int run = 0; run < n_runs; ++run) {
    std::size_t n_cells = 0;
    bench::Seconds ours;
    bench::CgalDelaunay3 peer{};
    our_memory = std::max(
        our_memory, added_memory([&] {
          ours = bench::seconds_of(
              [&points] { return delaunay::Triangulation3(points); },
              [&n_cells](const auto& t) { n_cells = t.n_finite_cells(); });
        }));
    cgal_memory =
        std::max(cgal_memory,
                 added_memory([&] { peer = bench::cgal_delaunay3(points); }));
    if (peer.n_finite_cells != n_cells)
      std::printf("cells differ: %zu, CGAL %zu\n", n_cells,
                  peer.n_finite_cells);
    comparison.add(ours, peer.seconds);
  }
  std::printf("%-12s %8zu %s %8.0f %8.0f\n", name, points.size(),
              comparison.row().c_str(), our_memory, cgal_memory);
  std::fflush(stdout);
}

void compare_shapes(int n_runs, std::size_t largest, const std::string& only) {
  for (const Input& input : kInputs)
    if (input.n <= largest && (only.empty() || only == input.shape))
      compare(input.shape,
              shapes::sample(input.shape, input.n, {.noise = input.noise}),
              n_runs);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::size_t largest =
      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t{1} << 40U;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf("%-12s %8s %s %8s %8s\n", "input", "points",
              bench::Comparison::header().c_str(), "ours MB", "CGAL MB");
  compare_shapes(n_runs, largest, only);
  if (!only.empty() && only != "dragon_vrip") return 0;
  if (std::filesystem::exists(kDragon))
    compare("dragon_vrip", io::read_points(kDragon).points, n_runs);
  else
    std::printf("%s is missing: scripts/fetch_data.sh gets it\n", kDragon);
}
