/// @file
/// The triangles of the surface while holes are being closed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// A set of triangles that can tell those at a vertex; triangles keep their
/// index, and a removed one leaves it unused.
class WorkingSurface {
 public:
  explicit WorkingSurface(std::size_t n_vertices)
      : WorkingSurface(n_vertices, std::span<const LocatedTriangle>()) {}
  WorkingSurface(std::size_t n_vertices,
                 std::span<const RankedTriangle> triangles)
      : WorkingSurface(n_vertices, triangles.begin(), triangles.end()) {}
  WorkingSurface(std::size_t n_vertices,
                 std::span<const LocatedTriangle> triangles)
      : WorkingSurface(n_vertices, triangles.begin(), triangles.end()) {}

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
    next_.resize(next_.size() + 3);
    link(t);
  }
  void remove(TriangleIndex t) { is_there_[t] = 0; }
  /// @pre t was removed, and its triangle has not been added since
  void put_back(TriangleIndex t) { is_there_[t] = 1; }

  /// Puts triangles in the place of others.
  void replace(std::span<const TriangleIndex> old,
               std::span<const LocatedTriangle> triangles) {
    for (const TriangleIndex t : old) remove(t);
    for (const LocatedTriangle& t : triangles) add(t);
  }

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
    const auto given = triangles_.begin();
    const auto end = given + static_cast<std::ptrdiff_t>(n_given_);
    auto next = given;
    for (const LocatedTriangle& t : added) {
      const auto place = std::lower_bound(next, end, t, before);
      append_given(next - given, place - given, result);
      result.push_back(t);
      next = place;
    }
    append_given(next - given, end - given, result);
    if (!std::is_sorted(result.begin(), result.end(), before))
      std::sort(result.begin(), result.end(), before);
    return result;
  }

 private:
  template <class Iterator>
  WorkingSurface(std::size_t n_vertices, Iterator first, Iterator last)
      : n_given_(static_cast<std::size_t>(last - first)),
        triangles_(n_given_),
        is_there_(n_given_, 1),
        head_(n_vertices, kEnd),
        next_(3 * n_given_) {
    for (TriangleIndex t = 0; t < n_given_; ++t, ++first) {
      triangles_[t] = {first->corners, first->facet};
      link(t);
    }
  }

  /// At each of its corners.
  void link(TriangleIndex t) {
    for (std::uint32_t i = 0; i < 3; ++i)
      next_[3 * t + i] =
          std::exchange(head_[index(triangles_[t].corners[i])], 3 * t + i);
  }
  /// Those of triangles first to last - 1 that are still there.
  void append_given(std::ptrdiff_t first, std::ptrdiff_t last,
                    std::vector<LocatedTriangle>& out) const {
    while (first < last) {
      const auto end = std::find(is_there_.begin() + first,
                                 is_there_.begin() + last, std::uint8_t{0});
      const std::ptrdiff_t n = end - is_there_.begin();
      out.insert(out.end(), triangles_.begin() + first, triangles_.begin() + n);
      first = n + 1;
    }
  }

  static constexpr std::uint32_t kEnd =
      std::numeric_limits<std::uint32_t>::max();

  std::size_t n_given_ = 0;
  std::vector<LocatedTriangle> triangles_;
  std::vector<std::uint8_t> is_there_;
  std::vector<std::uint32_t> head_;  // 3 t + i: corner i of triangle t
  std::vector<std::uint32_t> next_;  // of 3 t + i
};

}  // namespace umbrella
