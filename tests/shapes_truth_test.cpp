#include "apps/shapes_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/shapes.h"

namespace shapes {
namespace {

using Eigen::Vector3d;

std::vector<std::string> surfaces() {
  std::vector<std::string> names;
  for (const Shape& shape : all())
    if (shape.dimension == 3 && truth(shape.name))
      names.emplace_back(shape.name);
  return names;
}

TEST(Truth, IsKnownOfTheClosedSurfaces) {
  EXPECT_EQ(surfaces(), (std::vector<std::string>{
                            "knot", "3holes", "sphere", "torus", "ellipsoid",
                            "bumpy", "cube", "plate", "two-spheres"}));
  EXPECT_FALSE(truth("two-sheets"));
  EXPECT_FALSE(truth("circle"));
  EXPECT_THROW(truth("teapot"), std::invalid_argument);
}

TEST(Truth, IsAtDistanceZeroFromItsSamples) {
  for (const std::string& name : surfaces()) {
    SCOPED_TRACE(name);
    const auto known = truth(name);
    for (const Vector3d& p : sample(name, 300, {.noise = 0}))
      EXPECT_LT(known->distance(p), 1e-9);
  }
}

// From a point near the surface, the distance to the nearest of many samples is
// the distance to the surface and a little more.
TEST(Truth, IsTheDistanceToTheNearestOfManySamples) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const std::string& name : surfaces()) {
    SCOPED_TRACE(name);
    const auto known = truth(name);
    const auto dense = sample(name, 12000, {.seed = 2, .noise = 0});
    for (const Vector3d& p : sample(name, 20, {.noise = 0})) {
      const Vector3d q = p + 0.05 * Vector3d(unit(rng), unit(rng), unit(rng));
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& s : dense)
        nearest = std::min(nearest, (s - q).norm());
      const double slack = known->is_exact ? 1e-12 : 4e-3;
      EXPECT_LE(known->distance(q), nearest + slack);
      EXPECT_GE(known->distance(q) * known->distance(q) + 0.04 * 0.04,
                nearest * nearest - slack);
    }
  }
}

}  // namespace
}  // namespace shapes
