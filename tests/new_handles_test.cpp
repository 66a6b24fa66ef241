#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "umbrella/essential_loops_internal.h"
#include "umbrella/new_handles_internal.h"

namespace umbrella {
namespace {

/// A grid of k x l squares, each cut along a diagonal; closed the first way.
class Tube {
 public:
  Tube(std::uint32_t k, std::uint32_t l) : k_(k), l_(l) {}

  std::size_t n_vertices() const { return k_ * (l_ + 1); }
  VertexId at(std::uint32_t i, std::uint32_t j) const {
    return VertexId{j * k_ + i % k_};
  }
  /// The squares of some columns.
  std::vector<Triangle> columns(std::uint32_t begin, std::uint32_t end) const {
    return squares(0, k_, begin, end);
  }
  std::vector<Triangle> squares(std::uint32_t first, std::uint32_t last,
                                std::uint32_t begin, std::uint32_t end) const {
    std::vector<Triangle> result;
    for (std::uint32_t j = begin; j < end; ++j)
      for (std::uint32_t i = first; i < last; ++i)
        for (Triangle t : {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                           Triangle{at(i, j), at(i, j + 1), at(i + 1, j + 1)}})
          result.push_back(t);
    for (Triangle& t : result) std::sort(t.begin(), t.end());
    return result;
  }

 private:
  std::uint32_t k_, l_;
};

/// A disc on one end of the tube: all its edges lead to one vertex.
void add_cap(std::vector<Triangle>& triangles, const Tube& tube,
             std::uint32_t k, std::uint32_t column, VertexId tip) {
  for (std::uint32_t i = 0; i < k; ++i) {
    Triangle t = {tube.at(i, column), tube.at(i + 1, column), tip};
    std::sort(t.begin(), t.end());
    triangles.push_back(t);
  }
}

/// A tube of k x l squares whose ends are sewn together.
std::vector<Triangle> sewn(std::vector<Triangle> tube, std::uint32_t k,
                           std::uint32_t l) {
  for (Triangle& t : tube) {
    for (VertexId& v : t)
      v = VertexId{static_cast<std::uint32_t>(index(v)) % (k * l)};
    std::sort(t.begin(), t.end());
  }
  return tube;
}

/// Those of `all` that are not in `some`, then these as added ones.
WorkingSurface surface_of(std::size_t n_vertices, std::vector<Triangle> all,
                          std::vector<Triangle> some) {
  std::vector<RankedTriangle> given;
  for (const Triangle& t : all)
    if (std::find(some.begin(), some.end(), t) == some.end())
      given.push_back({t, {}, {}});
  WorkingSurface surface(n_vertices, given);
  for (const Triangle& t : some) surface.add({t, {}});
  return surface;
}

TEST(EssentialLoops, GoRoundATubeThatIsOpen) {
  const Tube tube(5, 8);
  EssentialLoops loops(tube.n_vertices(), tube.columns(0, 8));
  EXPECT_EQ(loops.n_generators(), 1U);
  EXPECT_TRUE(loops.has_loop(5));
  EXPECT_FALSE(loops.has_loop(4));
  EXPECT_EQ(loops.shortest(5).vertices.size(), 5U * 9);
}

TEST(EssentialLoops, AreNotThereOnDiscs) {
  const Tube tube(5, 8);
  EssentialLoops strip(tube.n_vertices(), tube.squares(0, 4, 0, 8));
  EXPECT_EQ(strip.n_generators(), 0U);
  EXPECT_FALSE(strip.has_loop(8));

  std::vector<Triangle> capped = tube.columns(0, 8);
  const auto n = static_cast<std::uint32_t>(tube.n_vertices());
  add_cap(capped, tube, 5, 0, VertexId{n});
  EssentialLoops cup(n + 1, capped);
  EXPECT_EQ(cup.n_generators(), 0U);
  EXPECT_FALSE(cup.has_loop(8));
}

TEST(EssentialLoops, GoRoundEachHoleOfADisc) {
  const Tube tube(9, 9);
  std::vector<Triangle> sieve = tube.squares(0, 8, 0, 9);
  for (const std::uint32_t hole : {1U, 4U, 6U})
    for (const Triangle& t : tube.squares(hole, hole + 1, 4, 5))
      std::erase(sieve, t);
  EssentialLoops loops(tube.n_vertices(), sieve);
  EXPECT_EQ(loops.n_generators(), 3U);
  EXPECT_TRUE(loops.has_loop(4));
  EXPECT_FALSE(loops.has_loop(3));
}

/// On a torus of 5 x 60 squares.
class NewHandle : public testing::Test {
 protected:
  static constexpr std::uint32_t kRound = 5, kAlong = 60;

  bool may_be_made_by(const std::vector<Triangle>& added) const {
    return may_have_new_handle(
        surface_of(kRound * kAlong,
                   sewn(tube_.columns(0, kAlong), kRound, kAlong),
                   sewn(added, kRound, kAlong)),
        kRound);
  }
  const Tube tube_{kRound, kAlong};
};

TEST_F(NewHandle, IsMadeByABridge) {
  EXPECT_TRUE(may_be_made_by(tube_.columns(7, 8)));
  EXPECT_TRUE(may_be_made_by(tube_.columns(0, kAlong)));
  EXPECT_TRUE(may_be_made_by(tube_.squares(0, 2, 0, kAlong)));
}

TEST_F(NewHandle, IsNotMadeByDiscs) {
  EXPECT_FALSE(may_be_made_by({}));
  EXPECT_FALSE(may_be_made_by(tube_.squares(0, 1, 7, 8)));
  EXPECT_FALSE(may_be_made_by(tube_.squares(0, 4, 7, 30)));
  // Two that share a vertex.
  std::vector<Triangle> two = tube_.squares(0, 1, 7, 8);
  for (const Triangle& t : tube_.squares(1, 2, 8, 9)) two.push_back(t);
  EXPECT_FALSE(may_be_made_by(two));
}

TEST_F(NewHandle, IsTooWideForALoopOfFewerEdges) {
  const auto torus = sewn(tube_.columns(0, kAlong), kRound, kAlong);
  const auto bridge = sewn(tube_.columns(7, 8), kRound, kAlong);
  const auto surface = surface_of(kRound * kAlong, torus, bridge);
  EXPECT_TRUE(may_have_new_handle(surface, kRound));
  EXPECT_FALSE(may_have_new_handle(surface, kRound - 1));
}

/// A long tube with two caps is a sphere. A band round it near one end bounds
/// there, as a wider look shows; one in the middle takes too wide a look.
TEST(NewHandleOnASphere, IsNotSeenWhereALoopBoundsNearby) {
  constexpr std::uint32_t kRound = 4, kAlong = 200;
  const Tube tube(kRound, kAlong);
  const auto n = static_cast<std::uint32_t>(tube.n_vertices());
  std::vector<Triangle> sphere = tube.columns(0, kAlong);
  add_cap(sphere, tube, kRound, 0, VertexId{n});
  add_cap(sphere, tube, kRound, kAlong, VertexId{n + 1});
  const auto may_have = [&](std::uint32_t column) {
    return may_have_new_handle(
        surface_of(n + 2, sphere, tube.columns(column, column + 1)), kRound);
  };
  EXPECT_FALSE(may_have(1));
  EXPECT_FALSE(may_have(6));
  EXPECT_TRUE(may_have(kAlong / 2));
}

}  // namespace
}  // namespace umbrella
