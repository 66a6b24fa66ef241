// Handles that are left once the short loops have been dealt with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/essential_loops_internal.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

/// Tori of 3, 4, ... squares round and so many along, each cut along a
/// diagonal; one after the other.
constexpr std::uint32_t kLeast = 3, kMost = 8, kAlong = 20;

std::uint32_t first_of(std::uint32_t around) {
  std::uint32_t first = 0;
  for (std::uint32_t k = kLeast; k < around; ++k) first += k * kAlong;
  return first;
}

std::vector<Triangle> tori() {
  std::vector<Triangle> triangles;
  for (std::uint32_t k = kLeast; k <= kMost; ++k) {
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
      return VertexId{first_of(k) + j % kAlong * k + i % k};
    };
    for (std::uint32_t j = 0; j < kAlong; ++j)
      for (std::uint32_t i = 0; i < k; ++i)
        for (Triangle t :
             {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
              Triangle{at(i, j), at(i, j + 1), at(i + 1, j + 1)}}) {
          std::sort(t.begin(), t.end());
          triangles.push_back(t);
        }
  }
  return triangles;
}

TEST(IndependentLoops, AreFewForEachHandle) {
  EssentialLoops search(first_of(kMost + 1), tori());
  for (const std::size_t n_alike : {1, 2, 3})
    for (std::uint32_t max_edges = kLeast - 1; max_edges <= kMost;
         ++max_edges) {
      SCOPED_TRACE(testing::Message() << n_alike << " of " << max_edges);
      const auto found = search.independent(max_edges, n_alike);
      ASSERT_EQ(found.size(), max_edges - kLeast + 1);
      for (std::uint32_t k = kLeast; k <= max_edges; ++k) {
        const EssentialLoops::Loops& loops = found[k - kLeast];
        EXPECT_EQ(loops.size(), n_alike);
        EXPECT_EQ(std::set(loops.begin(), loops.end()).size(), loops.size());
        for (const std::vector<VertexId>& loop : loops) {
          EXPECT_EQ(loop.size(), k);
          EXPECT_TRUE(std::is_sorted(loop.begin(), loop.end()));
          EXPECT_GE(index(loop.front()), first_of(k));
          EXPECT_LT(index(loop.back()), first_of(k + 1));
        }
      }
    }
}

TEST(IndependentLoops, GoThroughTheirStarts) {
  EssentialLoops search(first_of(kMost + 1), tori());
  for (std::uint32_t max_edges = kLeast - 1; max_edges <= kMost; ++max_edges) {
    const std::vector<VertexId> starts = search.starts(max_edges);
    std::set<std::vector<VertexId>> missed;
    for (const auto& loop : search.shortest(max_edges).loops)
      if (std::none_of(loop.begin(), loop.end(), [&](VertexId v) {
            return std::binary_search(starts.begin(), starts.end(), v);
          }))
        missed.insert(loop);
    EXPECT_TRUE(missed.empty());
    for (const VertexId v : starts)
      EXPECT_LT(index(v), first_of(max_edges + 1));
  }
}

std::vector<Point3> noisy_plate(std::uint64_t seed) {
  return shapes::sample("plate", 400, {.seed = seed, .noise = 0.8});
}

/// Two, one and one were left.
TEST(LastHandles, GoFromNoisyPlates) {
  for (const std::uint64_t seed : {12, 15, 16}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Reconstruction result = reconstruct(noisy_plate(seed));
    EXPECT_EQ(result.surface.genus, 0);
    EXPECT_EQ(result.surface.components, 1U);
    EXPECT_TRUE(result.surface.manifold && result.surface.outward);
    EXPECT_TRUE(result.surface.unused_vertices.empty());
  }
}

/// However many edges go round it, and however much the sampling is in doubt
/// elsewhere, a tube keeps its handle.
TEST(LastHandles, StayWhereTheyAreSampled) {
  const std::vector<Point3> plate = noisy_plate(15);
  const std::int64_t genus = reconstruct(plate).surface.genus.value();
  for (const std::size_t n : {100, 200, 400, 800}) {
    SCOPED_TRACE(testing::Message() << n << " points");
    const double noise = n < 200 ? 0 : 0.4;
    std::vector<Point3> points = plate;
    for (const Point3& p : shapes::sample("torus", n, {.noise = noise}))
      points.push_back(p + Point3(0, 0, 9));
    const Reconstruction beside = reconstruct(points);
    EXPECT_GT(beside.closing.handles_removed, 0U);
    EXPECT_EQ(beside.surface.genus, genus + 1);
    EXPECT_EQ(beside.surface.components, 2U);
    EXPECT_TRUE(beside.surface.unused_vertices.empty());
  }
}

/// That a plate is sampled badly says nothing about a knot far from it, the
/// noise of which is within what it can bear.
TEST(LastHandles, StayOnBodiesThatWereNotChanged) {
  const std::vector<Point3> plate = noisy_plate(15);
  const std::int64_t genus = reconstruct(plate).surface.genus.value();
  std::vector<Point3> points = plate;
  for (const Point3& p : shapes::sample("knot", 500, {.seed = 3, .noise = 0.3}))
    points.push_back(p + Point3(0, 0, 9));
  const Reconstruction beside = reconstruct(points);
  EXPECT_GT(beside.closing.handles_removed, 0U);
  EXPECT_EQ(beside.surface.genus, genus + 1);
  EXPECT_EQ(beside.surface.components, 2U);
}

/// Hands touch a body, and lips each other, along patches that loops of up to
/// 16 edges go round. One handle in a hand speaks for itself.
TEST(SlowLastHandles, GoWherePartsOfAFigureTouch) {
  std::ifstream file("data/real/man.off");
  if (!file) GTEST_SKIP() << "no figure: run scripts/fetch_data.sh";
  std::string magic;
  std::size_t n = 0, n_faces = 0, n_edges = 0;
  file >> magic >> n >> n_faces >> n_edges;
  ASSERT_EQ(n, 17495U);
  std::vector<Point3> points(n);
  for (Point3& p : points) file >> p.x() >> p.y() >> p.z();
  const Reconstruction result = reconstruct(points);
  EXPECT_GE(result.closing.handles_removed, 31U);
  EXPECT_LE(result.surface.genus, 1);
  EXPECT_EQ(result.surface.components, 1U);
  EXPECT_TRUE(result.surface.manifold && result.surface.outward);
  EXPECT_TRUE(result.surface.unused_vertices.empty());
}

}  // namespace
}  // namespace umbrella
