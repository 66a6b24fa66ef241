#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/point_sets.h"
#include "umbrella/curve.h"
#include "umbrella/curve_straightening_internal.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;

/// A shortest tour through random points, as it stands before straightening.
struct Tour {
  Triangulation2 t;
  CurveGraph graph;
  CurveLinks links;

  explicit Tour(unsigned seed)
      : t(tests::make_points<2>(tests::Family::Uniform, 40, seed)),
        graph(t),
        links(t.points().size()) {
    const std::vector<Point2> points(t.points().begin(), t.points().end());
    for (const auto& [v, w] :
         reconstruct_curve(points, {.mode = CurveMode::Tour}).edges)
      links.add(VertexId{v}, VertexId{w});
  }
};

double corner(const Triangulation2& t, VertexId v, VertexId a, VertexId b) {
  const Point2 to_a = t.point(a) - t.point(v);
  const Point2 to_b = t.point(b) - t.point(v);
  const double cosine = to_a.dot(to_b) / (to_a.norm() * to_b.norm());
  return 0.75 * std::min(to_a.norm(), to_b.norm()) * (1 + cosine);
}

double cost(CurveGraph& graph, const std::vector<VertexId>& curve) {
  const std::size_t n = curve.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const VertexId next = curve[(i + 1) % n];
    sum += graph.arc(curve[i], next)->cost +
           corner(graph.triangulation(), next, curve[i], curve[(i + 2) % n]);
  }
  return sum;
}

TEST(CurveStraightening, KeepsOneCurveAndLowersItsCost) {
  std::size_t n_made = 0;
  for (unsigned trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Tour tour(1100 + trial);
    const auto before = tour.links.closed_curve_through(VertexId{0});
    ASSERT_EQ(before.size(), tour.links.n_vertices());
    const double cost_before = cost(tour.graph, before);
    CurveStraightening straightening(tour.graph, tour.links);
    const std::size_t n = straightening.run(before);
    const auto after = tour.links.closed_curve_through(VertexId{0});
    ASSERT_EQ(after.size(), before.size());
    EXPECT_LE(cost(tour.graph, after),
              cost_before * (n > 0 ? 1 - 1e-12 : 1 + 1e-12));
    EXPECT_EQ(straightening.run(after), 0);
    n_made += n;
  }
  EXPECT_GT(n_made, 10);
}

TEST(CurveStraightening, LeavesNoReversalThatPays) {
  unsigned n_tried = 0;
  for (unsigned trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Tour tour(1200 + trial);
    CurveStraightening(tour.graph, tour.links)
        .run(tour.links.closed_curve_through(VertexId{0}));
    const auto curve = tour.links.closed_curve_through(VertexId{0});
    const double least = cost(tour.graph, curve);
    const std::size_t n = curve.size();
    // From place i + 1 to place j.
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 2; j < n && j - i < n - 1; ++j) {
        auto* const one = tour.graph.arc(curve[i], curve[j]);
        auto* const two = tour.graph.arc(curve[i + 1], curve[(j + 1) % n]);
        if (one == nullptr || two == nullptr) continue;
        const double dropped =
            std::max(tour.graph.arc(curve[i], curve[i + 1])->cost,
                     tour.graph.arc(curve[j], curve[(j + 1) % n])->cost);
        if (std::min(one->cost, two->cost) >= dropped) continue;  // no trail
        auto other = curve;
        std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i + 1),
                     other.begin() + static_cast<std::ptrdiff_t>(j + 1));
        EXPECT_GE(cost(tour.graph, other), least * (1 - 1e-12));
        ++n_tried;
      }
    }
  }
  EXPECT_GT(n_tried, 20);
}

TEST(CurveStraightening, ExchangesOnlyLinksBetweenNearVertices) {
  std::size_t n_made = 0;
  for (unsigned trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Tour tour(1300 + trial);
    const CurveLinks before = tour.links;
    const auto is_near = [&](VertexId v) { return tour.t.point(v).x() < 0.5; };
    auto near = before.closed_curve_through(VertexId{0});
    const std::size_t n = near.size();
    std::erase_if(near, [&](VertexId v) { return !is_near(v); });
    n_made += CurveStraightening(tour.graph, tour.links).run(near);
    EXPECT_EQ(tour.links.closed_curve_through(VertexId{0}).size(), n);
    for (std::uint32_t i = 0; i < n; ++i) {
      const VertexId v{i};
      for (const VertexId w : before[v]) {
        EXPECT_TRUE(tour.links.has(v, w) || (is_near(v) && is_near(w)));
      }
    }
  }
  EXPECT_GT(n_made, 3);
}

}  // namespace
}  // namespace umbrella
