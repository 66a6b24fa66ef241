#include "umbrella/complexes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "predicates/gabriel.h"
#include "tests/support/point_sets.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Triangle> corners(const std::vector<LocatedTriangle>& triangles) {
  std::vector<Triangle> result;
  for (const LocatedTriangle& t : triangles) result.push_back(t.corners);
  return result;
}

/// A triangulation, and its complexes by corners.
struct Sample {
  explicit Sample(const std::vector<Point3>& points) : t(points), spheres(t) {}

  std::vector<Triangle> lambda(double a, double b) const {
    return corners(lambda_complex(t, spheres, a, b));
  }
  std::vector<Triangle> gabriel() const {
    return corners(gabriel_complex(t, spheres));
  }
  std::vector<Triangle> beta(double b) const {
    return corners(beta_skeleton(t, spheres, b));
  }
  std::vector<Triangle> gamma(double c0, double c1) const {
    return corners(gamma_graph(t, spheres, c0, c1));
  }
  std::vector<Triangle> alpha(double a) const {
    return corners(alpha_shape(t, spheres, a));
  }

  Triangulation3 t;
  Circumspheres spheres;
};

/// The circle through the corners of a triangle.
struct Circle {
  Circle(const Triangulation3& t, const Triangle& abc) {
    const Point3 a = t.point(abc[0]);
    const Point3 u = t.point(abc[1]) - a, v = t.point(abc[2]) - a;
    const Point3 n = u.cross(v);
    const Point3 to_center =
        (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) /
        (2 * n.squaredNorm());
    center = a + to_center;
    normal = n.normalized();
    radius = to_center.norm();
  }
  Point3 center, normal;
  double radius;
};

/// Whether the open ball through the triangle with its centre at this signed
/// height over it, or for infinity the half-space, holds no other point.
bool is_empty(const Triangulation3& t, const Triangle& abc, double height) {
  const Circle circle(t, abc);
  for (std::uint32_t i = 0; i < t.points().size(); ++i) {
    if (std::find(abc.begin(), abc.end(), VertexId{i}) != abc.end()) continue;
    const Point3 w = t.points()[i] - circle.center;
    const double along = circle.normal.dot(w);
    if (std::isinf(height)) {
      if (std::signbit(height) ? along < 0 : along > 0) return false;
    } else if (w.squaredNorm() - circle.radius * circle.radius <
               2 * height * along) {
      return false;
    }
  }
  return true;
}

double height_of(double radius, double R) {
  return R == radius ? 0 : std::sqrt(R * R - radius * radius);
}

using Holds = std::function<bool(const Triangle&)>;

/// All triples of vertices for which `holds`, Delaunay or not.
std::vector<Triangle> triples_where(const Triangulation3& t,
                                    const Holds& holds) {
  std::vector<Triangle> result;
  const auto n = static_cast<std::uint32_t>(t.points().size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      for (std::uint32_t k = j + 1; k < n; ++k) {
        const Triangle abc = {VertexId{i}, VertexId{j}, VertexId{k}};
        if (holds(abc)) result.push_back(abc);
      }
  return result;
}

Sample uniform_sample(std::uint64_t seed) {
  return Sample(tests::make_points<3>(Family::Uniform, 16, seed));
}

TEST(LambdaComplex, HoldsWhatDefinition21Says) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    const Sample s = uniform_sample(trial);
    for (const auto& range : {std::pair(0.0, 0.5), std::pair(0.2, 0.7),
                              std::pair(0.5, 1.0), std::pair(0.4, 0.4)}) {
      const double a = range.first, b = range.second;
      SCOPED_TRACE(testing::Message() << trial << ": " << a << ' ' << b);
      EXPECT_EQ(s.lambda(a, b), triples_where(s.t, [&](const Triangle& abc) {
                  for (int k = 0; k <= 8; ++k) {
                    const double lambda = a + (b - a) * k / 8;
                    const double r = Circle(s.t, abc).radius;
                    const double h =
                        lambda == 0 ? kInfinity : height_of(r, r / lambda);
                    if (!is_empty(s.t, abc, h) && !is_empty(s.t, abc, -h))
                      return false;
                  }
                  return true;
                }));
    }
  }
}

TEST(BetaSkeleton, HoldsTrianglesWithBothBallsEmpty) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    const Sample s = uniform_sample(trial);
    for (const double beta : {1.05, 1.5, 3.0}) {
      SCOPED_TRACE(testing::Message() << trial << ": " << beta);
      EXPECT_EQ(s.beta(beta), triples_where(s.t, [&](const Triangle& abc) {
                  const double r = Circle(s.t, abc).radius;
                  const double h = height_of(r, beta * r);
                  return is_empty(s.t, abc, h) && is_empty(s.t, abc, -h);
                }));
    }
  }
}

TEST(GammaGraph, HoldsTrianglesWithTheTwoBallsEmpty) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    const Sample s = uniform_sample(trial);
    for (const auto& range :
         {std::pair(-0.5, 0.2), std::pair(0.1, 0.6), std::pair(-0.7, -0.3),
          std::pair(-1.0, 0.3), std::pair(0.4, 1.0)}) {
      const double c0 = range.first, c1 = range.second;
      SCOPED_TRACE(testing::Message() << trial << ": " << c0 << ' ' << c1);
      EXPECT_EQ(s.gamma(c0, c1), triples_where(s.t, [&](const Triangle& abc) {
                  const double r = Circle(s.t, abc).radius;
                  const auto height = [&](double c) {
                    return std::abs(c) == 1
                               ? std::copysign(kInfinity, c)
                               : std::copysign(
                                     height_of(r, r / (1 - std::abs(c))), c);
                  };
                  const double h0 = height(c0), h1 = height(c1);
                  return (is_empty(s.t, abc, h0) && is_empty(s.t, abc, h1)) ||
                         (is_empty(s.t, abc, -h0) && is_empty(s.t, abc, -h1));
                }));
    }
  }
}

