// The paper's own suggestion: the clean-up and the closing after another
// reconstruction [Adamy02, Sec. 3.2].

#include <gtest/gtest.h>

#include <vector>

#include "apps/shapes.h"
#include "tests/support/cgal_front.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

struct Repaired {
  SurfaceReport before;
  Reconstruction after;
};

Repaired repaired_front(const std::vector<Point3>& points) {
  const auto faces = tests::advancing_front(points);
  ReconstructOptions options;
  options.faces = faces;
  return {check_surface(points, faces), reconstruct(points, options)};
}

TEST(RepairFront, KeepsAGoodFront) {
  const Repaired torus = repaired_front(shapes::sample("torus", 2000, {}));
  EXPECT_EQ(torus.after.faces.not_delaunay, 0U);  // it chooses from the same
  EXPECT_TRUE(torus.after.surface.closed && torus.after.surface.manifold);
  EXPECT_EQ(torus.after.surface.genus, 1);
  EXPECT_TRUE(torus.after.surface.unused_vertices.empty());
}

TEST(RepairFront, ClosesAFrontThatLeavesPointsOut) {
  std::size_t n_left_out = 0;
  for (const char* shape : {"cube", "3holes", "plate"})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(testing::Message() << shape << ", seed " << seed);
      const Repaired mesh = repaired_front(
          shapes::sample(shape, 1500, {.seed = seed, .noise = 0.15}));
      n_left_out += mesh.before.unused_vertices.size();
      EXPECT_TRUE(mesh.after.surface.closed && mesh.after.surface.manifold);
      EXPECT_TRUE(mesh.after.surface.unused_vertices.empty());
    }
  EXPECT_GT(n_left_out, 0U);
}

}  // namespace
}  // namespace umbrella
