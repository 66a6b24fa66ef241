// Reconstruction from the faces of another surface, torn on purpose.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/cell_labels.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

using Faces = std::vector<IndexedTriangle>;

std::set<IndexedTriangle> as_set(const Faces& faces) {
  std::set<IndexedTriangle> result;
  for (IndexedTriangle t : faces) {
    std::sort(t.begin(), t.end());
    result.insert(t);
  }
  return result;
}

/// A surface, and damage done to it.
class Torn {
 public:
  Torn(const char* shape, std::size_t n, std::uint64_t seed)
      : rng_(seed), points_(shapes::sample(shape, n, {.seed = seed})) {
    whole_ = reconstruct(points_).triangles;
    faces_ = whole_;
  }

  const std::vector<Point3>& points() const { return points_; }
  const Faces& whole() const { return whole_; }
  const Faces& faces() const { return faces_; }

  void knock_out(std::size_t n) {
    std::shuffle(faces_.begin(), faces_.end(), rng_);
    faces_.resize(faces_.size() - n);
  }
  void uncover(std::size_t n) {  // points, of all their faces
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t v = row();
      std::erase_if(faces_, [v](const IndexedTriangle& t) {
        return t[0] == v || t[1] == v || t[2] == v;
      });
    }
  }
  void repeat(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const IndexedTriangle t = faces_[rng_() % faces_.size()];
      faces_.push_back({t[1], t[0], t[2]});
    }
  }
  void add_fins(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const IndexedTriangle t = faces_[rng_() % faces_.size()];
      faces_.push_back({t[0], t[1], row()});
    }
  }
  void add_degenerate(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t v = row();
      faces_.push_back({v, row(), v});
    }
  }

  Reconstruction repaired() const {
    ReconstructOptions options;
    options.faces = faces_;
    return reconstruct(points_, options);
  }

 private:
  std::uint32_t row() {
    return static_cast<std::uint32_t>(rng_() % points_.size());
  }

  std::mt19937_64 rng_;
  std::vector<Point3> points_;
  Faces whole_, faces_;
};

void expect_whole(const Reconstruction& result, std::int64_t genus) {
  EXPECT_TRUE(result.surface.closed && result.surface.manifold);
  EXPECT_TRUE(result.surface.outward);
  EXPECT_EQ(result.surface.genus, genus);
  EXPECT_EQ(result.surface.components, 1U);
  EXPECT_TRUE(result.surface.unused_vertices.empty());
}

TEST(Repair, GivesBackAWholeSurface) {
  const Torn torn("torus", 800, 1);
  const Reconstruction result = torn.repaired();
  EXPECT_EQ(as_set(result.triangles), as_set(torn.whole()));
  EXPECT_EQ(result.faces.kept, torn.whole().size());
  EXPECT_EQ(result.faces.not_delaunay, 0U);
}

TEST(Repair, MendsWhatIsTorn) {
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    Torn torn("torus", 800, trial);
    torn.knock_out(100);
    torn.uncover(5);
    torn.repeat(30);
    torn.add_fins(30);
    torn.add_degenerate(10);
    const Reconstruction result = torn.repaired();
    expect_whole(result, 1);
    const FaceCounts& counts = result.faces;
    EXPECT_EQ(counts.faces, torn.faces().size());
    EXPECT_EQ(counts.degenerate + counts.duplicates + counts.not_delaunay +
                  counts.kept,
              counts.faces);
    EXPECT_GE(counts.degenerate, 10U);
    EXPECT_GE(counts.duplicates, 30U);
    EXPECT_GT(counts.not_delaunay, 0U);
  }
}

TEST(Repair, KeepsNearlyAllFaces) {
  Torn torn("3holes", 1500, 3);
  torn.knock_out(150);
  const Reconstruction result = torn.repaired();
  expect_whole(result, 3);
  const auto given = as_set(torn.faces());
  const auto closed = as_set(result.triangles);
  const auto n_kept = std::count_if(
      given.begin(), given.end(),
      [&](const IndexedTriangle& t) { return closed.count(t) > 0; });
  EXPECT_GE(n_kept, static_cast<std::ptrdiff_t>(given.size() * 98 / 100));
}

// Whatever the filter would choose: surfaces carved out of the hull of a cloud.
TEST(Repair, GivesBackAnyClosedDelaunaySurface) {
  std::size_t n_compared = 0;
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const auto points = shapes::sample("uniform", 30, {.seed = trial});
    const delaunay::Triangulation3 t(points);
    std::vector<VertexId> open;
    for (std::uint32_t v = 0; v < t.points().size(); ++v)
      open.push_back(VertexId{v});
    const CellLabelResult carved = close_by_cell_labels(t, {}, open);
    if (!carved.left_out.empty()) continue;
    ++n_compared;
    Faces faces;
    for (const LocatedTriangle& triangle : carved.triangles) {
      IndexedTriangle& face = faces.emplace_back();
      for (unsigned i = 0; i < 3; ++i)
        face[i] =
            static_cast<std::uint32_t>(std::find(points.begin(), points.end(),
                                                 t.point(triangle.corners[i])) -
                                       points.begin());
    }
    ReconstructOptions options;
    options.faces = faces;
    EXPECT_EQ(as_set(reconstruct(points, options).triangles), as_set(faces));
  }
  EXPECT_GE(n_compared, 5U);
}

TEST(Repair, MergesEqualPoints) {
  Torn torn("sphere", 300, 2);
  std::vector<Point3> corners;
  Faces soup;
  for (const IndexedTriangle& t : torn.whole()) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (const std::uint32_t v : t) corners.push_back(torn.points()[v]);
    soup.push_back({n, n + 1, n + 2});
  }
  ReconstructOptions options;
  options.faces = soup;
  const Reconstruction result = reconstruct(corners, options);
  EXPECT_EQ(result.faces.kept, soup.size());
  EXPECT_EQ(result.triangles.size(), soup.size());
  EXPECT_TRUE(result.surface.closed && result.surface.manifold);
}

TEST(Repair, RefusesFacesBeyondThePoints) {
  const std::vector<Point3> points = shapes::sample("sphere", 50, {});
  const Faces faces = {{0, 1, 50}};
  ReconstructOptions options;
  options.faces = faces;
  EXPECT_THROW(reconstruct(points, options), std::invalid_argument);
}

}  // namespace
}  // namespace umbrella