TEST(AlphaShape, HoldsTrianglesWithAnEmptyBallOfThatRadius) {
  std::size_t n_found = 0;
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    const Sample s = uniform_sample(trial);
    for (const double alpha : {0.2, 0.35, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << trial << ": " << alpha);
      const auto shape = s.alpha(alpha);
      n_found += shape.size();
      EXPECT_EQ(shape, triples_where(s.t, [&](const Triangle& abc) {
                  const double r = Circle(s.t, abc).radius;
                  if (r > alpha) return false;
                  const double h = height_of(r, alpha);
                  return is_empty(s.t, abc, h) || is_empty(s.t, abc, -h);
                }));
    }
  }
  EXPECT_GT(n_found, 100U);
}

std::vector<Triangle> hull(const Triangulation3& t) {
  std::vector<Triangle> result;
  for (const auto& cell : t.cells().subspan(t.n_finite_cells())) {
    Triangle abc = {cell.vertex[0], cell.vertex[1], cell.vertex[2]};
    std::sort(abc.begin(), abc.end());
    result.push_back(abc);
  }
  std::sort(result.begin(), result.end());
  return result;
}

bool is_subset(const std::vector<Triangle>& small,
               const std::vector<Triangle>& large) {
  return std::includes(large.begin(), large.end(), small.begin(), small.end());
}

// The laws hold for ties, grids and exact spheres as for random points.
template <class Law>
void for_all_families(Law law) {
  for (const Family family : tests::kFamilies) {
    SCOPED_TRACE(tests::name(family));
    law(Sample(tests::make_points<3>(family, 11, 7)));
  }
}

TEST(Complexes, AreTheGabrielComplexAtTheirMiddle) {
  for_all_families([](const Sample& s) {
    const auto gabriel = s.gabriel();
    EXPECT_EQ(s.lambda(1, 1), gabriel);
    EXPECT_EQ(s.beta(1), gabriel);
    EXPECT_EQ(s.gamma(0, 0), gabriel);
    for (const LocatedTriangle& t : lambda_complex(s.t, s.spheres, 1, 1))
      for (const Point3& p : s.t.points())
        EXPECT_GE(predicates::gabriel_triangle(s.t.point(t.corners[0]).data(),
                                               s.t.point(t.corners[1]).data(),
                                               s.t.point(t.corners[2]).data(),
                                               p.data()),
                  0);
  });
}

TEST(Complexes, AreTheHullAtTheirEnd) {
  for_all_families([](const Sample& s) {
    const auto expected = hull(s.t);
    EXPECT_EQ(s.alpha(kInfinity), expected);
    EXPECT_EQ(s.gamma(1, 1), expected);
    EXPECT_EQ(s.lambda(0, 0), expected);
  });
}

TEST(Complexes, NestAsTheirParametersDo) {
  for_all_families([](const Sample& s) {
    EXPECT_TRUE(is_subset(s.beta(1.5), s.beta(1.1)));
    EXPECT_TRUE(is_subset(s.beta(1.1), s.gabriel()));
    EXPECT_TRUE(is_subset(s.lambda(0.2, 0.9), s.lambda(0.3, 0.8)));
    EXPECT_TRUE(is_subset(s.gamma(-0.5, 0.5), s.gamma(-0.25, 0.375)));
  });
}

TEST(Complexes, AreCasesOfTheGammaGraph) {
  for_all_families([](const Sample& s) {
    for (const double c : {0.25, 0.5, 0.75})  // 1 / (1 - c) has no rounding
      EXPECT_EQ(s.gamma(-c, c), s.beta(1 / (1 - c))) << c;
    for (const auto& [a, b] : {std::pair(0.0, 0.5), std::pair(0.25, 0.75)})
      EXPECT_EQ(s.gamma(a, b), s.lambda(1 - b, 1 - a));
  });
}

TEST(AlphaShape, OfTheSmallestAlphaTouchesEveryVertex) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Sample s(tests::make_points<3>(Family::Rounded, 100, trial));
    const auto alpha = smallest_alpha(s.t, s.spheres);
    ASSERT_TRUE(alpha);
    const auto touched = [&](double a) {
      std::vector<bool> seen(s.t.points().size());
      for (const Triangle& t : s.alpha(a))
        for (const VertexId v : t) seen[index(v)] = true;
      return std::count(seen.begin(), seen.end(), true);
    };
    EXPECT_EQ(touched(*alpha), 100);
    EXPECT_LT(touched(*alpha * (1 - 1e-9)), 100);
  }
}

TEST(Complexes, OfFlatPointsAreEmpty) {
  const Sample s(tests::make_points<3>(Family::Coplanar, 20, 1));
  EXPECT_TRUE(s.gabriel().empty());
  EXPECT_TRUE(s.alpha(1).empty());
  EXPECT_FALSE(smallest_alpha(s.t, s.spheres));
}

}  // namespace
}  // namespace umbrella
