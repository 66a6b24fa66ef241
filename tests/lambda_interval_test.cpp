#include "umbrella/lambda_interval.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "predicates/gabriel.h"
#include "predicates/predicates.h"
#include "tests/support/exact_lambda.h"
#include "tests/support/point_sets.h"
#include "umbrella/big_integer_internal.h"
#include "umbrella/circumradius_internal.h"
#include "umbrella/circumspheres.h"

namespace umbrella {
namespace {

using boost::multiprecision::cpp_int;
using tests::Family;
using tests::Rational;

const std::array<Point3, 3> kRightTriangle = {Point3(0, 0, 0), Point3(1, 0, 0),
                                              Point3(0, 1, 0)};

/// Families whose triangles are of ordinary size.
constexpr Family kOrdinary[] = {
    Family::Uniform, Family::Clustered, Family::Grid,      Family::Cospherical,
    Family::Rounded, Family::UlpGrid,   Family::NearlyFlat};

bool is_flat(const std::array<Point3, 4>& p) {
  return predicates::orient3d(p[0].data(), p[1].data(), p[2].data(),
                              p[3].data()) == 0;
}

/// Four points in general position of a family that has them.
std::array<Point3, 4> random_tetrahedron(Family family, std::uint64_t seed) {
  const auto points = tests::make_points<3>(family, 40, seed);
  std::mt19937_64 rng(seed);
  std::array<Point3, 4> corners;
  do {
    for (Point3& p : corners) p = points[rng() % points.size()];
  } while (is_flat(corners));
  return corners;
}

TEST(BigInteger, AgreesWithAnotherImplementation) {
  std::mt19937_64 rng(1);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::array<double, 4> x;
    for (double& value : x)
      value = std::ldexp(static_cast<double>(static_cast<std::int64_t>(rng())),
                         static_cast<int>(rng() % 100));
    const auto own = [&](int i) { return BigInteger(x[i], 0); };
    const auto other = [&](int i) { return cpp_int(x[i]); };
    // Denominators are squares plus one, so never zero.
    const BigInteger one(1, 0);
    const BigInteger a = own(0) * own(1) - own(2) * own(3);
    const cpp_int b = other(0) * other(1) - other(2) * other(3);
    const double ratio = nearest_quotient(a * a, own(2) * own(2) + one, 0);
    const cpp_int numerator = b * b, denominator = other(2) * other(2) + 1;
    EXPECT_TRUE(tests::is_nearest(ratio, Rational(numerator, denominator)));
    EXPECT_EQ((a + -a).is_zero(), true);
  }
}

TEST(BigInteger, RoundsTiesToEven) {
  const auto whole = [](double x) { return BigInteger(x, 0); };
  const BigInteger big = whole(0x1p53), one = whole(1), two = whole(2);
  EXPECT_EQ(nearest_quotient(big + one, one, 0), 0x1p53);
  EXPECT_EQ(nearest_quotient(big + two + one, one, 0), 0x1p53 + 4);
  EXPECT_EQ(nearest_quotient(big + big + one, two, 0), 0x1p53);
  EXPECT_EQ(nearest_quotient(big + big + big + one, whole(3), -53), 1);
  EXPECT_EQ(nearest_quotient(BigInteger(), two, 7), 0);
}

TEST(LambdaInterval, SquaresAreTheNearestDoubles) {
  for (const Family family : kOrdinary)
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
      SCOPED_TRACE(testing::Message() << name(family) << " trial " << trial);
      const auto abcd = random_tetrahedron(family, trial);
      const std::array<Point3, 3> abc = {abcd[0], abcd[1], abcd[2]};
      const Rational r2 = tests::squared_circle_radius(abc);
      const Rational R2 = tests::squared_sphere_radius(abcd);
      EXPECT_TRUE(
          tests::is_nearest(exact_squared_lambda(abcd), Rational(r2 / R2)));
      EXPECT_TRUE(tests::is_nearest(exact_squared_circumradius(abc, 1), r2));
      EXPECT_TRUE(tests::is_nearest(exact_squared_circumradius(abcd, 1), R2));
    }
}

