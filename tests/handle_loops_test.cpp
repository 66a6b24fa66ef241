#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "umbrella/handle_loops_internal.h"

namespace umbrella {
namespace {

constexpr std::uint32_t kSide = 24;  // squares of a torus each way
constexpr unsigned kMaxEdges = 5;

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

VertexId at(std::uint32_t i, std::uint32_t j) {
  return VertexId{i % kSide * kSide + j % kSide};
}

/// Of a square, one half.
Triangle lower(std::uint32_t i, std::uint32_t j) {
  return sorted({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
}
Triangle upper(std::uint32_t i, std::uint32_t j) {
  return sorted({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
}

/// A torus without short loops of its own, and handles on it: each leads from a
/// triangle to another one, which are gone then.
class Surface {
 public:
  Surface() : surface_(kSide * kSide, given()) {}

  const WorkingSurface& surface() const { return surface_; }

  /// Makes the handle between two triangles, or takes it away. @return their
  /// vertices
  std::vector<VertexId> toggle(const Triangle& a, const Triangle& b) {
    std::vector<Triangle> caps = {a, b}, tube;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned k = (i + 1) % 3;
      tube.push_back(sorted({a[i], a[k], b[k]}));
      tube.push_back(sorted({a[i], b[i], b[k]}));
    }
    if (!contains(a)) std::swap(caps, tube);
    for (const Triangle& t : caps) surface_.remove(find(t));
    for (const Triangle& t : tube) surface_.add({t, {}});
    std::vector<VertexId> vertices(a.begin(), a.end());
    vertices.insert(vertices.end(), b.begin(), b.end());
    return vertices;
  }

  HandleLoops::Loops all() const {
    return HandleLoops(kMaxEdges).all(surface_.n_vertices(), surface_.sorted());
  }

 private:
  static std::vector<RankedTriangle> given() {
    std::vector<RankedTriangle> result;
    for (std::uint32_t i = 0; i < kSide; ++i)
      for (std::uint32_t j = 0; j < kSide; ++j)
        for (const Triangle& t : {lower(i, j), upper(i, j)})
          result.push_back({t, {}, {}});
    return result;
  }
  TriangleIndex find(const Triangle& corners) const {
    auto found = static_cast<TriangleIndex>(surface_.n_indices());
    surface_.for_each_at(corners[0], [&](TriangleIndex t) {
      if (surface_.corners(t) == corners) found = t;
    });
    return found;
  }
  bool contains(const Triangle& corners) const {
    return find(corners) < surface_.n_indices();
  }

  WorkingSurface surface_;
};

/// Two triangles each.
std::vector<std::array<Triangle, 2>> places() {
  std::vector<std::array<Triangle, 2>> result;
  for (std::uint32_t i = 0; i < 6; ++i)
    for (const std::uint32_t j : {0U, 6U, 12U})
      result.push_back({lower(2 * i, j), upper(2 * i, j + 3)});
  for (std::uint32_t i = 0; i < 8; ++i)
    result.push_back({lower(3 * i, 18), lower(3 * i + 1, 21)});
  return result;
}

TEST(HandleLoops, AboutTheChangesAreThoseOfTheWholeSurface) {
  const auto handles = places();
  std::size_t n_loops = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 rng(seed);
    std::uniform_int_distribution<std::size_t> any(0, handles.size() - 1);
    Surface torus;
    HandleLoops search(kMaxEdges);
    EXPECT_TRUE(search.all(kSide * kSide, torus.surface().sorted()).empty());
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      std::vector<VertexId> changed;
      for (int n = step % 3; n >= 0; --n) {
        const auto& [a, b] = handles[any(rng)];
        const auto vertices = torus.toggle(a, b);
        changed.insert(changed.end(), vertices.begin(), vertices.end());
      }
      const HandleLoops::Loops expected = torus.all();
      ASSERT_EQ(search.about(torus.surface(), changed), expected);
      n_loops += expected.size();
    }
  }
  EXPECT_GT(n_loops, 1000U);
}

/// The tip of a finger is another piece beyond than the rest of the hand.
TEST(HandleLoops, DoNotGoRoundAFinger) {
  constexpr std::uint32_t kColumns = 30;
  const auto on = [](std::uint32_t i, std::uint32_t column) {
    return VertexId{3 * column + i % 3};
  };
  std::vector<RankedTriangle> finger;
  const auto add = [&](const Triangle& t) {
    finger.push_back({sorted(t), {}, {}});
  };
  for (std::uint32_t j = 0; j + 1 < kColumns; ++j)
    for (std::uint32_t i = 0; i < 3; ++i) {
      add({on(i, j), on(i + 1, j), on(i + 1, j + 1)});
      add({on(i, j), on(i, j + 1), on(i + 1, j + 1)});
    }
  for (const std::uint32_t j : {0U, kColumns - 1})
    add({on(0, j), on(1, j), on(2, j)});
  const WorkingSurface surface(3 * kColumns, finger);
  HandleLoops search(3);
  for (std::uint32_t j = 0; j < kColumns; ++j)
    EXPECT_TRUE(search.about(surface, std::array{on(0, j)}).empty());
}

TEST(HandleLoops, GoWithTheHandle) {
  Surface torus;
  HandleLoops search(kMaxEdges);
  const auto made = torus.toggle(lower(3, 3), lower(9, 9));
  EXPECT_FALSE(search.about(torus.surface(), made).empty());
  // Nothing has changed: they are looked for where they were.
  EXPECT_EQ(search.about(torus.surface(), {}), torus.all());
  const auto gone = torus.toggle(lower(3, 3), lower(9, 9));
  EXPECT_TRUE(search.about(torus.surface(), gone).empty());
}

/// However short the loops were that all() was asked for.
TEST(HandleLoops, OfMoreEdgesAreThoseOfTheWholeSurface) {
  constexpr unsigned kMore = 9;
  std::size_t n_longer = 0;
  Surface torus;
  for (const auto& [a, b] : places()) {
    torus.toggle(a, b);
    HandleLoops search(kMaxEdges), longer(kMore);
    const auto triangles = torus.surface().sorted();
    const HandleLoops::Loops all = search.all(kSide * kSide, triangles);
    const HandleLoops::Loops expected = longer.all(kSide * kSide, triangles);
    search.set_max_edges(kMore);
    EXPECT_EQ(search.about(torus.surface(), {}), expected);
    n_longer += expected.size() > all.size() ? 1 : 0;
    torus.toggle(a, b);
  }
  EXPECT_GT(n_longer, 0U);
}

/// About the places that have changed in all. Between two of the last ones
/// three edges lead round the other way.
TEST(HandleLoops, OfWhichNoSumBoundsGoRoundEachHandle) {
  Surface torus;
  HandleLoops search(kMaxEdges);
  search.all(kSide * kSide, torus.surface().sorted());
  std::vector<VertexId> changed;
  std::size_t n_handles = 0;
  for (const auto& [a, b] : places()) {
    if (n_handles > 18) break;
    SCOPED_TRACE(testing::Message() << n_handles << " handles");
    const auto found =
        search.independent(torus.surface(), changed, kMaxEdges, 2);
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [](const HandleLoops::Loops& loops) {
                              return loops.front().size() == 3;
                            }),
              n_handles);
    for (const HandleLoops::Loops& loops : found) {
      EXPECT_LE(loops.size(), 2U);
      for (const auto& loop : loops) EXPECT_LE(loop.size(), kMaxEdges);
    }
    const auto made = torus.toggle(a, b);
    changed.insert(changed.end(), made.begin(), made.end());
    ++n_handles;
  }
}

}  // namespace
}  // namespace umbrella
