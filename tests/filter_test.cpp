#include "umbrella/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/complexes.h"
#include "umbrella/first_cycle_internal.h"
#include "umbrella/link_graph_internal.h"
#include "umbrella/star_sweep_internal.h"

namespace umbrella {
namespace {

using tests::LinkEdges;
using tests::ranked;

constexpr std::size_t kVertices = 8;

std::vector<Triangle> corners_of(std::span<const RankedTriangle> triangles) {
  std::vector<Triangle> corners;
  for (const auto& t : triangles) corners.push_back(t.corners);
  return corners;
}

/// The triangles at v up to the first that closes a cycle.
std::vector<RankedTriangle> first_umbrella(
    std::vector<RankedTriangle> triangles, VertexId v) {
  std::erase_if(triangles, [&](const RankedTriangle& t) {
    return std::count(t.corners.begin(), t.corners.end(), v) == 0;
  });
  std::sort(triangles.begin(), triangles.end(), ranks_before);
  std::vector<RankedTriangle> taken;
  for (const auto& t : triangles) {
    taken.push_back(t);
    const LinkEdges link = tests::link(taken, v);
    if (!tests::has_cycle(link)) continue;
    const auto cyclic = tests::on_cycle(link);
    std::vector<RankedTriangle> umbrella;
    for (std::size_t i = 0; i < taken.size(); ++i)
      if (cyclic[i]) umbrella.push_back(taken[i]);
    return umbrella;
  }
  return {};
}

TEST(UmbrellaFilter, TakesTheFirstUmbrellaOfEachVertex) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double density = 0.1 + 0.01 * static_cast<double>(trial);
    const auto triangles = tests::random_complex(kVertices, density, trial);
    std::vector<Triangle> expected;
    std::vector<VertexId> bare;
    for (std::size_t i = 0; i < kVertices; ++i) {
      const auto umbrella = first_umbrella(triangles, tests::vertex(i));
      if (umbrella.empty()) {
        bare.push_back(tests::vertex(i));
        continue;
      }
      EXPECT_TRUE(
          tests::is_simple_cycle(tests::link(umbrella, tests::vertex(i))));
      for (const auto& t : umbrella) expected.push_back(t.corners);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()),
                   expected.end());

    const auto result = umbrella_filter(kVertices, RankedTriangles(triangles));
    EXPECT_EQ(corners_of(result.triangles), expected);
    EXPECT_EQ(result.without_umbrella, bare);
  }
}

TEST(UmbrellaFilter, NamesTheVerticesThatAreNotSettled) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double density = 0.05 + 0.01 * static_cast<double>(trial);
    const auto result = umbrella_filter(
        kVertices,
        RankedTriangles(tests::random_complex(kVertices, density, trial)));
    std::vector<VertexId> expected;
    for (std::size_t i = 0; i < kVertices; ++i)
      if (!tests::is_simple_cycle(
              tests::link(result.triangles, tests::vertex(i))))
        expected.push_back(tests::vertex(i));
    ASSERT_TRUE(result.unsettled.has_value());
    EXPECT_EQ(*result.unsettled, expected);
  }
}

TEST(UmbrellaFilter, DoesNotDependOnTheOrderOfTheTriangles) {
  std::mt19937_64 rng(3);
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto triangles = tests::random_complex(kVertices, 0.4, trial);
    const auto expected = corners_of(
        umbrella_filter(kVertices, RankedTriangles(triangles)).triangles);
    std::shuffle(triangles.begin(), triangles.end(), rng);
    auto shuffled = corners_of(
        umbrella_filter(kVertices, RankedTriangles(triangles)).triangles);
    std::sort(shuffled.begin(), shuffled.end());
    EXPECT_EQ(shuffled, expected);
  }
}

TEST(UmbrellaFilter, DoesNotDependOnTheNumberOfThreads) {
  std::mt19937_64 rng(4);
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto triangles = tests::random_complex(kVertices, 0.4, trial);
    if (trial % 2 == 1) std::shuffle(triangles.begin(), triangles.end(), rng);
    const auto one = umbrella_filter(kVertices, RankedTriangles(triangles));
    const auto three =
        umbrella_filter(kVertices, RankedTriangles(triangles), 3);
    EXPECT_EQ(corners_of(three.triangles), corners_of(one.triangles));
    EXPECT_EQ(three.without_umbrella, one.without_umbrella);
    EXPECT_EQ(three.unsettled, one.unsettled);
  }
}

