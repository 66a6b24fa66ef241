#include "umbrella/curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "predicates/gabriel.h"
#include "tests/support/point_sets.h"
#include "umbrella/curve_closing.h"
#include "umbrella/curve_filter.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::SizeIs;

using Rows = std::array<std::uint32_t, 2>;

std::vector<Rows> unoriented(std::vector<Rows> edges) {
  for (Rows& edge : edges) std::ranges::sort(edge);
  std::ranges::sort(edges);
  return edges;
}

/// What a sample listed along its curve should give.
std::vector<Rows> along(std::uint32_t n) {
  std::vector<Rows> edges;
  for (std::uint32_t i = 0; i < n; ++i) edges.push_back({i, (i + 1) % n});
  return unoriented(edges);
}

/// r(t) = 1 + sum of harmonics 2 to 5, at random parameters in order.
std::vector<Point2> fourier_curve(std::size_t n, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::array<double, 8> c{};
  for (double& x : c) x = 0.08 * unit(rng);
  std::vector<Point2> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi *
                     (static_cast<double>(i) + 0.3 * unit(rng)) /
                     static_cast<double>(n);
    double r = 1;
    for (unsigned k = 0; k < 4; ++k)
      r += c[2 * k] * std::cos((k + 2) * t) +
           c[2 * k + 1] * std::sin((k + 2) * t);
    points.emplace_back(3 * r * std::cos(t), r * std::sin(t));
  }
  return points;
}

/// A star polygon with m acute spikes, k points a side but none at a corner.
std::vector<Point2> star(unsigned m, unsigned k, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point2> points;
  const auto corner = [m](unsigned i) {
    const double t = std::numbers::pi * i / m;
    const double r = i % 2 == 0 ? 1 : 0.3;
    return Point2(r * std::cos(t), r * std::sin(t));
  };
  for (unsigned i = 0; i < 2 * m; ++i) {
    for (unsigned j = 0; j < k; ++j) {
      const double f = (j + 0.1 + 0.8 * unit(rng)) / k;
      points.emplace_back((1 - f) * corner(i) + f * corner(i + 1));
    }
  }
  return points;
}

TEST(Curve, FilterIsExactOnDenseSamplesOfRegularCurves) {
  std::mt19937_64 rng(11);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto n = static_cast<std::uint32_t>(150 + rng() % 200);
    const std::vector<Point2> points = fourier_curve(n, rng);
    const auto filtered = reconstruct_curve(points, {.mode = CurveMode::Paper});
    EXPECT_THAT(unoriented(filtered.edges), ElementsAreArray(along(n)));
    const auto closed = reconstruct_curve(points);
    EXPECT_EQ(closed.edges, filtered.edges);
    EXPECT_EQ(closed.closing.regions, 0);
  }
}

TEST(Curve, ClosingMendsMostCornersThatTheFilterMisses) {
  std::mt19937_64 rng(15);
  unsigned n_missed = 0, n_mended = 0;
  for (unsigned trial = 0; trial < 60; ++trial) {
    const unsigned m = 3 + trial % 6, k = 12 + trial % 17;
    SCOPED_TRACE(testing::Message() << m << " spikes, " << k << " a side");
    const std::vector<Point2> points = star(m, k, rng);
    const auto filtered = reconstruct_curve(points, {.mode = CurveMode::Paper});
    const auto closed = reconstruct_curve(points);
    EXPECT_THAT(closed.open_rows, IsEmpty());
    EXPECT_EQ(closed.edges.size(), points.size());

    const bool is_exact = unoriented(closed.edges) == along(2 * m * k);
    if (unoriented(filtered.edges) == along(2 * m * k)) {
      EXPECT_TRUE(is_exact) << "closing has spoilt the filter's curve";
    } else {
      ++n_missed;
      n_mended += is_exact ? 1 : 0;
    }
  }
  EXPECT_GT(n_missed, 20);
  EXPECT_GT(n_mended, n_missed / 2) << "of " << n_missed;
}

TEST(Curve, HasTwoEdgesAtEachPointThatIsNotOpen) {
  for (const tests::Family family : tests::kFamilies) {
    for (const std::size_t n : {3, 4, 7, 30, 150}) {
      SCOPED_TRACE(testing::Message() << tests::name(family) << ", n = " << n);
      const auto points = tests::make_points<2>(family, n, n);
      const auto result = reconstruct_curve(points);
      std::vector<unsigned> degree(points.size());
      for (const Rows& edge : result.edges)
        for (const std::uint32_t row : edge) ++degree[row];

      const Triangulation2 t(points);
      std::vector<bool> is_first(t.points().size(), true);
      for (std::uint32_t row = 0; row < points.size(); ++row) {
        const std::size_t v = index(t.vertex_of_row()[row]);
        const bool is_open = std::ranges::binary_search(result.open_rows, row);
        if (!is_first[v] || t.dimension() < 2)
          EXPECT_EQ(degree[row], 0);
        else if (is_open)
          EXPECT_LT(degree[row], 2);
        else
          EXPECT_EQ(degree[row], 2);
        is_first[v] = false;
      }
    }
  }
}

