#include "bench/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace mesh_distance {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : rng_(seed) {}
  Point point() {
    const double x = unit_(rng_), y = unit_(rng_);
    return {x, y, unit_(rng_)};
  }
  std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>(rng_() % n);
  }

 private:
  std::mt19937_64 rng_;
  std::uniform_real_distribution<double> unit_{-1, 1};
};

TEST(PointToTriangle, IsTheLeastOfManyPointsOfIt) {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const std::array<Point, 3> abc = {random.point(), random.point(),
                                      random.point()};
    const Point p = random.point();
    double least = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; i + k <= kSteps; ++k) {
        const Point q =
            (i * abc[0] + k * abc[1] + (kSteps - i - k) * abc[2]) / kSteps;
        least = std::min(least, (p - q).norm());
      }
    const double distance = point_to_triangle(p, abc);
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 0.02);
  }
}

TEST(Tree, FindsTheNearestOfAllTriangles) {
  Random random(5);
  for (const std::size_t n : {0, 1, 2, 3, 7, 64, 100}) {
    SCOPED_TRACE(n);
    std::vector<Point> points(40);
    for (Point& p : points) p = random.point();
    std::vector<Corners> triangles(n);
    for (Corners& t : triangles)
      for (std::uint32_t& v : t) v = random.below(40);
    const Tree tree(points, triangles);
    for (int probe = 0; probe < 20; ++probe) {
      const Point p = 2 * random.point();
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : triangles)
        least = std::min(
            least, point_to_triangle(p, {points[a], points[b], points[c]}));
      EXPECT_TRUE(tree.distance(p) == least ||
                  std::abs(tree.distance(p) - least) < 1e-12);
    }
  }
}

}  // namespace
}  // namespace mesh_distance