/// Corners 3 t + i that are the vertex, of all triangles, ascending.
std::vector<std::uint32_t> corners_at(
    VertexId v, const std::vector<RankedTriangle>& triangles) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (triangles[t].corners[i] == v) result.push_back(3 * t + i);
  return result;
}

void expect_star(const Star& star,
                 const std::vector<RankedTriangle>& triangles) {
  std::vector<std::uint32_t> corners;
  ASSERT_EQ(star.keys.size(), star.triangles.size());
  for (std::size_t i = 0; i < star.triangles.size(); ++i) {
    const auto& [corner, edge] = star.triangles[i];
    corners.push_back(corner);
    EXPECT_EQ(edge, opposite_edge(triangles[corner / 3].corners, star.vertex));
    for (std::size_t k = 0; k < i; ++k) {
      const double other = triangles[star.triangles[k].triangle()].rank.primary;
      const double own = triangles[corner / 3].rank.primary;
      if (star.keys[k] == star.keys[i]) continue;
      EXPECT_EQ(star.keys[k] < star.keys[i], other < own);
    }
  }
  std::sort(corners.begin(), corners.end());
  EXPECT_EQ(corners, corners_at(star.vertex, triangles));
}

TEST(StarSweep, HasTheTrianglesOfEachVertex) {
  std::mt19937_64 rng(5);
  constexpr std::size_t kMany = 24;  // more triangles at a vertex than padding
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto triangles = tests::random_complex(kMany, 0.3, trial);
    for (auto& t : triangles)
      t.rank.primary = 1.0 * static_cast<int>(rng() % 9) - 4 +
                       0x1p-40 * static_cast<int>(rng() % 3);
    const std::size_t begin = rng() % kMany,
                      end = begin + rng() % (kMany - begin);
    StarSweep sweep(triangles, {}, {begin, end});
    for (std::size_t v = begin; v < end; ++v)
      expect_star(sweep.next(), triangles);
    EXPECT_TRUE(sweep.has_seen_all());
  }
}

TEST(StarSweep, KnowsWhenTrianglesAreNotInOrder) {
  const std::vector<RankedTriangle> triangles = {
      ranked(0, 1, 2, 1), ranked(2, 3, 4, 1), ranked(1, 2, 3, 1)};
  const std::vector<TriangleIndex> order = {0, 2, 1};
  StarSweep in_order(triangles, order, {0, 5});
  StarSweep as_they_lie(triangles, {}, {0, 5});
  for (std::size_t v = 0; v < 5; ++v) {
    expect_star(in_order.next(), triangles);
    as_they_lie.next();
  }
  EXPECT_TRUE(in_order.has_seen_all());
  EXPECT_FALSE(as_they_lie.has_seen_all());
}

TEST(UmbrellaFilter, PrefersTheUmbrellaWithTheBetterWorstTriangle) {
  // Around vertex 0 two cycles, 1 2 3 with worst rank 5 and 4 5 6 with 4; the
  // first has the best triangle of all.
  const std::vector<RankedTriangle> triangles = {
      ranked(0, 1, 2, 1), ranked(0, 1, 3, 1), ranked(0, 2, 3, 5),
      ranked(0, 4, 5, 3), ranked(0, 4, 6, 3), ranked(0, 5, 6, 4)};
  const auto result = umbrella_filter(7, RankedTriangles(triangles));
  EXPECT_EQ(corners_of(result.triangles),
            corners_of(std::span(triangles).subspan(3)));
  EXPECT_EQ(result.without_umbrella.size(), 6U);
}

TEST(UmbrellaFilter, LeavesVerticesWithoutTrianglesAlone) {
  const auto result = umbrella_filter(3, RankedTriangles());
  EXPECT_TRUE(result.triangles.empty());
  EXPECT_EQ(result.without_umbrella.size(), 3U);
}

TEST(UmbrellaFilter, ManagesAVertexOfVeryHighDegree) {
  constexpr std::size_t kSpokes = 200'000;
  std::vector<RankedTriangle> triangles;
  for (std::size_t i = 1; i <= kSpokes; ++i)
    triangles.push_back(
        ranked(0, i, i % kSpokes + 1, static_cast<double>(i % 97)));
  const auto result = umbrella_filter(kSpokes + 1, RankedTriangles(triangles));
  EXPECT_EQ(result.triangles.size(), kSpokes);
  EXPECT_EQ(result.without_umbrella.size(), kSpokes);
}

