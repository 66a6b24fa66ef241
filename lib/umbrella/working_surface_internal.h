/// @file
/// The triangles of the surface while holes are being closed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// A set of triangles that can tell those at a vertex; triangles keep their
/// index, and a removed one leaves it unused.
class WorkingSurface {
 public:
  WorkingSurface(std::size_t n_vertices,
                 std::span<const RankedTriangle> triangles)
      : head_(n_vertices, kEnd) {
    n_given_ = triangles.size();
    triangles_.reserve(triangles.size());
    is_there_.reserve(triangles.size());
    next_.reserve(3 * triangles.size());
    for (const RankedTriangle& t : triangles) add({t.corners, t.facet});
  }

  std::size_t n_vertices() const { return head_.size(); }
  /// Indices of triangles are below it.
  std::size_t n_indices() const { return triangles_.size(); }
  const Triangle& corners(TriangleIndex t) const {
    return triangles_[t].corners;
  }
  const LocatedTriangle& triangle(TriangleIndex t) const {
    return triangles_[t];
  }
  bool contains(TriangleIndex t) const { return is_there_[t] != 0; }

  void add(const LocatedTriangle& triangle) {
    const auto t = static_cast<TriangleIndex>(triangles_.size());
    triangles_.push_back(triangle);
    is_there_.push_back(1);
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t& head = head_[index(triangle.corners[i])];
      next_.push_back(head);
      head = 3 * t + i;
    }
  }
  void remove(TriangleIndex t) { is_there_[t] = 0; }

  /// Calls visit(TriangleIndex) for each triangle at v, in an order that
  /// depends on the calls made so far.
  template <class Visit>
  void for_each_at(VertexId v, Visit visit) const {
    for (std::uint32_t i = head_[index(v)]; i != kEnd; i = next_[i])
      if (contains(i / 3)) visit(TriangleIndex{i / 3});
  }

  /// Whether there is a triangle at v.
  bool is_used(VertexId v) const {
    std::uint32_t i = head_[index(v)];
    while (i != kEnd && !contains(i / 3)) i = next_[i];
    return i != kEnd;
  }

  /// Calls visit(TriangleIndex) for each triangle that was not given at first.
  template <class Visit>
  void for_each_added(Visit visit) const {
    for (std::size_t t = n_given_; t < n_indices(); ++t)
      if (is_there_[t] != 0) visit(static_cast<TriangleIndex>(t));
  }

  /// All triangles, by ascending corners. Those given are in that order most
  /// often, so only the others are sorted.
  std::vector<LocatedTriangle> sorted() const {
    const auto before = [](const LocatedTriangle& a, const LocatedTriangle& b) {
      return a.corners < b.corners;
    };
    std::vector<LocatedTriangle> added;
    for_each_added([&](TriangleIndex t) { added.push_back(triangles_[t]); });
    std::sort(added.begin(), added.end(), before);
    std::vector<LocatedTriangle> result;
    result.reserve(n_given_ + added.size());
    auto next = added.begin();
    for (std::size_t t = 0; t < n_given_; ++t) {
      if (is_there_[t] == 0) continue;
      while (next != added.end() && before(*next, triangles_[t]))
        result.push_back(*next++);
      result.push_back(triangles_[t]);
    }
    result.insert(result.end(), next, added.end());
    if (!std::is_sorted(result.begin(), result.end(), before))
      std::sort(result.begin(), result.end(), before);
    return result;
  }

 private:
  static constexpr std::uint32_t kEnd =
      std::numeric_limits<std::uint32_t>::max();

  std::size_t n_given_ = 0;
  std::vector<LocatedTriangle> triangles_;
  std::vector<std::uint8_t> is_there_;
  std::vector<std::uint32_t> head_;  // 3 t + i: corner i of triangle t
  std::vector<std::uint32_t> next_;  // of 3 t + i
};

}  // namespace umbrella
