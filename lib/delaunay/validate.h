/// @file
/// Says what breaks a triangulation. Shares no code with the constructions:
/// every geometric fact is asked anew of the exact predicates.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "delaunay/ids.h"
#include "delaunay/triangulation2.h"
#include "delaunay/triangulation3.h"

namespace delaunay {

/// What a triangulation claims, member by member; tests damage a copy.
template <class Point, class CellType>
struct Claim {
  int dimension = -1;
  std::span<const Point> points;
  std::span<const VertexId> vertex_of_row;
  std::span<const CellType> cells;
  std::size_t n_finite_cells = 0;
};
using Claim2 = Claim<Point2, Cell2>;
using Claim3 = Claim<Point3, Cell>;

/// Empty if the claim is the perturbed Delaunay triangulation of its points;
/// otherwise one sentence on the first thing found broken. Checks, in order:
///
/// 1. the points are distinct, each named by a row, and span `dimension`;
/// 2. vertices and neighbours are in range, finite cells first, kInfinite in
///    the last slot of every other cell and nowhere else;
/// 3. finite cells are positive, exactly;
/// 4. neighbours are mutual and share the facet they say, with opposite sense;
/// 5. across each facet between finite cells the far corner lies outside the
///    perturbed circumsphere, so that all such spheres are empty;
/// 6. the hull is convex at each of its ridges, and does not fold back where
///    it is flat;
/// 7. every point is a corner of a cell, and the Euler relation holds.
///
/// @return time O(n log n), memory O(n)
std::string first_violation(const Claim2& claim);
std::string first_violation(const Claim3& claim);
std::string first_violation(const Triangulation2& triangulation);
std::string first_violation(const Triangulation3& triangulation);

}  // namespace delaunay