/// Distinct edges of a random graph, as many as there may be at most.
std::vector<LinkEdge> random_edges(std::size_t n_vertices,
                                   std::size_t n_at_most,
                                   std::mt19937_64& rng) {
  std::vector<LinkEdge> edges;
  for (std::size_t a = 0; a < n_vertices; ++a)
    for (std::size_t b = 0; b < a; ++b)
      edges.push_back({tests::vertex(a), tests::vertex(b)});
  std::shuffle(edges.begin(), edges.end(), rng);
  edges.resize(std::min(edges.size(), rng() % (n_at_most + 1)));
  return edges;
}

// From a few vertices with all edges between them to a forest of 64.
TEST(FirstCycle, IsWhatTheLinkGraphPeels) {
  std::mt19937_64 rng(20261122);
  constexpr std::size_t kMostVertices = 64;
  FirstCycle few(kMostVertices);
  LinkGraph graph(kMostVertices);
  int n_cycles = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto edges = random_edges(2 + rng() % (kMostVertices - 1),
                                    FirstCycle::kMostEdges, rng);
    graph.clear();
    const bool has_cycle =
        std::any_of(edges.begin(), edges.end(),
                    [&](const LinkEdge& e) { return graph.add(e); });
    std::uint32_t expected = 0;
    if (has_cycle) {
      const auto& stays = graph.peel();
      for (std::size_t e = 0; e < stays.size(); ++e)
        expected |= std::uint32_t{stays[e]} << e;
    }
    EXPECT_EQ(few.find(edges), expected);
    n_cycles += has_cycle ? 1 : 0;
  }
  EXPECT_GT(n_cycles, kTrials / 10);
  EXPECT_LT(n_cycles, kTrials * 9 / 10);
}

// On the hull of a lattice all primaries are 0, and secondaries tie as well.
TEST(UmbrellaFilter, PartsEqualRanksByCorners) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto triangles = tests::random_complex(kVertices, 0.5, trial);
    std::mt19937_64 rng(trial);
    for (auto& t : triangles)
      t.rank = {0.5 * static_cast<double>(rng() % 2),
                static_cast<double>(rng() % 3)};
    std::vector<Triangle> expected;
    for (std::size_t i = 0; i < kVertices; ++i)
      for (const auto& t : first_umbrella(triangles, tests::vertex(i)))
        expected.push_back(t.corners);
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()),
                   expected.end());
    auto chosen = corners_of(
        umbrella_filter(kVertices, RankedTriangles(triangles)).triangles);
    std::sort(chosen.begin(), chosen.end());
    EXPECT_EQ(chosen, expected);
  }
}

TEST(LinkGraph, FindsCyclesAndBridgesAsTheDefinitionSays) {
  std::mt19937_64 rng(7);
  LinkGraph graph(kVertices);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    LinkEdges edges;
    for (std::size_t a = 0; a < kVertices; ++a)
      for (std::size_t b = a + 1; b < kVertices; ++b)
        if (rng() % 28 < 1 + static_cast<std::uint64_t>(trial % 12))
          edges.emplace_back(tests::vertex(a), tests::vertex(b));
    std::shuffle(edges.begin(), edges.end(), rng);

    graph.clear();
    LinkEdges so_far;
    for (const auto& [a, b] : edges) {
      const bool closes = tests::are_connected(so_far, a, b);
      EXPECT_EQ(graph.add({a, b}), closes);
      so_far.emplace_back(a, b);
    }
    const auto expected = tests::on_cycle(edges);
    EXPECT_EQ(graph.has_cycle(), std::find(expected.begin(), expected.end(),
                                           true) != expected.end());
    const auto& stays = graph.drop_bridges();
    EXPECT_EQ(std::vector<bool>(stays.begin(), stays.end()), expected);
    LinkEdges cyclic;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (expected[i]) cyclic.push_back(edges[i]);
    EXPECT_EQ(graph.has_one_cycle(), tests::is_simple_cycle(cyclic));
  }
}

}  // namespace
}  // namespace umbrella