TEST(Curve, DependsOnTheSetOfPointsAlone) {
  std::mt19937_64 rng(12);
  for (const tests::Family family : tests::kFamilies) {
    SCOPED_TRACE(testing::Message() << tests::name(family));
    auto points = tests::make_points<2>(family, 60, 13);
    const auto coordinates = [&](const CurveReconstruction& result) {
      std::vector<std::array<Point2, 2>> edges;
      for (const auto& [a, b] : result.edges)
        edges.push_back({points[a], points[b]});
      return edges;
    };
    const auto expected = coordinates(reconstruct_curve(points));
    std::ranges::shuffle(points, rng);
    EXPECT_EQ(coordinates(reconstruct_curve(points)), expected);
  }
}

TEST(Curve, RunsCounterClockwise) {
  // Two squares, the second one clockwise and of doubled points.
  const std::vector<Point2> points = {{0, 0},   {1, 0},  {1, 1},
                                      {0, 1},   {9, 9},  {9, 10},
                                      {10, 10}, {10, 9}, {9, 10}};
  const auto result = reconstruct_curve(points);
  ASSERT_THAT(result.edges, SizeIs(8));
  EXPECT_EQ(result.counts.duplicates, 1);
  double area = 0;
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    const auto& [a, b] = result.edges[i];
    area += points[a].x() * points[b].y() - points[a].y() * points[b].x();
    EXPECT_EQ(b, result.edges[i % 4 == 3 ? i - 3 : i + 1][0]);
  }
  EXPECT_EQ(area / 2, 2);
}

TEST(Curve, HasNoEdgesOnALine) {
  for (const std::size_t n : {0, 1, 2, 50}) {
    const auto result = reconstruct_curve(
        tests::make_points<2>(tests::Family::AxisCollinear, n, 1));
    EXPECT_LT(result.dimension, 2);
    EXPECT_THAT(result.edges, IsEmpty());
  }
}

TEST(DelaunayEdges, AgreeWithTheDefinitionOfGabriel) {
  for (const tests::Family family : tests::kFamilies) {
    SCOPED_TRACE(testing::Message() << tests::name(family));
    const Triangulation2 t(tests::make_points<2>(family, 60, 14));
    for (const DelaunayEdge& edge : delaunay_edges(t)) {
      const bool empty = std::ranges::all_of(t.points(), [&](const Point2& p) {
        return predicates::gabriel_edge(t.point(edge.ends[0]).data(),
                                        t.point(edge.ends[1]).data(),
                                        p.data()) >= 0;
      });
      EXPECT_EQ(edge.is_gabriel, empty);
    }
  }
}

TEST(DelaunayEdges, LambdaIsTheSineOfTheOppositeAngle) {
  // Legs 3 and 4: sines 3/5 and 4/5; every edge is on the hull, so 0 wins.
  const Triangulation2 right(std::vector<Point2>{{0, 0}, {3, 0}, {0, 4}});
  for (const DelaunayEdge& edge : delaunay_edges(right))
    EXPECT_EQ(edge.lambda_lower, 0);

  // A thin kite: the diagonal's angles are right ones, or 2 atan(h).
  for (const double h : {1.0, 0x1p-20, 0x1p-40, 0x1p-500, 0x1p-1000}) {
    SCOPED_TRACE(testing::Message() << "h = " << h);
    const Triangulation2 kite(
        std::vector<Point2>{{-h, 0}, {h, 0}, {0, 1}, {0, -1}});
    const auto edges = delaunay_edges(kite);
    ASSERT_THAT(edges, SizeIs(5));
    const auto diagonal =
        std::ranges::max_element(edges, {}, &DelaunayEdge::lambda_lower);
    const double expected = std::sin(2 * std::atan(h));
    EXPECT_NEAR(diagonal->lambda_lower, expected, 0x1p-50 * expected);
  }
}

TEST(DelaunayEdges, LambdaIsRightWhereRoundedDifferencesAreNot) {
  // Seen from (1, 1), both ends of the short edge lie at the rounded (-1, -1).
  const double length = 0x3p-70;
  const auto edges = delaunay_edges(Triangulation2(
      std::vector<Point2>{{0, 0}, {length, 0}, {1, 1}, {1, -1}}));
  const auto shortest =
      std::ranges::min_element(edges, {}, &DelaunayEdge::length);
  ASSERT_EQ(shortest->length, length);
  EXPECT_NEAR(shortest->lambda_lower, length / 2, 0x1p-50 * length);
}

TEST(CurveFilter, PicksTheTwoBestGabrielEdges) {
  const auto edge = [](unsigned a, unsigned b, double lambda, double length,
                       bool gabriel) {
    return DelaunayEdge{{VertexId{a}, VertexId{b}}, lambda, length, gabriel};
  };
  // At 0: 1 by lambda, 2 before 3 by length; 4 is no Gabriel edge.
  const std::vector<DelaunayEdge> edges = {
      edge(0, 1, 0.1, 9, true), edge(0, 2, 0.2, 1, true),
      edge(0, 3, 0.2, 2, true), edge(0, 4, 0.0, 1, false)};
  const auto result = curve_filter(5, edges);
  EXPECT_THAT(result.edges, ElementsAreArray({edges[0].ends, edges[1].ends}));
  EXPECT_THAT(result.agreed, IsEmpty());
  EXPECT_THAT(
      result.without_umbrella,
      ElementsAreArray({VertexId{1}, VertexId{2}, VertexId{3}, VertexId{4}}));
}

