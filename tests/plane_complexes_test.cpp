#include "umbrella/plane_complexes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "predicates/gabriel.h"
#include "tests/support/point_sets.h"

namespace umbrella {
namespace {

using delaunay::Point2;
using delaunay::Triangulation2;
using delaunay::VertexId;
using tests::Family;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Whether the open disc through the ends with its centre at this signed height
/// over the edge, or for infinity the half-plane, holds no point.
bool is_empty(const Triangulation2& t, const Edge& edge, double height) {
  const Point2 a = t.point(edge[0]), b = t.point(edge[1]);
  const Point2 along = (b - a).normalized();
  const Point2 normal(-along.y(), along.x());
  for (std::uint32_t i = 0; i < t.points().size(); ++i) {
    if (VertexId{i} == edge[0] || VertexId{i} == edge[1]) continue;
    const Point2 w = t.points()[i] - (a + b) / 2;
    const double up = normal.dot(w);
    if (std::isinf(height)
            ? (height < 0 ? up < 0 : up > 0)
            : w.squaredNorm() - (b - a).squaredNorm() / 4 < 2 * height * up)
      return false;
  }
  return true;
}

double half_length(const Triangulation2& t, const Edge& edge) {
  return (t.point(edge[0]) - t.point(edge[1])).norm() / 2;
}

/// Of the centre of a disc of radius R.
double height_of(double half, double R) {
  return R <= half ? 0 : std::sqrt(R * R - half * half);
}

std::vector<Edge> pairs_where(const Triangulation2& t,
                              const std::function<bool(const Edge&)>& holds) {
  std::vector<Edge> result;
  const auto n = static_cast<std::uint32_t>(t.points().size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = i + 1; k < n; ++k)
      if (holds({VertexId{i}, VertexId{k}}))
        result.push_back({VertexId{i}, VertexId{k}});
  return result;
}

/// One of the discs with that centre, on either side, is empty.
bool one_is_empty(const Triangulation2& t, const Edge& e, double height) {
  return is_empty(t, e, height) || is_empty(t, e, -height);
}

TEST(PlaneComplexes, HoldWhatTheirDefinitionsSay) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Triangulation2 t(tests::make_points<2>(Family::Uniform, 40, trial));
    EXPECT_EQ(beta_skeleton(t, 1.3), pairs_where(t, [&](const Edge& e) {
                const double half = half_length(t, e);
                const double h = height_of(half, 1.3 * half);
                return is_empty(t, e, h) && is_empty(t, e, -h);
              }));
    EXPECT_EQ(alpha_shape(t, 0.1), pairs_where(t, [&](const Edge& e) {
                const double half = half_length(t, e);
                return half <= 0.1 && one_is_empty(t, e, height_of(half, 0.1));
              }));
    EXPECT_EQ(lambda_complex(t, 0.3, 0.8), pairs_where(t, [&](const Edge& e) {
                const double half = half_length(t, e);
                for (const double lambda : {0.3, 0.4, 0.55, 0.7, 0.8})
                  if (!one_is_empty(t, e, height_of(half, half / lambda)))
                    return false;
                return true;
              }));
    EXPECT_EQ(gamma_graph(t, -0.2, 0.6), pairs_where(t, [&](const Edge& e) {
                const double half = half_length(t, e);
                const double h0 = -height_of(half, half / 0.8);
                const double h1 = height_of(half, half / 0.4);
                return (is_empty(t, e, h0) && is_empty(t, e, h1)) ||
                       (is_empty(t, e, -h0) && is_empty(t, e, -h1));
              }));
  }
}

bool is_gabriel(const Triangulation2& t, const Edge& edge) {
  return std::all_of(
      t.points().begin(), t.points().end(), [&](const Point2& p) {
        return predicates::gabriel_edge(t.point(edge[0]).data(),
                                        t.point(edge[1]).data(), p.data()) >= 0;
      });
}

bool is_subset(const std::vector<Edge>& small, const std::vector<Edge>& large) {
  return std::includes(large.begin(), large.end(), small.begin(), small.end());
}

TEST(PlaneComplexes, KeepTheLawsOnAnyPoints) {
  for (const Family family : tests::kFamilies) {
    SCOPED_TRACE(tests::name(family));
    const Triangulation2 t(tests::make_points<2>(family, 30, 5));
    const auto gabriel = gabriel_complex(t);
    EXPECT_EQ(beta_skeleton(t, 1), gabriel);
    EXPECT_EQ(lambda_complex(t, 1, 1), gabriel);
    EXPECT_EQ(gamma_graph(t, 0, 0), gabriel);
    for (const Edge& edge : gabriel) EXPECT_TRUE(is_gabriel(t, edge));
    std::vector<Edge> hull;
    for (const auto& cell : t.cells().subspan(t.n_finite_cells()))
      hull.push_back({std::min(cell.vertex[0], cell.vertex[1]),
                      std::max(cell.vertex[0], cell.vertex[1])});
    std::sort(hull.begin(), hull.end());
    EXPECT_EQ(alpha_shape(t, kInfinity), hull);
    EXPECT_EQ(gamma_graph(t, 1, 1), hull);
    EXPECT_TRUE(is_subset(beta_skeleton(t, 2), beta_skeleton(t, 1.25)));
    EXPECT_TRUE(is_subset(beta_skeleton(t, 1.25), gabriel));
    EXPECT_EQ(gamma_graph(t, -0.5, 0.5), beta_skeleton(t, 2));
    EXPECT_EQ(gamma_graph(t, 0.25, 0.5), lambda_complex(t, 0.5, 0.75));
  }
}

// In general position the Gabriel graph is also found without a triangulation.
TEST(PlaneComplexes, HoldEveryGabrielEdge) {
  const Triangulation2 t(tests::make_points<2>(Family::Uniform, 60, 1));
  EXPECT_EQ(beta_skeleton(t, 1),
            pairs_where(t, [&](const Edge& e) { return is_gabriel(t, e); }));
}

TEST(PlaneComplexes, TouchEveryPointAtTheSmallestAlpha) {
  const Triangulation2 t(tests::make_points<2>(Family::Rounded, 50, 2));
  const auto alpha = smallest_alpha(t);
  ASSERT_TRUE(alpha);
  const auto touched = [&](double a) {
    std::vector<bool> seen(t.points().size());
    for (const Edge& edge : alpha_shape(t, a))
      for (const VertexId v : edge) seen[index(v)] = true;
    return std::count(seen.begin(), seen.end(), true);
  };
  EXPECT_EQ(touched(*alpha), 50);
  EXPECT_LT(touched(*alpha * (1 - 1e-9)), 50);
}

}  // namespace
}  // namespace umbrella
