#include "umbrella/holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/support/complexes.h"
#include "umbrella/clean_up.h"

namespace umbrella {
namespace {

using tests::ranked;
using tests::vertex;

std::vector<VertexId> ids(std::initializer_list<std::size_t> rows) {
  std::vector<VertexId> result;
  for (const std::size_t v : rows) result.push_back(vertex(v));
  return result;
}

TEST(FindHoles, ThereIsNoneInAClosedSurface) {
  const std::vector<RankedTriangle> tetrahedron = {
      ranked(0, 1, 2, 1), ranked(0, 1, 3, 1), ranked(0, 2, 3, 1),
      ranked(1, 2, 3, 1)};
  EXPECT_TRUE(find_holes(4, tetrahedron, {}, {}).empty());
}

TEST(FindHoles, FollowsTheOpenEdges) {
  // An octahedron without one triangle: its corners have no umbrella.
  std::vector<RankedTriangle> triangles;
  for (const std::size_t top : {4U, 5U})
    for (std::size_t i = 0; i < 4; ++i)
      if (top != 5 || i != 0)
        triangles.push_back(ranked(i, (i + 1) % 4, top, 1));
  const auto holes = find_holes(6, triangles, {}, ids({0, 1, 5}));
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(holes[0].core, ids({0, 1, 5}));
  EXPECT_EQ(holes[0].vertices, ids({0, 1, 5}));
}

TEST(FindHoles, StepsOnceOverDeletedTriangles) {
  const std::vector<RankedTriangle> deleted = {ranked(0, 1, 2, 1),
                                               ranked(2, 3, 4, 1)};
  const auto holes = find_holes(6, {}, deleted, ids({0}));
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(holes[0].core, ids({0}));
  EXPECT_EQ(holes[0].vertices, ids({0, 1, 2}));  // not on to 3 and 4
}

// Two triangles close the edge between two vertices: it joins no holes.
TEST(FindHoles, AreNotJoinedByClosedEdges) {
  const std::vector<RankedTriangle> triangles = {ranked(0, 1, 2, 1),
                                                 ranked(0, 1, 3, 1)};
  const auto holes = find_holes(4, triangles, {}, ids({0, 1}));
  ASSERT_EQ(holes.size(), 2U);
  EXPECT_EQ(holes[0].core, ids({0}));
  EXPECT_EQ(holes[1].core, ids({1}));
}

// The edges with exactly one triangle, both ends without umbrella.
tests::LinkEdges open_edges(const CleanUpResult& clean,
                            const std::set<VertexId>& bare) {
  std::map<std::pair<VertexId, VertexId>, int> count;
  for (const auto& t : clean.triangles) {
    ++count[{t.corners[0], t.corners[1]}];
    ++count[{t.corners[0], t.corners[2]}];
    ++count[{t.corners[1], t.corners[2]}];
  }
  tests::LinkEdges open;
  for (const auto& [edge, n] : count)
    if (n == 1 && bare.count(edge.first) > 0 && bare.count(edge.second) > 0)
      open.push_back(edge);
  return open;
}

TEST(FindHoles, AreAsDefinedOnRandomComplexes) {
  constexpr std::size_t kVertices = 9;
  std::size_t n_holes = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto all = tests::random_complex(kVertices, 0.35, trial);
    const auto clean = clean_up(kVertices, RankedTriangles(all));
    const auto holes = find_holes(kVertices, clean.triangles, clean.deleted,
                                  clean.without_umbrella);
    n_holes += holes.size();

    const std::set<VertexId> bare(clean.without_umbrella.begin(),
                                  clean.without_umbrella.end());
    const tests::LinkEdges open = open_edges(clean, bare);
    std::set<VertexId> seen;
    for (const Hole& hole : holes) {
      EXPECT_TRUE(std::is_sorted(hole.vertices.begin(), hole.vertices.end()));
      for (const VertexId v : hole.core) {
        EXPECT_EQ(bare.count(v), 1U);
        EXPECT_TRUE(seen.insert(v).second);
      }
      for (const VertexId v : bare)
        EXPECT_EQ(tests::are_connected(open, hole.core[0], v),
                  std::count(hole.core.begin(), hole.core.end(), v) == 1);
      std::set<VertexId> joined(hole.core.begin(), hole.core.end());
      for (const auto& t : clean.deleted)
        for (const VertexId v : hole.core)
          if (std::count(t.corners.begin(), t.corners.end(), v) > 0)
            joined.insert(t.corners.begin(), t.corners.end());
      EXPECT_EQ(hole.vertices,
                std::vector<VertexId>(joined.begin(), joined.end()));
    }
    EXPECT_EQ(seen, bare);
  }
  EXPECT_GT(n_holes, 60U);
}

}  // namespace
}  // namespace umbrella
