/// @file
/// Ours against CGAL in one process, run in turn: prints the median seconds of
/// both and the median of the ratios, which holds when the machine's speed
/// drifts; and by how much each raises the peak of resident memory, in MB.
/// Usage: delaunay3_peers [RUNS [LARGEST_N]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "bench/cgal_delaunay3.h"
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

/// A number of /proc/self/status in MB; 0 where the system has none.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":"))
      return std::atof(line.c_str() + name.size() + 1) * 1024e-6;
  return 0;
}

/// Seconds it takes, and how much memory it adds at its peak.
struct Cost {
  double seconds;
  double megabytes;
};

template <class Run>
Cost cost(Run run) {
  std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
  const double before = memory("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  run();
  const std::chrono::duration<double> time =
      std::chrono::steady_clock::now() - start;
  return {time.count(), memory("VmHWM") - before};
}

double median(std::vector<double> values) {
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void compare(const char* name, const std::vector<Eigen::Vector3d>& points,
             int n_runs) {
  std::vector<double> ours, cgal, ratios;
  double our_memory = 0;
  double cgal_memory = 0;
  for (int run = 0; run < n_runs; ++run) {
    std::size_t n_cells = 0;
    bench::CgalDelaunay3 peer{};
    const Cost our_cost = cost(
        [&] { n_cells = delaunay::Triangulation3(points).n_finite_cells(); });
    const Cost cgal_cost = cost([&] { peer = bench::cgal_delaunay3(points); });
    if (peer.n_finite_cells != n_cells)
      std::printf("cells differ: %zu, CGAL %zu\n", n_cells,
                  peer.n_finite_cells);
    ours.push_back(our_cost.seconds);
    cgal.push_back(peer.seconds);
    ratios.push_back(our_cost.seconds / peer.seconds);
    our_memory = std::max(our_memory, our_cost.megabytes);
    cgal_memory = std::max(cgal_memory, cgal_cost.megabytes);
  }
  std::printf("%-12s %8zu %9.3f %9.3f %7.2f %8.0f %8.0f\n", name, points.size(),
              median(ours), median(cgal), median(ratios), our_memory,
              cgal_memory);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::size_t largest =
      argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t{1} << 40U;
  std::printf("%-12s %8s %9s %9s %7s %8s %8s\n", "input", "points", "ours s",
              "CGAL s", "ratio", "ours MB", "CGAL MB");
  for (const Input& input : kInputs)
    if (input.n <= largest)
      compare(input.shape,
              shapes::sample(input.shape, input.n, {.noise = input.noise}),
              n_runs);
  if (std::filesystem::exists(kDragon))
    compare("dragon_vrip", io::read_points(kDragon).points, n_runs);
  else
    std::printf("%s is missing: scripts/fetch_data.sh gets it\n", kDragon);
}
