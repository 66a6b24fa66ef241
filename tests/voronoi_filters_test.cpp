#include "umbrella/voronoi_filters.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "tests/support/point_sets.h"
#include "umbrella/poles.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;

std::vector<Triangle> corners(const std::vector<LocatedTriangle>& triangles) {
  std::vector<Triangle> result;
  for (const LocatedTriangle& t : triangles) result.push_back(t.corners);
  return result;
}

Point3 center_of(const std::array<Point3, 4>& p) {
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  for (int i = 0; i < 3; ++i) {
    A.row(i) = 2 * (p[i + 1] - p[0]).transpose();
    b[i] = p[i + 1].squaredNorm() - p[0].squaredNorm();
  }
  return A.fullPivLu().solve(b);
}

/// Every quadruple of points with an empty sphere, and its centre.
struct Ball {
  std::array<std::size_t, 4> corners;
  Point3 center;
};

std::vector<Ball> empty_balls(const std::vector<Point3>& p) {
  std::vector<Ball> result;
  const std::size_t n = p.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c)
        for (std::size_t d = c + 1; d < n; ++d) {
          const Point3 center = center_of({p[a], p[b], p[c], p[d]});
          const double R = (p[a] - center).norm();
          const bool is_empty =
              std::all_of(p.begin(), p.end(), [&](const Point3& q) {
                return (q - center).norm() >= R * (1 - 1e-9);
              });
          if (is_empty) result.push_back({{a, b, c, d}, center});
        }
  return result;
}

/// The triangles of the hull and their outward normals.
std::vector<std::pair<std::array<std::size_t, 3>, Point3>> hull(
    const std::vector<Point3>& p) {
  std::vector<std::pair<std::array<std::size_t, 3>, Point3>> result;
  const std::size_t n = p.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) {
        const Point3 normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
        double least = 0, most = 0;
        for (const Point3& q : p) {
          least = std::min(least, normal.dot(q - p[a]));
          most = std::max(most, normal.dot(q - p[a]));
        }
        if (most < 1e-12) result.push_back({{a, b, c}, normal});
        if (least > -1e-12) result.push_back({{a, b, c}, -normal});
      }
  return result;
}

struct BrutePoles {
  Point3 normal = Point3::Zero();
  std::vector<Point3> poles;
};

/// By the definition, for each point.
std::vector<BrutePoles> brute_poles(const std::vector<Point3>& p) {
  const auto balls = empty_balls(p);
  const auto facets = hull(p);
  std::vector<BrutePoles> result(p.size());
  for (std::size_t v = 0; v < p.size(); ++v) {
    std::vector<Point3> centers;
    for (const Ball& ball : balls)
      if (std::count(ball.corners.begin(), ball.corners.end(), v) > 0)
        centers.push_back(ball.center);
    const auto is_nearer = [&](const Point3& a, const Point3& b) {
      return (a - p[v]).norm() < (b - p[v]).norm();
    };
    Point3 normal = Point3::Zero();
    for (const auto& [facet, n] : facets)
      if (std::count(facet.begin(), facet.end(), v) > 0) normal += n;
    if (normal.isZero()) {
      const Point3 pole =
          *std::max_element(centers.begin(), centers.end(), is_nearer);
      result[v].poles.push_back(pole);
      normal = pole - p[v];
    }
    std::erase_if(centers,
                  [&](const Point3& c) { return normal.dot(c - p[v]) >= 0; });
    if (!centers.empty())
      result[v].poles.push_back(
          *std::max_element(centers.begin(), centers.end(), is_nearer));
    result[v].normal = normal.normalized();
  }
  return result;
}

std::vector<Point3> points_of(const Triangulation3& t) {
  return {t.points().begin(), t.points().end()};
}

TEST(Poles, AreTheFarthestVoronoiVertices) {
  for (std::uint64_t trial = 0; trial < 6; ++trial) {
    const Triangulation3 t(tests::make_points<3>(Family::Uniform, 16, trial));
    const Circumspheres spheres(t);
    const auto centers = circumcenters(t, spheres);
    const auto found = poles(t, spheres, centers);
    const auto expected = brute_poles(points_of(t));
    for (std::size_t v = 0; v < found.size(); ++v) {
      SCOPED_TRACE(testing::Message() << "trial " << trial << " point " << v);
      EXPECT_LT((found[v].normal - expected[v].normal).norm(), 1e-6);
      std::vector<Point3> places;
      if (found[v].has_outer) places.push_back(centers[index(found[v].outer)]);
      if (found[v].has_inner) places.push_back(centers[index(found[v].inner)]);
      ASSERT_EQ(places.size(), expected[v].poles.size());
      for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_LT((places[i] - expected[v].poles[i]).norm(), 1e-6);
    }
  }
}

