/// @file
/// How the 3D construction scales on uniform points: nanoseconds a point over
/// sizes on one thread, and seconds over numbers of threads; user and wall
/// (bench/seconds.h), and the peak of resident memory it adds.
/// Usage: delaunay3_scaling growth [LARGEST_N]
///        delaunay3_scaling threads [RUNS [N]]
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
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

/// Processor seconds, user and system, of the thread that calls this.
double caller_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) +
         1e-9 * static_cast<double>(time.tv_nsec);
}

/// The calling thread does what one thread has to do alone, and its share of
/// the rest. So its seconds are what an idle machine would take, also while
/// others keep the processors busy; wall seconds hold for an idle one only.
struct Times {
  double user = 0, caller = 0, wall = 0;
};

Times times(const std::vector<Eigen::Vector3d>& points, unsigned threads) {
  const double before = caller_seconds();
  const bench::Seconds start = bench::now();
  const delaunay::Triangulation3 t(points, threads);
  const bench::Seconds all = bench::now() - start;
  return {all.user, caller_seconds() - before, all.wall};
}

/// Numbers of threads in turn, and medians of each.
void print_threads(int n_runs, std::size_t n) {
  const auto points = shapes::sample("uniform", n);
  constexpr std::array<unsigned, 3> kThreads = {1, 2, 4};
  std::array<std::vector<Times>, kThreads.size()> runs;
  for (int run = 0; run < n_runs; ++run)
    for (std::size_t i = 0; i < kThreads.size(); ++i)
      runs[i].push_back(times(points, kThreads[i]));

  const auto median = [](std::vector<Times> all, double Times::*column) {
    std::ranges::sort(all, {}, column);
    return all[all.size() / 2].*column;
  };
  std::printf("%7s %8s %8s %8s   of one thread's\n", "threads", "user s",
              "caller s", "wall s");
  for (std::size_t i = 0; i < kThreads.size(); ++i) {
    std::printf("%7u", kThreads[i]);
    for (const auto column : {&Times::user, &Times::caller, &Times::wall})
      std::printf(" %8.3f", median(runs[i], column));
    for (const auto column : {&Times::user, &Times::caller, &Times::wall})
      std::printf(" %5.2f", median(runs[i], column) / median(runs[0], column));
    std::printf("\n");
  }
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
