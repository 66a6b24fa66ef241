/// @file
/// Which of the umbrellas at a vertex to choose: the filter's rule and others.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "umbrella/filter.h"
#include "umbrella/triangle.h"

namespace umbrella {

enum class UmbrellaChoice {
  First,     ///< whose worst triangle is best [Adamy02, Sec. 3]
  LeastSum,  ///< with the least sum of primary ranks
  /// With the least sum of 1 + cos of the dihedral angles at its edges: 0 where
  /// it is flat, 2 where two triangles are folded on each other.
  Flattest
};

/// "first", "least-sum", "flattest": in the order of the enumerators.
std::span<const std::string_view> umbrella_choice_names();

/// @throws std::invalid_argument  there is no such choice
UmbrellaChoice umbrella_choice(std::string_view name);

/// As umbrella_filter(), with the given choice at each vertex. Of umbrellas
/// that are equally good the one found first is taken, in the order of
/// `triangles`. The search is exact, but it ends after 20000 steps at a vertex
/// with the best umbrella so far, which is met by `Flattest` only, and only
/// where many triangles that are not Gabriel are admitted.
///
/// @param points  corners are positions in it
/// @param triangles  distinct; primary ranks not negative
FilterResult umbrella_filter(std::span<const Point3> points,
                             RankedTriangles triangles, UmbrellaChoice choice,
                             unsigned threads = 1);

}  // namespace umbrella