TEST(Crust, IsTheTrianglesOfSamplesThatNoPoleBreaks) {
  std::size_t n_broken = 0;
  for (std::uint64_t trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Triangulation3 t(tests::make_points<3>(Family::Uniform, 12, trial));
    std::vector<Point3> points = points_of(t);
    for (const BrutePoles& p : brute_poles(points_of(t)))
      for (const Point3& pole : p.poles) {
        const bool is_new = std::none_of(
            points.begin(), points.end(),
            [&](const Point3& q) { return (q - pole).norm() < 1e-9; });
        if (is_new) points.push_back(pole);
      }
    std::set<Triangle> expected;
    for (const Ball& ball : empty_balls(points))
      for (std::size_t skip = 0; skip < 4; ++skip) {
        Triangle abc{};
        bool are_samples = true;
        for (std::size_t i = 0, k = 0; i < 4; ++i) {
          if (i == skip) continue;
          are_samples = are_samples && ball.corners[i] < 12;
          abc[k++] = VertexId{static_cast<std::uint32_t>(ball.corners[i])};
        }
        if (are_samples) expected.insert(abc);
      }
    const auto found = corners(crust(t, Circumspheres(t)));
    EXPECT_EQ(std::set<Triangle>(found.begin(), found.end()), expected);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    n_broken += 2 * t.n_finite_cells() - found.size();
  }
  EXPECT_GT(n_broken, 50U);
}

/// The least |cosine| between the normal and what lies on the dual edge from
/// `from` to `to`, or from `from` on in direction `to`; none if it has no end
/// and no direction.
double least_cosine(const Point3& p, const Point3& normal, const Point3& from,
                    const Point3& to, bool is_ray) {
  constexpr int kSteps = 4000;
  double least = 1;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    const Point3 x = is_ray ? Point3(from + s / (1.000001 - s) * to)
                            : Point3((1 - s) * from + s * to);
    least = std::min(least, std::abs(normal.dot((x - p).normalized())));
  }
  return least;
}

TEST(Cocone, HoldsTrianglesWhoseDualEdgeMeetsAllThreeCocones) {
  const double angle = std::numbers::pi / 8;
  std::size_t n_in = 0, n_out = 0;
  for (std::uint64_t trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Triangulation3 t(tests::make_points<3>(Family::Uniform, 14, trial));
    const std::vector<Point3> p = points_of(t);
    const auto normals = brute_poles(p);
    const auto balls = empty_balls(p);
    const auto found = corners(cocone(t, Circumspheres(t), angle));
    std::map<std::array<std::size_t, 3>, std::vector<Point3>> ends;
    for (const Ball& ball : balls)
      for (std::size_t skip = 0; skip < 4; ++skip) {
        std::array<std::size_t, 3> abc{};
        for (std::size_t i = 0, k = 0; i < 4; ++i)
          if (i != skip) abc[k++] = ball.corners[i];
        ends[abc].push_back(ball.center);
      }
    const auto outside = hull(p);
    for (const auto& [abc, centers] : ends) {
      const bool is_ray = centers.size() == 1;
      Point3 to = is_ray ? Point3::Zero() : centers[1];
      for (const auto& [facet, normal] : outside)
        if (is_ray && facet == abc) to = normal;
      double worst = 0;
      Triangle key{};
      for (std::size_t i = 0; i < 3; ++i) {
        key[i] = VertexId{static_cast<std::uint32_t>(abc[i])};
        worst = std::max(worst, least_cosine(p[abc[i]], normals[abc[i]].normal,
                                             centers[0], to, is_ray));
      }
      if (std::abs(worst - std::sin(angle)) < 1e-3) continue;
      const bool is_in = worst < std::sin(angle);
      EXPECT_EQ(std::binary_search(found.begin(), found.end(), key), is_in);
      ++(is_in ? n_in : n_out);
    }
  }
  EXPECT_GT(n_in, 20U);
  EXPECT_GT(n_out, 100U);
}

TEST(VoronoiFilters, GiveDelaunayTrianglesOfAnyPoints) {
  for (const Family family : tests::kFamilies) {
    SCOPED_TRACE(tests::name(family));
    auto points = tests::make_points<3>(family, 14, 4);
    const Triangulation3 t(points);
    const auto by_crust = corners(crust(t, Circumspheres(t)));
    const auto by_cocone = corners(cocone(t, Circumspheres(t)));
    std::mt19937_64 rng(3);
    std::shuffle(points.begin(), points.end(), rng);
    const Triangulation3 shuffled(points);
    EXPECT_EQ(corners(crust(shuffled, Circumspheres(shuffled))), by_crust);
    EXPECT_EQ(corners(cocone(shuffled, Circumspheres(shuffled))), by_cocone);
  }
}

}  // namespace
}  // namespace umbrella
