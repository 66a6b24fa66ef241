/// @file
/// The exact order of triangles whose ranks are rounded.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "umbrella/exact_ratio.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// Twice what a rank may be off by, relatively.
inline constexpr double kNearTie = 0x1p-32;

/// A number that is off by a small part of itself, as a rank holds it: what is
/// so small or large that a double may not be that good, or is 0, becomes
/// equal, and is then told apart exactly. For zeros that are exact see below.
inline double rankable(double x) {
  constexpr double kLeast = 0x1p-960, kMost = 0x1p+960;
  return std::clamp(x, kLeast, kMost);
}

/// Which of two triangles goes first. Doubles tell of nearly all; the others
/// are asked for their exact ranks when they are compared, so that ties cost
/// nothing where nobody looks at them. May be used by several threads.
class RankOrder {
 public:
  /// Ranks are exact.
  RankOrder() = default;

  /// Ranks are off by less than kNearTie / 2 or rankable(), are not negative,
  /// and a primary of zero is exact.
  ///
  /// @param exact  the rank before rounding of the triangle that is this facet
  explicit RankOrder(std::function<ExactRank(delaunay::Facet)> exact)
      : exact_(std::move(exact)) {}

  /// Whether only exact ranks tell which goes first.
  bool is_near_tie(const RankedTriangle& a, const RankedTriangle& b) const {
    return exact_ && is_near_tie(a.rank, b.rank);
  }

  /// Negative, zero or positive as the rank of a is less than, equal to or more
  /// than that of b.
  int compare_ranks(const RankedTriangle& a, const RankedTriangle& b) const;

  /// The total order: rank, then corners. As VertexIds depend on the set of
  /// points alone, so does this order.
  bool before(const RankedTriangle& a, const RankedTriangle& b) const {
    const int order = compare_ranks(a, b);
    return order != 0 ? order < 0 : a.corners < b.corners;
  }

  /// Puts items in the order of their triangles, each of which is asked once
  /// for its exact rank.
  ///
  /// @param triangle_of  the triangle of an item, which stays where it is
  template <class TriangleOf>
  void sort(std::span<std::uint32_t> items, TriangleOf triangle_of) const {
    static_assert(std::is_lvalue_reference_v<decltype(triangle_of(0))>);
    std::vector<Keyed> keyed;
    for (const std::uint32_t item : items)
      keyed.push_back(with_key(triangle_of(item), item));
    sort(keyed);
    std::transform(keyed.begin(), keyed.end(), items.begin(),
                   [](const Keyed& k) { return k.item; });
  }

 private:
  struct Keyed {
    const RankedTriangle* triangle;
    ExactRank exact;  // what is found out about it stays with it
    std::uint32_t item;
  };

  Keyed with_key(const RankedTriangle& triangle, std::uint32_t item) const;
  void sort(std::vector<Keyed>& keyed) const;
  static bool is_near(double x, double y);
  static bool is_near_tie(const Rank& a, const Rank& b);

  std::function<ExactRank(delaunay::Facet)> exact_;  // none: ranks are
};

/// Distinct triangles, and what goes first among them.
class RankedTriangles {
 public:
  RankedTriangles() = default;
  explicit RankedTriangles(std::vector<RankedTriangle> triangles,
                           RankOrder order = {})
      : triangles_(std::move(triangles)), order_(std::move(order)) {}

  const RankOrder& order() const { return order_; }

  const RankedTriangle& operator[](std::size_t i) const {
    return triangles_[i];
  }
  std::size_t size() const { return triangles_.size(); }
  bool empty() const { return triangles_.empty(); }
  /// Without their order.
  std::vector<RankedTriangle> list() && { return std::move(triangles_); }
  auto begin() const { return triangles_.begin(); }
  auto end() const { return triangles_.end(); }

 private:
  std::vector<RankedTriangle> triangles_;
  RankOrder order_;
};

}  // namespace umbrella
