#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "umbrella/pieces_internal.h"

namespace umbrella {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

LocatedTriangle triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return {{VertexId{a}, VertexId{b}, VertexId{c}},
          delaunay::Facet(delaunay::CellId{0}, 0)};
}

WorkingSurface surface_of(std::size_t n_vertices,
                          const std::vector<LocatedTriangle>& triangles) {
  WorkingSurface surface(n_vertices, {});
  for (const LocatedTriangle& t : triangles) surface.add(t);
  return surface;
}

std::vector<VertexId> ids(const std::vector<std::uint32_t>& numbers) {
  std::vector<VertexId> result;
  for (const std::uint32_t i : numbers) result.push_back(VertexId{i});
  return result;
}

/// A tetrahedron but for one triangle, which the change brings.
class LidOfATetrahedron : public testing::Test {
 protected:
  std::vector<Piece> pieces(const std::vector<std::uint32_t>& vertices,
                            std::size_t limit = 12) {
    const std::vector<VertexId> done = ids(vertices);
    return PieceFinder(surface_, limit).find({{}, lid_, done}, is_open_);
  }

  WorkingSurface surface_ =
      surface_of(5, {triangle(0, 1, 3), triangle(0, 2, 3), triangle(1, 2, 3)});
  std::vector<LocatedTriangle> lid_ = {triangle(0, 1, 2)};
  std::vector<bool> is_open_ = std::vector<bool>(5);
};

TEST_F(LidOfATetrahedron, ClosesIt) {
  const auto found = pieces({0, 1, 2});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].n_triangles, 4U);
  EXPECT_EQ(found[0].vertices, ids({0, 1, 2}));
  EXPECT_THAT(found[0].all_vertices,
              testing::UnorderedElementsAreArray(ids({0, 1, 2, 3})));
}

TEST_F(LidOfATetrahedron, MakesNoPieceBeyondTheLimit) {
  EXPECT_THAT(pieces({0, 1, 2}, 4), SizeIs(1));
  EXPECT_THAT(pieces({0, 1, 2}, 3), IsEmpty());
}

TEST_F(LidOfATetrahedron, MakesNoPieceWhileACornerWaits) {
  is_open_[3] = true;
  EXPECT_THAT(pieces({0, 1, 2}), IsEmpty());
  EXPECT_THAT(pieces({0, 1, 2, 3}), SizeIs(1));  // done with by the change
  is_open_ = {false, false, false, false, true};
  EXPECT_THAT(pieces({0, 1, 2}), SizeIs(1));  // another waits
}

/// Two tetrahedra without a face each, joined by a tube of six triangles.
TEST(PieceFinder, FindsThePartsOfALargePatchThatIsCut) {
  const std::vector<LocatedTriangle> tube = {
      triangle(0, 1, 4), triangle(1, 4, 5), triangle(1, 2, 5),
      triangle(2, 5, 6), triangle(0, 2, 6), triangle(0, 4, 6)};
  WorkingSurface surface = surface_of(8, tube);
  for (const auto& t :
       {triangle(0, 1, 3), triangle(0, 2, 3), triangle(1, 2, 3),
        triangle(4, 5, 7), triangle(4, 6, 7), triangle(5, 6, 7)})
    surface.add(t);
  const std::vector<bool> is_open(8);
  PieceFinder finder(surface, 4);
  const std::vector<TriangleIndex> freed = {0, 1, 2, 3, 4, 5};
  const std::vector<LocatedTriangle> lids = {triangle(0, 1, 2),
                                             triangle(4, 5, 6)};
  const std::vector<VertexId> vertices = ids({0, 1, 2, 4, 5, 6});
  for (int call = 0; call < 2; ++call) {
    const auto found = finder.find({freed, lids, vertices}, is_open);
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_EQ(found[0].n_triangles, 4U);
    EXPECT_EQ(found[0].vertices, ids({0, 1, 2}));
    EXPECT_EQ(found[1].n_triangles, 4U);
    EXPECT_EQ(found[1].vertices, ids({4, 5, 6}));
  }
  EXPECT_THAT(finder.find({{}, lids, vertices}, is_open), IsEmpty());
}

}  // namespace
}  // namespace umbrella
