#include "delaunay/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "predicates/predicates.h"
#include "tests/support/point_sets.h"

namespace delaunay {
namespace {

using testing::HasSubstr;
using tests::Family;

/// A triangulation laid open, to be damaged.
template <class Point, class CellType>
struct Parts {
  static constexpr std::size_t kCorners = Point::RowsAtCompileTime + 1;
  using Corners = std::array<VertexId, kCorners>;

  int dimension = Point::RowsAtCompileTime;
  std::vector<Point> points;
  std::vector<VertexId> vertex_of_row;
  std::vector<CellType> cells;
  std::size_t n_finite_cells = 0;

  std::string violation() const {
    return first_violation(Claim<Point, CellType>{
        dimension, points, vertex_of_row, cells, n_finite_cells});
  }
};
using Parts2 = Parts<Point2, Cell2>;
using Parts3 = Parts<Point3, Cell>;

template <class AnyParts>
AnyParts parts_of(const auto& t) {
  return {t.dimension(),
          {t.points().begin(), t.points().end()},
          {t.vertex_of_row().begin(), t.vertex_of_row().end()},
          {t.cells().begin(), t.cells().end()},
          t.n_finite_cells()};
}

// The facet of a finite cell, as corners of the infinite cell beyond it.
Parts2::Corners beyond(const Parts2::Corners& v, unsigned i) {
  const auto& k = kSideCorners[i];
  return {v[k[1]], v[k[0]], kInfinite};
}
Parts3::Corners beyond(const Parts3::Corners& v, unsigned i) {
  const auto& k = kFacetCorners[i];
  return {v[k[0]], v[k[1]], v[k[2]], kInfinite};
}

/// Closes finite cells with infinite ones and links them all, whether or not
/// they are a Delaunay triangulation, or a triangulation at all.
template <class AnyParts>
AnyParts linked(
    decltype(AnyParts::points) points,
    const std::vector<std::array<unsigned, AnyParts::kCorners>>& finite_cells) {
  AnyParts parts;
  parts.points = std::move(points);
  for (unsigned v = 0; v < parts.points.size(); ++v)
    parts.vertex_of_row.push_back(VertexId{v});
  for (const auto& corners : finite_cells) {
    auto& cell = parts.cells.emplace_back();
    std::ranges::transform(corners, cell.vertex.begin(),
                           [](unsigned v) { return VertexId{v}; });
  }
  parts.n_finite_cells = parts.cells.size();

  using Handle = typename decltype(parts.cells[0].neighbor)::value_type;
  std::map<std::vector<VertexId>, Handle> open;
  const auto match = [&](std::size_t c) {
    for (unsigned i = 0; i < AnyParts::kCorners; ++i) {
      const auto& v = parts.cells[c].vertex;
      std::vector<VertexId> facet(v.begin(), v.end());
      facet.erase(facet.begin() + i);
      std::ranges::sort(facet);
      const Handle here(CellId{static_cast<std::uint32_t>(c)}, i);
      const auto [mate, is_new] = open.try_emplace(facet, here);
      if (is_new) continue;
      const Handle there = mate->second;
      parts.cells[c].neighbor[i] = there;
      parts.cells[index(there.cell())].neighbor[there.index()] = here;
      open.erase(mate);
    }
  };
  for (std::size_t c = 0; c < parts.n_finite_cells; ++c) match(c);
  const auto hull = open;
  for (const auto& [facet, inner] : hull) {
    const auto v = parts.cells[index(inner.cell())].vertex;
    parts.cells.emplace_back().vertex = beyond(v, inner.index());
    match(parts.cells.size() - 1);
  }
  return parts;
}

const std::vector<Point2> kSquare = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Validate, AcceptsOneOfTheTwoTriangulationsOfASquare) {
  const auto one = linked<Parts2>(kSquare, {{0, 1, 2}, {0, 2, 3}});
  const auto other = linked<Parts2>(kSquare, {{0, 1, 3}, {1, 2, 3}});
  EXPECT_NE(one.violation().empty(), other.violation().empty());
  EXPECT_THAT(one.violation() + other.violation(),
              HasSubstr("is not locally Delaunay"));
}

TEST(Validate, AcceptsOneOfTheTwoTriangulationsOfABipyramid) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> height(0.1, 3);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    // Trial 0 has all five on the unit sphere.
    const double low = trial == 0 ? 1 : height(rng);
    const double high = trial == 0 ? 1 : height(rng);
    const std::vector<Point3> points = {
        {1, 0, 0}, {-0.6, 0.8, 0}, {-0.6, -0.8, 0}, {0, 0, high}, {0, 0, -low}};
    const auto two = linked<Parts3>(points, {{0, 1, 2, 3}, {0, 2, 1, 4}});
    const auto three =
        linked<Parts3>(points, {{0, 1, 4, 3}, {1, 2, 4, 3}, {2, 0, 4, 3}});
    EXPECT_NE(two.violation().empty(), three.violation().empty())
        << two.violation() << "; " << three.violation();
  }
}