TEST(LambdaInterval, DoesNotDependOnTheOrderOfCorners) {
  for (const Family family : kOrdinary)
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE(testing::Message() << name(family) << " trial " << trial);
      const auto abcd = random_tetrahedron(family, trial);
      std::array<int, 3> order = {0, 1, 2};
      const auto expected =
          lambda_interval({abcd[0], abcd[1], abcd[2]}, abcd[3], std::nullopt);
      do {
        const auto same =
            lambda_interval({abcd[order[0]], abcd[order[1]], abcd[order[2]]},
                            std::nullopt, abcd[3]);
        EXPECT_EQ(same.lower, expected.lower);
        EXPECT_EQ(same.upper, expected.upper);
      } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(LambdaInterval, IsInvariantUnderRotationAndScale) {
  std::mt19937_64 rng(20261121);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Point3 below(0.3, 0.2, -0.7), above(0.1, 0.4, 0.9);
  const auto expected = lambda_interval(kRightTriangle, below, above);

  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Eigen::Quaterniond q{unit(rng), unit(rng), unit(rng), unit(rng)};
    const Eigen::Matrix3d S =
        std::exp2(20 * unit(rng)) * q.normalized().toRotationMatrix();
    auto abc = kRightTriangle;
    for (Point3& p : abc) p = S * p;
    const auto moved =
        lambda_interval(abc, Point3(S * below), Point3(S * above));
    EXPECT_NEAR(moved.lower, expected.lower, 1e-12);
    EXPECT_NEAR(moved.upper, expected.upper, 1e-12);
  }
}

TEST(LambdaInterval, IsTheSameAtEveryPowerOfTwo) {
  const Point3 below(0.3, 0.2, -0.7), above(0.1, 0.4, 0.9);
  const auto expected = lambda_interval(kRightTriangle, below, above);
  for (int e = -960; e <= 1020; e += 20) {
    SCOPED_TRACE(testing::Message() << "2^" << e);
    const double s = std::ldexp(1, e);
    auto abc = kRightTriangle;
    for (Point3& p : abc) p *= s;
    const auto scaled =
        lambda_interval(abc, Point3(s * below), Point3(s * above));
    EXPECT_EQ(scaled.lower, expected.lower);
    EXPECT_EQ(scaled.upper, expected.upper);
  }
}

TEST(LambdaInterval, IsZeroBelowOnTheHull) {
  const Point3 above(0.1, 0.4, 0.9);
  EXPECT_EQ(lambda_interval(kRightTriangle, std::nullopt, above).lower, 0);
  EXPECT_EQ(lambda_interval(kRightTriangle, above, std::nullopt).lower, 0);
}

TEST(LambdaInterval, IsOneWhereTheCentreLiesInTheTriangle) {
  // The unit sphere about the middle of the longest side.
  const std::array<Point3, 3> abc = {Point3(-1, 0, 0), Point3(1, 0, 0),
                                     Point3(0, 1, 0)};
  const auto lambda = lambda_interval(abc, Point3(0, 0, -1), Point3(0, 0, 2));
  EXPECT_EQ(lambda.upper, 1);
  EXPECT_EQ(lambda.lower, 0.8);  // R = 1.25
  // Apex just inside the diametral ball: Gabriel no more.
  EXPECT_LT(lambda_interval(abc, Point3(0, 0, -0.999), Point3(0, 0, 2)).upper,
            1);
}

/// Whether a ball of radius r / lambda through the corners is empty.
bool has_empty_ball(const std::array<Point3, 3>& abc, double lambda,
                    std::span<const Point3> points) {
  const Point3 u = abc[1] - abc[0], v = abc[2] - abc[0], n = u.cross(v);
  const Point3 o =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) /
      (2 * n.squaredNorm());
  const double R = o.norm() / lambda;
  const double h = std::sqrt(std::max(0.0, R * R - o.squaredNorm()));
  const auto is_empty = [&](const Point3& center) {
    return std::none_of(points.begin(), points.end(), [&](const Point3& p) {
      return (p - center).norm() < R * (1 - 1e-9);
    });
  };
  const Point3 side = h * n.normalized();
  return is_empty(abc[0] + o + side) || is_empty(abc[0] + o - side);
}

TEST(LambdaIntervals, HoldTheEmptyBallsOfDefinition2Point1) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const delaunay::Triangulation3 t(
        tests::make_points<3>(Family::Uniform, 25, trial));
    for (const auto& [corners, lambda] : lambda_intervals(t)) {
      const std::array<Point3, 3> abc = {
          t.point(corners[0]), t.point(corners[1]), t.point(corners[2])};
      const double middle = (lambda.lower + lambda.upper) / 2;
      EXPECT_TRUE(has_empty_ball(abc, middle, t.points()));
      if (lambda.lower > 0.01) {
        EXPECT_FALSE(has_empty_ball(abc, lambda.lower * 0.999, t.points()));
      }
      if (lambda.upper < 0.999) {
        EXPECT_FALSE(has_empty_ball(abc, lambda.upper * 1.001, t.points()));
      }
    }
  }
}

