/// @file
/// How the 3D construction scales on uniform points: nanoseconds a point over
/// sizes on one thread, and seconds over numbers of threads; user and wall
/// (bench/seconds.h), and the peak of resident memory it adds.
/// Usage: delaunay3_scaling growth [LARGEST_N]
///        delaunay3_scaling threads [RUNS [N]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "bench/memory.h"
#include "bench/seconds.h"
#include "delaunay/triangulation3.h"

namespace {

bench::Seconds seconds(const std::vector<Eigen::Vector3d>& points,
                       unsigned threads) {
  return bench::seconds_of(
      [&] { return delaunay::Triangulation3(points, threads); },
      [](const auto&) {});
}

void print_growth(std::size_t largest) {
  std::printf("%9s %8s %8s %8s\n", "points", "user ns", "wall ns", "MB");
  for (std::size_t n = 10'000; n <= largest; n *= 10) {
    const auto points = shapes::sample("uniform", n);
    bench::reset_peak_memory();
    const double before = bench::resident_memory();
    const bench::Seconds each =
        seconds(points, 1) / (1e-9 * static_cast<double>(n));
    std::printf("%9zu %8.0f %8.0f %8.0f\n", n, each.user, each.wall,
                bench::peak_memory() - before);
    std::fflush(stdout);
  }
}

/// Numbers of threads in turn, and the least wall time of each: other programs
/// on the machine can only add to it.
void print_threads(int n_runs, std::size_t n) {
  const std::vector<unsigned> threads = {1, 2, 4};
  const auto points = shapes::sample("uniform", n);
  std::vector<bench::Seconds> best(threads.size(), {1e9, 1e9});
  for (int run = 0; run < n_runs; ++run)
    for (std::size_t i = 0; i < threads.size(); ++i)
      best[i] = std::min(
          best[i], seconds(points, threads[i]),
          [](const auto& a, const auto& b) { return a.wall < b.wall; });
  std::printf("%7s %8s %8s %10s\n", "threads", "user s", "wall s", "of one's");
  for (std::size_t i = 0; i < threads.size(); ++i)
    std::printf("%7u %8.3f %8.3f %10.2f\n", threads[i], best[i].user,
                best[i].wall, best[i].wall / best[0].wall);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto number = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  if (what == "growth") {
    print_growth(number(2, 10'000'000));
  } else if (what == "threads") {
    print_threads(static_cast<int>(number(2, 5)), number(3, 1'000'000));
  } else {
    std::fprintf(stderr, "usage: %s growth [LARGEST_N] | threads [RUNS [N]]\n",
                 argv[0]);
    return 2;
  }
}