// A slit from the hull's corner 1 towards corner 0: the hull runs 0 -> 1 -> 2
// along a line and back. Every other check is content with it.
const std::vector<Point2> kSlit = {{0, 0},  {4, 0}, {2, 0},
                                   {2, -3}, {8, 0}, {2, 3}};
const std::vector<std::array<unsigned, 3>> kSlitCells = {
    {0, 1, 5}, {1, 4, 5}, {1, 3, 4}, {1, 2, 3}};

TEST(Validate, RejectsAHullThatFoldsBack) {
  EXPECT_THAT(linked<Parts2>(kSlit, kSlitCells).violation(),
              HasSubstr("folds back"));
  std::vector<Point3> points;
  for (const Point2& p : kSlit) points.emplace_back(p.x(), p.y(), 0);
  points.emplace_back(3, 0, 5);
  std::vector<std::array<unsigned, 4>> cone;
  for (const auto& [a, b, c] : kSlitCells) cone.push_back({a, b, c, 6});
  EXPECT_THAT(linked<Parts3>(points, cone).violation(),
              HasSubstr("folds back"));
}

TEST(Validate, RejectsAHullWithADent) {
  const std::vector<Point2> points = {{0, 0}, {4, 0}, {2, 4}, {2, 1}};
  EXPECT_EQ(
      linked<Parts2>(points, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}).violation(),
      "");
  EXPECT_THAT(linked<Parts2>(points, {{1, 2, 3}, {2, 0, 3}}).violation(),
              HasSubstr("not convex"));
}

TEST(Validate, RejectsTwoTriangulationsOverEachOther) {
  const std::vector<Point2> points = {{0, 0}, {3, 0}, {0, 3},
                                      {1, 1}, {4, 1}, {1, 4}};
  EXPECT_THAT(linked<Parts2>(points, {{0, 1, 2}, {3, 4, 5}}).violation(),
              HasSubstr("Euler"));
}

TEST(Validate, RejectsAHiddenVertex) {
  auto points = kSquare;
  points.emplace_back(0.3, 0.4);
  const auto one = linked<Parts2>(points, {{0, 1, 2}, {0, 2, 3}});
  const auto other = linked<Parts2>(points, {{0, 1, 3}, {1, 2, 3}});
  EXPECT_THAT(one.violation() + other.violation(),
              HasSubstr("no cell uses vertex 4"));
}

