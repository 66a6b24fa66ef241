#include "umbrella/criterion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

#include "predicates/gabriel.h"
#include "tests/support/complexes.h"
#include "tests/support/exact_lambda.h"
#include "tests/support/point_sets.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using tests::Family;
using tests::Rational;

std::array<Point3, 3> points_of(const Triangulation3& t, const Triangle& abc) {
  return {t.point(abc[0]), t.point(abc[1]), t.point(abc[2])};
}

/// All Delaunay triangles, ascending.
std::vector<Triangle> all_triangles(const Triangulation3& t) {
  std::vector<Triangle> result;
  for (std::size_t c = 0; c < t.n_finite_cells(); ++c)
    for (const auto& k : delaunay::kFacetCorners) {
      const auto& v = t.cells()[c].vertex;
      Triangle corners = {v[k[0]], v[k[1]], v[k[2]]};
      std::sort(corners.begin(), corners.end());
      result.push_back(corners);
    }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool is_gabriel(const Triangulation3& t, const Triangle& corners) {
  const auto abc = points_of(t, corners);
  return std::all_of(
      t.points().begin(), t.points().end(), [&](const Point3& p) {
        return std::count(abc.begin(), abc.end(), p) > 0 ||
               predicates::gabriel_triangle(abc[0].data(), abc[1].data(),
                                            abc[2].data(), p.data()) >= 0;
      });
}

TEST(PaperCriterion, AdmitsTheTrianglesWhoseOpenDiametralBallIsEmpty) {
  for (const Family family : tests::kFamilies)
    for (std::uint64_t trial = 0; trial < 2; ++trial) {
      SCOPED_TRACE(testing::Message() << name(family) << " trial " << trial);
      const Triangulation3 t(tests::make_points<3>(family, 20, trial));
      std::vector<Triangle> expected = all_triangles(t);
      std::erase_if(expected,
                    [&](const Triangle& abc) { return !is_gabriel(t, abc); });
      std::vector<Triangle> admitted;
      for (const auto& ranked : ranked_triangles(t))
        admitted.push_back(ranked.corners);
      EXPECT_EQ(admitted, expected);
    }
}

/// Squared lower bound of the lambda-interval, and squared circumradius.
std::tuple<Rational, Rational> exact_rank(const Triangulation3& t,
                                          const RankedTriangle& triangle) {
  const auto [a, b, c] = points_of(t, triangle.corners);
  const Rational r2 = tests::squared_circle_radius({a, b, c});
  Rational lower = 1;
  const auto& cell = t.cell(triangle.facet.cell());
  for (const delaunay::Facet side :
       {triangle.facet, cell.neighbor[triangle.facet.index()]}) {
    const auto& beyond = t.cell(side.cell());
    if (beyond.is_infinite()) return {0, r2};
    const Rational R2 = tests::squared_sphere_radius(
        {a, b, c, t.point(beyond.vertex[side.index()])});
    lower = std::min<Rational>(lower, r2 / R2);
  }
  return {lower, r2};
}

void expect_exact_order(const Triangulation3& t) {
  const RankedTriangles ranked = ranked_triangles(t);
  const auto sorted = tests::in_order(ranked);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto before = exact_rank(t, sorted[i - 1]);
    const auto after = exact_rank(t, sorted[i]);
    EXPECT_LE(before, after);
    EXPECT_EQ(before == after,
              ranked.order().compare_ranks(sorted[i - 1], sorted[i]) == 0);
  }
}

TEST(PaperCriterion, OrdersAsExactNumbersDo) {
  for (const Family family :
       {Family::Uniform, Family::Grid, Family::Cospherical, Family::Rounded,
        Family::UlpGrid, Family::NearlyFlat}) {
    SCOPED_TRACE(name(family));
    const Triangulation3 t(tests::make_points<3>(family, 40, 5));
    ASSERT_GT(ranked_triangles(t).size(), 50U);
    expect_exact_order(t);
  }
}

// Multiples of 0.1 are no lattice once rounded: their lambdas differ by less
// than any double tells, and the circumradii often say the opposite.
TEST(PaperCriterion, OrdersDecimalsAsExactNumbersDo) {
  std::mt19937_64 rng(17);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::vector<Point3> points(30);
    for (Point3& p : points)
      for (double& x : p) x = 0.1 * static_cast<double>(1 + rng() % 8);
    expect_exact_order(Triangulation3(points));
  }
}

// Off the hull squared lambdas are no zeros, though no double is so small.
TEST(PaperCriterion, OrdersNumbersThatUnderflow) {
  std::mt19937_64 rng(23);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double height : {1e-150, 1e-162, 1e-170}) {
    SCOPED_TRACE(height);
    std::vector<Point3> points(40);
    for (Point3& p : points) p = {unit(rng), unit(rng), height * unit(rng)};
    expect_exact_order(Triangulation3(points));
  }
}

TEST(PaperCriterion, GivesEqualRanksToEqualNumbers) {
  const Triangulation3 t(tests::make_points<3>(Family::Grid, 60, 3));
  const RankedTriangles ranked = ranked_triangles(t);
  const auto sorted = tests::in_order(ranked);
  std::size_t n_equal = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (exact_rank(t, sorted[i - 1]) != exact_rank(t, sorted[i])) continue;
    ++n_equal;
    EXPECT_EQ(ranked.order().compare_ranks(sorted[i - 1], sorted[i]), 0);
  }
  EXPECT_GT(n_equal, 20U);
}

TEST(RankedTriangles, DoNotDependOnTheOrderOfThePoints) {
  std::mt19937_64 rng(9);
  for (const Family family : tests::kFamilies) {
    SCOPED_TRACE(name(family));
    auto points = tests::make_points<3>(family, 25, 1);
    const Triangulation3 before(points);
    std::shuffle(points.begin(), points.end(), rng);
    const Triangulation3 after(points);
    const auto expected = tests::in_order(ranked_triangles(before));
    const auto ranked = tests::in_order(ranked_triangles(after));
    ASSERT_EQ(ranked.size(), expected.size());
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      EXPECT_EQ(ranked[i].corners, expected[i].corners);
      EXPECT_EQ(ranked[i].rank, expected[i].rank);
    }
  }
}

struct SmallestFirst {
  bool admissible(const DelaunayTriangle& t) const { return !t.on_hull(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.area(), t.circumradius()};
  }
};

TEST(RankedTriangles, TakeAnExperimentersCriterion) {
  const Triangulation3 t(tests::make_points<3>(Family::Uniform, 40, 2));
  const auto ranked = ranked_triangles(t, SmallestFirst{});
  std::size_t n_hull = 0;
  for (const auto& cell : t.cells()) n_hull += cell.is_infinite() ? 1 : 0;
  EXPECT_EQ(ranked.size(), all_triangles(t).size() - n_hull);
  for (const auto& triangle : ranked) {
    const auto [a, b, c] = points_of(t, triangle.corners);
    const double sides = (a - b).norm() * (b - c).norm() * (c - a).norm();
    // 4 area r = product of the sides
    EXPECT_NEAR(4 * triangle.rank.primary * triangle.rank.secondary / sides, 1,
                1e-9);
  }
}

}  // namespace
}  // namespace umbrella
