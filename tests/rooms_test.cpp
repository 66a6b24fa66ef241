#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/given_faces.h"
#include "umbrella/parity_sets_internal.h"
#include "umbrella/reconstruct.h"
#include "umbrella/rooms_internal.h"

namespace umbrella {
namespace {

template <class Predicate>
std::ptrdiff_t n_corners(const LocatedTriangle& t, Predicate predicate) {
  return std::count_if(t.corners.begin(), t.corners.end(), predicate);
}

/// A closed surface, and a region of it about the point of a row.
class Setting {
 public:
  explicit Setting(std::uint64_t seed)
      : Setting(shapes::sample("torus", 300, {.seed = seed, .noise = 0.5})) {}

  /// Vertices at most so many Delaunay edges from that of the row.
  std::vector<VertexId> ball(std::size_t row, int n_edges) {
    std::vector<VertexId> result = {triangulation_.vertex_of_row()[row]};
    for (int i = 0; i < n_edges; ++i) result = neighborhoods_.ring(result);
    return result;
  }

  /// Puts the program's vertices, and what is open, in place of those before.
  void choose(const std::vector<VertexId>& vertices,
              const std::vector<VertexId>& open) {
    vertices_ = vertices;
    is_open_.assign(triangulation_.points().size(), false);
    for (const VertexId v : open) is_open_[index(v)] = true;
    candidates_ = neighborhoods_.candidates({vertices, {}, 3});
    fixed_.clear();
    n_unknown_ = 0;
    for (const LocatedTriangle& t : surface_) {
      const auto n_inside =
          n_corners(t, [&](VertexId v) { return is_in_program(v); });
      if (n_inside == 0 || n_inside == 3) continue;  // far away; a candidate
      const bool is_all_open =
          n_corners(t, [&](VertexId v) { return is_open_[index(v)]; }) == 3;
      n_unknown_ += is_all_open ? 1 : 0;
      if (!is_all_open) fixed_.push_back(t);
    }
  }

  /// Leaves those candidates alone that are on the surface.
  void know_all_others() {
    std::erase_if(candidates_, [this](const LocatedTriangle& t) {
      return !is_on_surface(t);
    });
  }

  std::vector<ilp::Wall> walls() const {
    return walls_between_rooms(neighborhoods_.cells(),
                               {candidates_, fixed_, vertices_, is_open_});
  }
  /// The value that the surface gives to a wall's variable.
  bool value(const ilp::Wall& wall) const {
    return is_on_surface(candidates_[index(wall.var)]);
  }
  std::size_t n_candidates() const { return candidates_.size(); }
  std::size_t n_unknown() const { return n_unknown_; }

 private:
  explicit Setting(const std::vector<Point3>& points)
      : triangulation_(points),
        working_(triangulation_.points().size()),
        neighborhoods_(triangulation_, working_) {
    const auto faces = reconstruct(points).triangles;
    for (const RankedTriangle& t :
         locate_faces(triangulation_, Circumspheres(triangulation_), faces)
             .triangles) {
      surface_.push_back({t.corners, t.facet});
      on_surface_.insert(t.corners);
    }
  }

  bool is_in_program(VertexId v) const {
    return std::binary_search(vertices_.begin(), vertices_.end(), v);
  }
  bool is_on_surface(const LocatedTriangle& t) const {
    return on_surface_.count(t.corners) > 0;
  }

  delaunay::Triangulation3 triangulation_;
  WorkingSurface working_;  // without triangles
  Neighborhoods neighborhoods_;
  std::vector<LocatedTriangle> surface_;
  std::set<Triangle> on_surface_;
  std::vector<VertexId> vertices_;
  std::vector<bool> is_open_;
  std::vector<LocatedTriangle> candidates_, fixed_;
  std::size_t n_unknown_ = 0;
};

std::size_t n_rooms(const std::vector<ilp::Wall>& walls) {
  std::size_t n = 0;
  for (const ilp::Wall& wall : walls)
    n = std::max<std::size_t>(n, std::max(wall.a, wall.b) + 1);
  return n;
}

/// Whether each room can be put inside or outside of the surface.
bool agree(const Setting& setting, const std::vector<ilp::Wall>& walls) {
  ParitySets sides(n_rooms(walls));
  return std::all_of(walls.begin(), walls.end(), [&](const ilp::Wall& wall) {
    return sides.relate(wall.a, wall.b,
                        setting.value(wall) != wall.inverted ? 1 : 0);
  });
}

/// Triangles with open corners only may come with another region.
TEST(Rooms, AreEachOnOneSideOfTheSurface) {
  std::size_t n_unknown = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Setting setting(seed);
    for (std::size_t row = 0; row < 20; ++row) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", row " << row);
      const std::vector<VertexId> region = setting.ball(row, 1);
      setting.choose(region, united(region, setting.ball(row + 20, 2)));
      const std::vector<ilp::Wall> walls = setting.walls();
      EXPECT_EQ(walls.size(), setting.n_candidates());
      EXPECT_TRUE(agree(setting, walls));
      n_unknown += setting.n_unknown();
    }
  }
  EXPECT_GT(n_unknown, 0U);
}

TEST(Rooms, AreTwoWhereTheOtherTrianglesAreKnown) {
  std::size_t n_settled = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Setting setting(seed);
    for (std::size_t row = 0; row < 20; ++row) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", row " << row);
      setting.choose(setting.ball(row, 1), {});
      const std::size_t n_before = n_rooms(setting.walls());
      setting.know_all_others();
      const std::vector<ilp::Wall> walls = setting.walls();
      EXPECT_TRUE(agree(setting, walls));
      EXPECT_LT(n_rooms(walls), n_before);
      n_settled += n_rooms(walls) <= 2 ? 1 : 0;
    }
  }
  EXPECT_EQ(n_settled, 100U);
}

}  // namespace
}  // namespace umbrella