TEST(Validate, RejectsWrongBookkeeping) {
  auto good = linked<Parts2>(kSquare, {{0, 1, 2}, {0, 2, 3}});
  if (!good.violation().empty())
    good = linked<Parts2>(kSquare, {{0, 1, 3}, {1, 2, 3}});
  ASSERT_EQ(good.violation(), "");

  auto bad = good;
  bad.vertex_of_row.pop_back();
  EXPECT_EQ(bad.violation(), "no row names vertex 3");
  bad = good;
  bad.vertex_of_row.push_back(VertexId{4});
  EXPECT_EQ(bad.violation(), "a row names vertex 4 of 4");
  bad = good;
  bad.points[3] = bad.points[0];
  EXPECT_EQ(bad.violation(), "two vertices have the same coordinates");
  bad = good;
  bad.dimension = 1;
  EXPECT_EQ(bad.violation(), "dimension is 1, the points span 2");
  bad = good;
  bad.points = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  bad.dimension = 1;
  EXPECT_EQ(bad.violation(), "a flat set of points has cells");
  bad = good;
  bad.n_finite_cells = 1;
  EXPECT_EQ(bad.violation(), "cell 1 should be infinite");
  bad = good;
  bad.n_finite_cells = 7;
  EXPECT_EQ(bad.violation(), "more finite cells than cells");
}

/// Both dimensions, on triangulations the library makes.
template <class T>
struct Damage : testing::Test {};
struct Plane {
  static constexpr int kDim = 2;
  using Triangulation = Triangulation2;
  using AnyParts = Parts2;
};
struct Space {
  static constexpr int kDim = 3;
  using Triangulation = Triangulation3;
  using AnyParts = Parts3;
};
using Dimensions = testing::Types<Plane, Space>;
TYPED_TEST_SUITE(Damage, Dimensions);

TYPED_TEST(Damage, IsFoundWhereverItIs) {
  using AnyParts = typename TypeParam::AnyParts;
  const typename TypeParam::Triangulation t(
      tests::make_points<TypeParam::kDim>(Family::Uniform, 60, 7));
  const auto good = parts_of<AnyParts>(t);
  ASSERT_EQ(good.violation(), "");

  std::mt19937_64 rng(8);
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    auto bad = good;
    const std::size_t c = rng() % bad.cells.size();
    auto& cell = bad.cells[c];
    const auto i = static_cast<unsigned>(rng() % TypeParam::kDim);
    std::swap(cell.vertex[i], cell.vertex[(i + 1) % TypeParam::kDim]);
    EXPECT_NE(bad.violation(), "") << "swapped corners of cell " << c;

    bad = good;
    std::swap(bad.cells[c].neighbor[i], bad.cells[c].neighbor[i + 1]);
    EXPECT_NE(bad.violation(), "") << "swapped neighbours of cell " << c;

    bad = good;
    auto& corner = bad.cells[c].vertex[i];
    corner = VertexId{
        static_cast<std::uint32_t>((index(corner) + 1) % bad.points.size())};
    EXPECT_NE(bad.violation(), "") << "another corner for cell " << c;

    bad = good;
    const std::size_t v = rng() % bad.points.size();
    bad.points[v] = bad.points[(v + 1) % bad.points.size()] * 1.0001;
    EXPECT_NE(bad.violation(), "") << "moved vertex " << v;

    bad = good;
    std::swap(bad.cells[c], bad.cells[(c + 1) % bad.cells.size()]);
    EXPECT_NE(bad.violation(), "") << "swapped cell " << c << " and the next";
  }
}

TYPED_TEST(Damage, BeyondTheArraysIsFoundBeforeItIsUsed) {
  using AnyParts = typename TypeParam::AnyParts;
  const typename TypeParam::Triangulation t(
      tests::make_points<TypeParam::kDim>(Family::Uniform, 20, 9));
  const auto good = parts_of<AnyParts>(t);
  using Handle = typename decltype(good.cells[0].neighbor)::value_type;
  auto bad = good;
  bad.cells[0].vertex[1] = VertexId{20};
  EXPECT_EQ(bad.violation(), "cell 0 has a corner out of range");
  bad = good;
  bad.cells.back().vertex[0] = kInfinite;
  EXPECT_THAT(bad.violation(), HasSubstr("has a corner out of range"));
  bad = good;
  bad.cells[1].neighbor[0] =
      Handle(CellId{static_cast<std::uint32_t>(good.cells.size())}, 0);
  EXPECT_EQ(bad.violation(), "cell 1 has a neighbour out of range");
}

}  // namespace
}  // namespace delaunay
