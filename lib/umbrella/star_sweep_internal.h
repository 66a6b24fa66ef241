/// @file
/// The triangles at one vertex after another, in one sweep over all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/lazy_vector.h"
#include "umbrella/incidence_internal.h"
#include "umbrella/ranges.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct StarTriangle {
  std::uint32_t corner;  ///< 3 t + i: corner i of triangle t is the vertex
  LinkEdge edge;         ///< opposite the vertex, ascending

  TriangleIndex triangle() const { return corner / 3; }
};

/// What is at one vertex.
struct Star {
  static constexpr float kNoKey = std::numeric_limits<float>::quiet_NaN();
  static constexpr std::size_t kPadding = 16;

  VertexId vertex;
  std::span<const StarTriangle> triangles;
  /// Of each triangle: its primary rank, rounded. In memory kNoKey follows,
  /// kPadding times.
  std::span<const float> keys;
  /// XOR of the ends of all edges: 0 where they make cycles.
  std::uint32_t odd;
};

/// A triangle waits for its middle and its last corner once its first one has
/// come up. Where ids that are near mean points that are near, as they do in a
/// triangulation, few wait at a time: so triangles are read once, in order, and
/// what is looked at later is in the cache.
class StarSweep {
 public:
  /// @param order  of the triangles, by first corners; empty if they lie in
  ///   that order
  /// @param vertices  those that will come up
  StarSweep(std::span<const RankedTriangle> triangles,
            std::span<const TriangleIndex> order, IndexRange vertices);

  /// The star of the next vertex, its triangles in any order; valid until the
  /// next call.
  Star next();

  /// After the last vertex: false if the order is not what it should be. The
  /// stars have been wrong then.
  bool has_seen_all() const { return !has_lower_than(end_); }

 private:
  static constexpr std::uint32_t kNone =
      std::numeric_limits<std::uint32_t>::max();

  TriangleIndex triangle(std::size_t i) const {
    return order_.empty() ? static_cast<TriangleIndex>(i) : order_[i];
  }
  bool has_lower_than(std::size_t v) const {
    return next_ < triangles_.size() &&
           index(triangles_[triangle(next_)].corners[0]) < v;
  }
  void await(TriangleIndex t);
  void await_at(VertexId v, std::uint32_t link);
  void reserve(std::size_t n);

  std::span<const RankedTriangle> triangles_;
  std::span<const TriangleIndex> order_;
  std::size_t begin_, at_, end_;  // vertices
  std::size_t next_ = 0;          // in the order of triangles
  // Lists of those that wait for a vertex: 2 t for its middle corner, 2 t + 1
  // for its last.
  std::vector<std::uint32_t> first_link_;  // of a vertex, from begin_ on
  delaunay::UnsetVector<std::uint32_t> next_link_;
  // The star at hand and its keys, and room for more.
  std::size_t room_ = 0;
  std::vector<StarTriangle> star_;
  std::vector<float> keys_;
};

}  // namespace umbrella