/// Moved, mirrored along some axes, with the first three in another order.
std::array<Point3, 4> random_copy(std::array<Point3, 4> p,
                                  std::mt19937_64& rng) {
  std::shuffle(p.begin(), p.begin() + 3, rng);
  Point3 sign, offset;
  for (unsigned i = 0; i < 3; ++i) {
    sign[i] = rng() % 2 == 0 ? 1 : -1;
    offset[i] = static_cast<double>(rng() % 1000);
  }
  for (Point3& x : p) x = x.cwiseProduct(sign) + offset;
  return p;
}

Rational squared_lambda(const std::array<Point3, 4>& p) {
  return tests::squared_circle_radius({p[0], p[1], p[2]}) /
         tests::squared_sphere_radius(p);
}

void expect_order_of_rationals(const std::array<Point3, 4>& p,
                               const std::array<Point3, 4>& q, int& n_equal) {
  if (is_flat(p) || is_flat(q)) return;
  const int expected = squared_lambda(p).compare(squared_lambda(q));
  EXPECT_EQ(compare(squared_lambda_ratio(p), squared_lambda_ratio(q)),
            expected < 0 ? -1 : (expected > 0 ? 1 : 0));
  n_equal += expected == 0 ? 1 : 0;
}

// The apex of the copy is another point of the sphere, or one beside it.
TEST(ExactRatio, OrdersCopiesOfATriangleAsRationalsDo) {
  std::mt19937_64 rng(23);
  const auto on_sphere = [&rng] {
    std::array<double, 3> x = {9, 23, 41};
    std::shuffle(x.begin(), x.end(), rng);
    for (double& c : x) c = rng() % 2 == 0 ? c : -c;
    return Point3(x[0], x[1], x[2]);
  };
  int n_equal = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::array<Point3, 4> p;
    for (Point3& x : p) x = on_sphere();
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    std::array<Point3, 4> q = p;
    q[3] = on_sphere();
    if (trial % 4 == 0) q[3][trial % 3] += 2;
    expect_order_of_rationals(p, random_copy(q, rng), n_equal);
  }
  EXPECT_GT(n_equal, kTrials / 3);
}

// So flat that pairs of doubles do not tell the two apart.
TEST(ExactRatio, OrdersCopiesOfSliversAsRationalsDo) {
  std::mt19937_64 rng(29);
  const auto whole = [&rng] {
    return static_cast<double>(rng() % (std::uint64_t{1} << 40U));
  };
  int n_equal = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::array<Point3, 4> p;
    for (Point3& x : p) x = Point3{whole(), whole(), 0};
    p[3][2] = 1;
    std::array<Point3, 4> q = p;
    if (trial % 2 == 0) q[3][trial % 3] += trial % 3 == 2 ? -2 : 1;
    expect_order_of_rationals(p, random_copy(q, rng), n_equal);
  }
  EXPECT_GT(n_equal, 100);
}

TEST(Circumspheres, AnswerAsTheExactOnesDo) {
  for (const Family family : tests::kFamilies)
    for (std::uint64_t trial = 0; trial < 2; ++trial) {
      SCOPED_TRACE(testing::Message() << name(family) << " trial " << trial);
      const delaunay::Triangulation3 t(
          tests::make_points<3>(family, 25, trial));
      const Circumspheres spheres(t);
      for (std::size_t c = 0; c < t.n_finite_cells(); ++c) {
        const auto& v = t.cells()[c].vertex;
        const std::array<Point3, 4> p = {t.point(v[0]), t.point(v[1]),
                                         t.point(v[2]), t.point(v[3])};
        const delaunay::CellId id{static_cast<std::uint32_t>(c)};
        const double exact = exact_squared_circumradius(p, spheres.scale());
        EXPECT_LE(std::abs(spheres.squared_radius(id) - exact),
                  0x1p-35 * exact);
        for (unsigned i = 0; i < 4; ++i) {
          const auto& k = delaunay::kFacetCorners[i];
          EXPECT_EQ(
              spheres.apex_outside_diametral_ball({id, i}),
              predicates::gabriel_triangle(p[k[0]].data(), p[k[1]].data(),
                                           p[k[2]].data(), p[i].data()) >= 0);
        }
      }
    }
}

}  // namespace
}  // namespace umbrella
