// Sets that are no sample of any surface: each of dimension 3 closes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string_view>
#include <vector>

#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

using Rng = std::mt19937_64;
using Points = std::vector<Point3>;

double unit(Rng& rng) {
  return std::uniform_real_distribution<double>(-1, 1)(rng);
}

/// Of any size that squares to a double.
double any_size(Rng& rng) { return std::pow(10.0, 150 * unit(rng)); }

double whole(Rng& rng, std::uint64_t n) {
  return static_cast<double>(rng() % n);
}

Point3 random_point(Rng& rng) {
  const double x = unit(rng), y = unit(rng), z = unit(rng);
  return {x, y, z};
}

struct Kind {
  std::string_view name;
  std::function<Points(Rng&, std::size_t)> make;
};

/// n times what `one` gives.
Points repeat(std::size_t n, const std::function<Point3()>& one) {
  Points points(n);
  std::generate(points.begin(), points.end(), one);
  return points;
}

Points on_lattice(Rng& rng, std::size_t n) {
  const std::uint64_t side = 2 + rng() % 4;
  return repeat(n, [&] {
    const double x = whole(rng, side), y = whole(rng, side);
    return Point3(x, y, whole(rng, side));
  });
}

Points flat_but_one(Rng& rng, std::size_t n) {
  Points points = repeat(n, [&] {
    const double x = whole(rng, 9), y = whole(rng, 9);
    return Point3(x, y, 0);
  });
  points.back() = random_point(rng);
  return points;
}

Points nearly_flat(Rng& rng, std::size_t n) {
  const double height = std::pow(10.0, -20 + 15 * unit(rng));
  return repeat(n, [&] {
    const double x = whole(rng, 9), y = whole(rng, 9);
    return Point3(x, y, height * unit(rng));
  });
}

Points huge_or_tiny(Rng& rng, std::size_t n) {
  const double size = any_size(rng) * any_size(rng);
  return repeat(n, [&] { return Point3(size * random_point(rng)); });
}

Points of_all_sizes(Rng& rng, std::size_t n) {
  return repeat(n, [&] {
    const double x = any_size(rng), y = any_size(rng), z = any_size(rng);
    return Point3(x * unit(rng), y, z);
  });
}

/// With coordinates 1, 4 and 8: all at distance 9 of the origin.
Points on_one_sphere(Rng& rng, std::size_t n) {
  return repeat(n, [&] {
    std::array<double, 3> x = {1, 4, 8};
    std::shuffle(x.begin(), x.end(), rng);
    for (double& c : x) c = rng() % 2 == 0 ? c : -c;
    return Point3(x[0], x[1], x[2]);
  });
}

Points on_skew_lines(Rng& rng, std::size_t n) {
  return repeat(n, [&] {
    const double t = unit(rng);
    return rng() % 2 == 0 ? Point3(t, 0, 0) : Point3(0, t, 1);
  });
}

Points in_far_clusters(Rng& rng, std::size_t n) {
  const double size = std::pow(10.0, -8 + 7 * unit(rng));
  const Points centres = repeat(3, [&] { return random_point(rng); });
  return repeat(n, [&] {
    const Point3& centre = centres[rng() % centres.size()];
    return Point3(centre + size * random_point(rng));
  });
}

const std::array<Kind, 9> kKinds = {
    Kind{"uniform",
         [](Rng& rng, std::size_t n) {
           return repeat(n, [&] { return random_point(rng); });
         }},
    Kind{"on a lattice", on_lattice},
    Kind{"flat but one", flat_but_one},
    Kind{"nearly flat", nearly_flat},
    Kind{"huge or tiny", huge_or_tiny},
    Kind{"of all sizes", of_all_sizes},
    Kind{"on one sphere", on_one_sphere},
    Kind{"on skew lines", on_skew_lines},
    Kind{"in far clusters", in_far_clusters}};

