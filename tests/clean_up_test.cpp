#include "umbrella/clean_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "tests/support/complexes.h"
#include "umbrella/cycle_check_internal.h"
#include "umbrella/filter.h"

namespace umbrella {
namespace {

using tests::LinkEdges;
using tests::ranked;
using Complex = std::vector<RankedTriangle>;

constexpr std::size_t kVertices = 8;

std::vector<Triangle> corners_of(const Complex& triangles) {
  std::vector<Triangle> corners;
  for (const auto& t : triangles) corners.push_back(t.corners);
  return corners;
}

/// Whether the triangle is of type 2 or 3 at its corner v [Adamy02, Fig. 7].
struct Types {
  bool is_type2 = false;
  bool is_type3 = false;
};

Types types_at(const Complex& all, const RankedTriangle& t, VertexId v) {
  const LinkEdges link = tests::link(all, v);
  const auto cyclic = tests::on_cycle(link);
  LinkEdges core;
  for (std::size_t i = 0; i < link.size(); ++i)
    if (cyclic[i]) core.push_back(link[i]);
  const auto own = tests::link({&t, 1}, v).front();
  const bool is_in = cyclic[static_cast<std::size_t>(
      std::find(link.begin(), link.end(), own) - link.begin())];
  return {!core.empty() && !is_in, is_in && !tests::is_simple_cycle(core)};
}

Types types(const Complex& all, const RankedTriangle& t) {
  Types result;
  for (const VertexId v : t.corners) {
    const Types here = types_at(all, t, v);
    result.is_type2 = result.is_type2 || here.is_type2;
    result.is_type3 = result.is_type3 || here.is_type3;
  }
  return result;
}

void erase_all(Complex& from, const Complex& what) {
  std::erase_if(from, [&](const RankedTriangle& t) {
    const auto corners = corners_of(what);
    return std::find(corners.begin(), corners.end(), t.corners) !=
           corners.end();
  });
}

/// The rules word by word, from scratch each time.
Complex cleaned_by_the_book(Complex triangles) {
  while (true) {
    Complex type2, type3;
    for (const auto& t : triangles) {
      const Types found = types(triangles, t);
      if (found.is_type2) type2.push_back(t);
      if (found.is_type3) type3.push_back(t);
    }
    if (type2.empty() && type3.empty()) return triangles;
    erase_all(triangles, type2.empty()
                             ? Complex{*std::max_element(
                                   type3.begin(), type3.end(), ranks_before)}
                             : type2);
  }
}

// All graphs on five nodes, one after the other in the same check.
TEST(CycleCheck, KnowsTheSimpleCycles) {
  LinkEdges edges;
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = a + 1; b < 5; ++b)
      edges.emplace_back(tests::vertex(a), tests::vertex(b));
  CycleCheck check(5);
  int n_cycles = 0;
  for (unsigned graph = 1; graph < 1U << edges.size(); ++graph) {
    LinkEdges in_graph;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if ((graph >> e & 1U) != 0) in_graph.push_back(edges[e]);
    const auto edge = [&](std::size_t i) {
      return LinkEdge{in_graph[i].first, in_graph[i].second};
    };
    const std::size_t n = check.find(in_graph.size(), edge);
    EXPECT_EQ(n == in_graph.size(), tests::is_simple_cycle(in_graph))
        << "graph " << graph;
    n_cycles += n == in_graph.size() ? 1 : 0;
    // A cycle found sooner is one, and no edges before it closes any.
    const LinkEdges first(in_graph.begin(), in_graph.begin() + n);
    if (n == 0) continue;
    EXPECT_TRUE(tests::is_simple_cycle(first)) << "graph " << graph;
  }
  EXPECT_EQ(n_cycles, 10 + 15 + 12);  // of three, four and five nodes
}

TEST(CleanUp, DeletesWhatTheBookSays) {
  for (std::uint64_t trial = 0; trial < 80; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double density = 0.1 + 0.008 * static_cast<double>(trial);
    const Complex triangles = tests::random_complex(kVertices, density, trial);
    const auto result = clean_up(kVertices, RankedTriangles(triangles),
                                 {.largest_dissolved = 0});
    EXPECT_EQ(corners_of(result.triangles),
              corners_of(cleaned_by_the_book(triangles)));
    EXPECT_EQ(result.n_type2 + result.n_type3, result.deleted.size());
    EXPECT_EQ(result.triangles.size() + result.deleted.size(),
              triangles.size());
  }
}

TEST(CleanUp, LeavesOneUmbrellaOrNone) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto result =
        clean_up(kVertices,
                 RankedTriangles(tests::random_complex(kVertices, 0.5, trial)));
    const std::set<VertexId> bare(result.without_umbrella.begin(),
                                  result.without_umbrella.end());
    for (std::size_t i = 0; i < kVertices; ++i) {
      const LinkEdges link = tests::link(result.triangles, tests::vertex(i));
      EXPECT_EQ(tests::is_simple_cycle(link),
                bare.count(tests::vertex(i)) == 0);
      EXPECT_EQ(tests::has_cycle(link), bare.count(tests::vertex(i)) == 0);
    }
  }
}

