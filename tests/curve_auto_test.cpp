#include "umbrella/curve_auto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/support/curve_instances.h"
#include "tests/support/point_sets.h"
#include "umbrella/curve.h"
#include "umbrella/curve_picks_internal.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;
using testing::ElementsAreArray;

std::vector<tests::CurveEdge> edges_by(CurveMode mode,
                                       const tests::CurveInstance& instance) {
  return tests::in_order(
      reconstruct_curve(instance.points, {.mode = mode}).edges);
}

TEST(CurveAuto, IsExactOnNineOfTenCleanSamples) {
  constexpr unsigned kTrials = 20;
  unsigned n_all = 0, n_all_exact = 0;
  for (const std::string_view group : tests::clean_curve_groups()) {
    SCOPED_TRACE(group);
    unsigned n = 0, n_exact = 0, n_filter = 0;
    for (unsigned trial = 0; trial < kTrials; ++trial) {
      const auto instance = tests::make_curve_instance(group, 900'000 + trial);
      if (!tests::truth_is_delaunay(instance)) continue;
      ++n;
      n_exact += edges_by(CurveMode::Auto, instance) == instance.truth ? 1 : 0;
      n_filter +=
          edges_by(CurveMode::Paper, instance) == instance.truth ? 1 : 0;
    }
    EXPECT_GT(n, kTrials / 2);
    EXPECT_GE(4 * n_exact, 3 * n);
    EXPECT_GE(n_exact, n_filter);
    n_all += n;
    n_all_exact += n_exact;
  }
  EXPECT_GE(10 * n_all_exact, 9 * n_all);
}

TEST(CurveAuto, FindsTheEndsOfOpenCurves) {
  // The filter joins both ends, closing has to.
  const auto instance = tests::make_curve_instance("open", 900'101);
  EXPECT_NE(edges_by(CurveMode::Closed, instance), instance.truth);
  EXPECT_EQ(edges_by(CurveMode::Auto, instance), instance.truth);
  EXPECT_EQ(edges_by(CurveMode::Open, instance), instance.truth);
}

TEST(CurveAuto, LeavesAFewScatteredPointsAlone) {
  const auto curve = tests::make_curve_instance("smooth", 900'102);
  std::mt19937_64 rng(900'103);
  std::uniform_real_distribution<double> unit(0, 0.5);
  for (unsigned trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto spoilt = curve;
    for (unsigned n = 1; n <= 12; ++n) {
      const Point2 p{20 + 2 * n + unit(rng), 20 + unit(rng)};
      spoilt.points.push_back(p);
      // Twelve are many enough for a curve.
      const auto edges = edges_by(CurveMode::Auto, spoilt);
      if (n <= 6) {
        EXPECT_EQ(edges, spoilt.truth);
      } else if (n == 12) {
        EXPECT_GT(edges.size(), spoilt.truth.size());
      }
    }
  }
}

TEST(CurveAuto, LinksAreMutualDelaunayEdges) {
  for (const tests::Family family : tests::kFamilies) {
    SCOPED_TRACE(tests::name(family));
    const Triangulation2 t(tests::make_points<2>(family, 120, 51));
    if (t.dimension() < 2) continue;
    const auto edges = delaunay_edges(t);
    const CurveAutoResult result = auto_curves(t);
    for (std::uint32_t i = 0; i < result.links.size(); ++i) {
      const VertexId v{i};
      for (const VertexId w : result.links[i]) {
        if (w == delaunay::kInfinite) continue;
        EXPECT_THAT(result.links[index(w)], testing::Contains(v));
        const Edge ends = {std::min(v, w), std::max(v, w)};
        EXPECT_TRUE(
            std::ranges::binary_search(edges, ends, {}, &DelaunayEdge::ends));
      }
      EXPECT_TRUE(result.links[i][0] == delaunay::kInfinite ||
                  result.links[i][0] != result.links[i][1]);
    }
  }
}

TEST(CurveAuto, DoesNotDependOnTheUnitOfLength) {
  for (const std::string_view group : tests::clean_curve_groups()) {
    SCOPED_TRACE(group);
    auto instance = tests::make_curve_instance(group, 900'201);
    const auto expected = edges_by(CurveMode::Auto, instance);
    for (Point2& p : instance.points) p *= 0x1p-300;
    EXPECT_EQ(edges_by(CurveMode::Auto, instance), expected);
  }
}

TEST(CurvePicks, AreThoseOfTheFilter) {
  for (const tests::Family family :
       {tests::Family::Uniform, tests::Family::Clustered}) {
    for (const unsigned seed : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << tests::name(family) << " " << seed);
      const Triangulation2 t(tests::make_points<2>(family, 300, seed));
      const auto edges = delaunay_edges(t);
      const auto filter = curve_filter(t.points().size(), edges);
      const PickedEdges picked = pick_edges(t);
      EXPECT_EQ(picked.n_gabriel,
                static_cast<std::size_t>(
                    std::ranges::count_if(edges, &DelaunayEdge::is_gabriel)));
      const CurveLinks links = agreed_links(picked);
      std::vector<Edge> agreed;
      for (std::uint32_t v = 0; v < links.n_vertices(); ++v)
        for (const VertexId w : links[VertexId{v}])
          if (w != CurveLinks::kNone && VertexId{v} < w)
            agreed.push_back({VertexId{v}, w});
      std::ranges::sort(agreed);
      EXPECT_THAT(agreed, ElementsAreArray(filter.agreed));
      EXPECT_EQ(auto_curves(t).report.filter_edges, filter.edges.size());
    }
  }
}

TEST(CurvePicks, NoteTheSquareOfLambda) {
  // A kite: the diagonal is no Gabriel edge, its sides lie on the hull.
  for (const double unit : {1.0, 0x1p-400, 0x1p400}) {
    const Triangulation2 t(std::vector<Point2>{
        {-unit, 0}, {unit, 0}, {0, 2 * unit}, {0, -2 * unit}, {0, 0}});
    const PickedEdges picked = pick_edges(t);
    const auto edges = delaunay_edges(t);
    for (std::uint32_t v = 0; v < 5; ++v) {
      for (const unsigned i : {0, 1}) {
        const VertexId w = picked.others[v][i];
        const Edge ends = {std::min(VertexId{v}, w), std::max(VertexId{v}, w)};
        const auto edge =
            std::ranges::lower_bound(edges, ends, {}, &DelaunayEdge::ends);
        EXPECT_NEAR(picked.lambda2[v][i],
                    edge->lambda_lower * edge->lambda_lower, 1e-14);
      }
    }
  }
}

TEST(CurveModes, TourIsOneClosedCurveThroughAllPoints) {
  for (unsigned trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto star = tests::make_curve_instance("star", 900'300 + trial);
    const auto result =
        reconstruct_curve(star.points, {.mode = CurveMode::Tour});
    ASSERT_TRUE(result.tour);
    EXPECT_EQ(result.tour->status, TourStatus::Optimal);
    EXPECT_EQ(result.edges.size(), star.points.size());
    EXPECT_EQ(result.open_rows.size(), 0);
    double length = 0;
    for (const auto& [v, w] : star.truth)
      length += (star.points[v] - star.points[w]).norm();
    EXPECT_LE(result.tour->length, length * (1 + 1e-12));
  }
}

TEST(CurveModes, MutualLeavesOutliersAlone) {
  unsigned n_wrong_mutual = 0, n_wrong_paper = 0;
  for (unsigned trial = 0; trial < 20; ++trial) {
    const auto spoilt = tests::make_curve_instance("outliers", 900'400 + trial);
    const auto n_wrong = [&](CurveMode mode) {
      std::vector<tests::CurveEdge> wrong;
      std::ranges::set_difference(edges_by(mode, spoilt), spoilt.truth,
                                  std::back_inserter(wrong));
      return static_cast<unsigned>(wrong.size());
    };
    n_wrong_mutual += n_wrong(CurveMode::Mutual);
    n_wrong_paper += n_wrong(CurveMode::Paper);
  }
  EXPECT_LT(3 * n_wrong_mutual, n_wrong_paper);
}

}  // namespace
}  // namespace umbrella