void expect_closed(const Reconstruction& result, std::size_t n_rows) {
  EXPECT_TRUE(result.surface.closed);
  EXPECT_TRUE(result.surface.manifold);
  EXPECT_TRUE(result.surface.oriented);
  EXPECT_EQ(result.surface.unused_vertices.size(), result.dropped_rows.size());
  EXPECT_EQ(result.drop_reasons.size(), result.dropped_rows.size());
  EXPECT_EQ(result.surface.vertices + result.dropped_rows.size() +
                result.counts.duplicates,
            n_rows);
}

void expect_closed_sets(std::uint64_t seed, int n_trials) {
  Rng rng(seed);
  for (int trial = 0; trial < n_trials; ++trial)
    for (const Kind& kind : kKinds) {
      SCOPED_TRACE(testing::Message() << kind.name << ", trial " << trial);
      const Points points = kind.make(rng, 4 + rng() % 47);
      const Reconstruction one = reconstruct(points);
      if (one.dimension < 3) {
        EXPECT_TRUE(one.triangles.empty());
        continue;
      }
      expect_closed(one, points.size());
      ReconstructOptions options;
      options.threads = options.closing.threads = 2;
      EXPECT_EQ(reconstruct(points, options).triangles, one.triangles);
      if (testing::Test::HasFailure()) return;
    }
}

TEST(HardInputs, OfFewPointsClose) { expect_closed_sets(20261122, 6); }

TEST(SlowHardInputs, OfFewPointsClose) { expect_closed_sets(20261123, 100); }

Points in_cube(Rng& rng, std::size_t n) {
  return repeat(n, [&] { return random_point(rng); });
}

Points on_cubic_lattice(Rng&, std::size_t n) {
  const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(n)));
  Points points(side * side * side);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {static_cast<double>(i % side),
                 static_cast<double>(i / side % side),
                 static_cast<double>(i / side / side)};
  return points;
}

Points about_a_sphere(Rng& rng, std::size_t n) {
  return repeat(n, [&] {
    const Point3 p = random_point(rng).normalized();
    return Point3((1 + 0.05 * unit(rng)) * p);
  });
}

Points in_balls_on_a_sphere(Rng& rng, std::size_t n) {
  const double radius = std::sqrt(30.0 / static_cast<double>(n));
  Point3 centre = Point3::UnitX();
  std::size_t i = 0;
  return repeat(n, [&]() -> Point3 {
    if (i++ % 150 == 0) centre = random_point(rng).normalized();
    if (i % 150 < 30) return centre + radius * random_point(rng);
    return random_point(rng).normalized();
  });
}

/// Of a region, twice, the second time for leaving points out; and of the local
/// repair, which may take as much as two, and the bores, as much as one. The
/// last program of each may take what it costs to make it too much.
std::uint64_t most_propagations(const ReconstructOptions& options,
                                const Reconstruction& result) {
  constexpr std::uint64_t kForMaking = 6;
  const ClosingOptions& closing = options.closing;
  const std::uint64_t once =
      closing.propagations * result.closing.regions +
      closing.propagations_per_vertex * result.surface.vertices;
  const std::uint64_t repair =
      closing.propagations +
      closing.propagations_per_vertex * result.surface.vertices;
  return 2 * once + 3 * repair + 2 * kForMaking * result.closing.variables;
}

// Whatever the points are, and however hard. There is so little effort that all
// of it is taken.
TEST(SlowHardInputs, TakeEffortInProportionToTheirNumber) {
  ReconstructOptions options;
  options.closing.propagations = 20'000;
  options.closing.propagations_per_vertex = 15;
  for (const Kind& kind :
       {Kind{"cube", in_cube}, Kind{"grid", on_cubic_lattice},
        Kind{"about a sphere", about_a_sphere},
        Kind{"balls on a sphere", in_balls_on_a_sphere}})
    for (const std::size_t n : {1000U, 8000U}) {
      SCOPED_TRACE(testing::Message() << kind.name << ", n " << n);
      Rng rng(n);
      const Points points = kind.make(rng, n);
      const Reconstruction result = reconstruct(points, options);
      expect_closed(result, points.size());
      EXPECT_GT(result.closing.propagations, 0U);
      EXPECT_LE(result.closing.propagations,
                most_propagations(options, result));
    }
}

}  // namespace
}  // namespace umbrella