TEST(CleanUp, NeedsNoLookAtSettledVertices) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double density = 0.05 + 0.01 * static_cast<double>(trial);
    const auto filtered = umbrella_filter(
        kVertices,
        RankedTriangles(tests::random_complex(kVertices, density, trial)));
    const CleanUpOptions options = {.largest_dissolved = trial % 8};
    const auto all = clean_up(kVertices, filtered.triangles, options);
    const auto told =
        clean_up(kVertices, filtered.triangles, options, filtered.unsettled);
    EXPECT_EQ(corners_of(told.triangles), corners_of(all.triangles));
    EXPECT_EQ(corners_of(told.deleted), corners_of(all.deleted));
    EXPECT_EQ(told.without_umbrella, all.without_umbrella);
    EXPECT_EQ(told.n_type2, all.n_type2);
    EXPECT_EQ(told.n_type3, all.n_type3);
  }
}

TEST(CleanUp, CountsEachKind) {
  // A tetrahedron 0 1 2 3 with a flap at 0 1 (type 2 there), and beside it
  // two tetrahedra that share vertex 5 (type 3 there).
  Complex triangles = {ranked(0, 1, 2, 1), ranked(0, 1, 3, 1),
                       ranked(0, 2, 3, 1), ranked(1, 2, 3, 1),
                       ranked(0, 1, 4, 1)};
  for (const std::size_t base : {6U, 9U}) {
    const double rank = static_cast<double>(base);
    triangles.push_back(ranked(5, base, base + 1, rank));
    triangles.push_back(ranked(5, base, base + 2, rank));
    triangles.push_back(ranked(5, base + 1, base + 2, rank));
    triangles.push_back(ranked(base, base + 1, base + 2, rank));
  }
  const auto kept =
      clean_up(12, RankedTriangles(triangles), {.largest_dissolved = 0});
  EXPECT_EQ(kept.n_type2, 3U);  // the flap; two that hang at 5 then
  EXPECT_EQ(kept.n_type3, 1U);  // the worst at 5
  EXPECT_EQ(kept.n_dissolved, 0U);
  const auto dissolved = clean_up(12, RankedTriangles(triangles));
  EXPECT_EQ(dissolved.n_dissolved, 8U);
  EXPECT_EQ(dissolved.deleted.size(), 12U);
  EXPECT_EQ(dissolved.without_umbrella.size(), 12U);
}

TEST(CleanUp, KeepsClosedPiecesAboveTheLimit) {
  // An octahedron: eight triangles.
  Complex triangles;
  for (const std::size_t top : {4U, 5U})
    for (std::size_t i = 0; i < 4; ++i)
      triangles.push_back(ranked(i, (i + 1) % 4, top, 1));
  EXPECT_EQ(clean_up(6, RankedTriangles(triangles), {.largest_dissolved = 7})
                .triangles.size(),
            8U);
  EXPECT_EQ(clean_up(6, RankedTriangles(triangles), {.largest_dissolved = 8})
                .n_dissolved,
            8U);
}

}  // namespace
}  // namespace umbrella