TEST(CurveClosing, ReportsAPointThatNoCurveCanPass) {
  // Point 3 has one edge only: nothing closes, nothing is lost.
  const auto edge = [](unsigned a, unsigned b) {
    return DelaunayEdge{{VertexId{a}, VertexId{b}}, 0.5, 1, true};
  };
  const std::vector<DelaunayEdge> edges = {edge(0, 1), edge(0, 2), edge(1, 2),
                                           edge(2, 3)};
  const std::vector<Edge> agreed = {edges[0].ends, edges[1].ends,
                                    edges[2].ends};
  const auto result = close_curve(4, edges, agreed);
  EXPECT_THAT(result.open, ElementsAreArray({VertexId{3}}));
  EXPECT_THAT(result.edges, ElementsAreArray(agreed));
  EXPECT_GT(result.report.infeasible, 0);
}

TEST(CurveClosing, CutsUpSmallPiecesWhereItCan) {
  // Two triangles 0 1 2 and 3 4 5 with short edges, joined by longer ones:
  // worst-first alone would keep the triangles.
  const auto edge = [](unsigned a, unsigned b, double length) {
    return DelaunayEdge{{VertexId{a}, VertexId{b}}, 0.5, length, true};
  };
  const std::vector<DelaunayEdge> edges = {
      edge(0, 1, 1), edge(0, 2, 1), edge(0, 3, 3), edge(1, 2, 1), edge(1, 4, 2),
      edge(2, 5, 2), edge(3, 4, 1), edge(3, 5, 1), edge(4, 5, 1)};
  const auto pieces = close_curve(6, edges, {}, {.piece_edges = 0});
  EXPECT_THAT(pieces.edges,
              ElementsAreArray({edges[0].ends, edges[1].ends, edges[3].ends,
                                edges[6].ends, edges[7].ends, edges[8].ends}));
  const auto whole = close_curve(6, edges, {}, {.piece_edges = 4});
  EXPECT_THAT(whole.edges,
              ElementsAreArray({edges[0].ends, edges[1].ends, edges[4].ends,
                                edges[5].ends, edges[6].ends, edges[7].ends}));
  EXPECT_THAT(whole.open, IsEmpty());
}

TEST(Curve, NamesTheRowThatIsNotFinite) {
  const std::vector<Point2> points = {{0, 0}, {0, std::nan("")}, {1, 0}};
  EXPECT_THROW(reconstruct_curve(points), std::invalid_argument);
}

/// Also where squares of distances overflow or vanish, or sums nearly do.
TEST(ReconstructCurve, IsTheSameAtAnyScale) {
  std::mt19937_64 rng(20261122);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point2> points;
  for (int i = 0; i < 60; ++i) {
    const double angle = std::numbers::pi * unit(rng);
    points.emplace_back(std::cos(angle) + 0.01 * unit(rng),
                        std::sin(angle) + 0.01 * unit(rng));
  }
  for (const CurveMode mode :
       {CurveMode::Auto, CurveMode::Paper, CurveMode::Closed, CurveMode::Open,
        CurveMode::Tour, CurveMode::Mutual}) {
    const auto expected = reconstruct_curve(points, {.mode = mode});
    for (const int exponent : {-960, -800, -300, 300, 800, 1022}) {
      SCOPED_TRACE(testing::Message() << "mode " << static_cast<int>(mode)
                                      << ", times 2^" << exponent);
      std::vector<Point2> scaled;
      for (const Point2& p : points)
        scaled.emplace_back(std::ldexp(p.x(), exponent),
                            std::ldexp(p.y(), exponent));
      const auto result = reconstruct_curve(scaled, {.mode = mode});
      EXPECT_EQ(result.edges, expected.edges);
      EXPECT_EQ(result.tour.has_value(), mode == CurveMode::Tour);
      if (!result.tour) continue;
      EXPECT_EQ(result.tour->length,
                std::ldexp(expected.tour->length, exponent));
    }
  }
}

/// No power of two leaves all of them as they are, and a spacing times the
/// price of a gap is infinite.
TEST(ReconstructCurve, EndsWhereScalesAreFarApart) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Point2> points = {{0, 1e-305}, {1e-300, 1e-300}};
  for (int i = 0; i < 200; ++i) {
    const double angle = std::numbers::pi * unit(rng);
    points.emplace_back(std::ldexp(std::cos(angle) + 0.05 * unit(rng), 1000),
                        std::ldexp(std::sin(angle) + 0.05 * unit(rng), 1000));
  }
  const auto result = reconstruct_curve(points, {.mode = CurveMode::Tour});
  EXPECT_EQ(result.counts.duplicates, 0U);
  EXPECT_TRUE(result.tour);
}

}  // namespace
}  // namespace umbrella
