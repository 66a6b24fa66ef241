#include "umbrella/curve_tour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace umbrella {
namespace {

using testing::IsEmpty;

/// A random graph; a few of its edges are required.
std::vector<TourEdge> random_graph(std::uint32_t n, double density,
                                   double required, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<TourEdge> edges;
  for (std::uint32_t v = 0; v < n; ++v) {
    for (std::uint32_t w = v + 1; w < n; ++w) {
      if (unit(rng) >= density) continue;
      const double length = unit(rng);
      edges.push_back({{v, w}, length, unit(rng) < required});
    }
  }
  return edges;
}

/// The length of the shortest tour by trying all orders; infinite if there is
/// none.
double shortest_by_trying(std::uint32_t n, const std::vector<TourEdge>& edges) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<double> length(std::size_t{n} * n, kNever);
  std::vector<bool> required(std::size_t{n} * n);
  long n_required = 0;
  for (const TourEdge& edge : edges) {
    const auto& [v, w] = edge.ends;
    length[v * n + w] = length[w * n + v] = edge.length;
    required[v * n + w] = required[w * n + v] = edge.required;
    n_required += edge.required ? 1 : 0;
  }
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  double best = kNever;
  do {
    double sum = 0;
    long n_met = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::size_t at = order[i] * n + order[(i + 1) % n];
      sum += length[at];
      n_met += required[at] ? 1 : 0;
    }
    if (n_met == n_required) best = std::min(best, sum);
  } while (std::next_permutation(order.begin() + 1, order.end()));
  return best;
}

/// Each vertex twice, and one circle.
bool is_tour(std::uint32_t n, const std::vector<TourEdge>& edges,
             const std::vector<std::uint32_t>& tour) {
  std::vector<std::vector<std::uint32_t>> at(n);
  for (const std::uint32_t e : tour) {
    at[edges[e].ends[0]].push_back(edges[e].ends[1]);
    at[edges[e].ends[1]].push_back(edges[e].ends[0]);
  }
  if (std::ranges::any_of(at, [](const auto& x) { return x.size() != 2; }))
    return false;
  std::uint32_t previous = 0, v = at[0][0], n_seen = 1;
  for (; v != 0 && n_seen <= n; ++n_seen) {
    const std::uint32_t next = at[v][0] == previous ? at[v][1] : at[v][0];
    previous = v;
    v = next;
  }
  return n_seen == n;
}

TEST(CurveTour, IsTheShortestOfAll) {
  std::mt19937_64 rng(41);
  unsigned n_infeasible = 0;
  for (unsigned trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const std::uint32_t n = 4 + trial % 5;
    const auto edges = random_graph(n, trial % 2 == 0 ? 1 : 0.6,
                                    trial % 3 == 0 ? 0.1 : 0, rng);
    const double expected = shortest_by_trying(n, edges);
    const TourResult result = shortest_tour(n, edges);
    if (expected == std::numeric_limits<double>::infinity()) {
      EXPECT_EQ(result.status, TourStatus::Infeasible);
      EXPECT_THAT(result.edges, IsEmpty());
      ++n_infeasible;
      continue;
    }
    ASSERT_EQ(result.status, TourStatus::Optimal);
    EXPECT_TRUE(is_tour(n, edges, result.edges));
    EXPECT_NEAR(result.length, expected, 1e-9);
    EXPECT_EQ(result.bound, result.length);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      EXPECT_TRUE(!edges[e].required ||
                  std::ranges::binary_search(result.edges, e));
  }
  EXPECT_GT(n_infeasible, 20);
  EXPECT_LT(n_infeasible, 200);
}

TEST(CurveTour, KeepsItsStartWhenCutShort) {
  std::mt19937_64 rng(42);
  const std::uint32_t n = 30;
  const auto edges = random_graph(n, 1, 0, rng);
  std::vector<std::uint32_t> start;  // 0 1 2 ... 29
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto& [v, w] = edges[e].ends;
    if (w == v + 1 || (v == 0 && w == n - 1)) start.push_back(e);
  }
  const TourResult cut = shortest_tour(n, edges, start, {.trees = 3});
  EXPECT_EQ(cut.status, TourStatus::Feasible);
  EXPECT_TRUE(is_tour(n, edges, cut.edges));
  const TourResult none = shortest_tour(n, edges, {}, {.trees = 3});
  EXPECT_EQ(none.status, TourStatus::Limit);
  EXPECT_THAT(none.edges, IsEmpty());
  const TourResult whole = shortest_tour(n, edges, start);
  EXPECT_EQ(whole.status, TourStatus::Optimal);
  EXPECT_LT(whole.length, cut.length);
  EXPECT_LE(cut.bound, whole.length);
  EXPECT_LE(none.bound, whole.length);
}

TEST(CurveTour, FindsNoneInTwoTriangles) {
  const std::vector<TourEdge> edges = {{{0, 1}, 1}, {{0, 2}, 1}, {{1, 2}, 1},
                                       {{3, 4}, 1}, {{3, 5}, 1}, {{4, 5}, 1}};
  EXPECT_EQ(shortest_tour(6, edges).status, TourStatus::Infeasible);
}

}  // namespace
}  // namespace umbrella
