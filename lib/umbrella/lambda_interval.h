/// @file
/// Lambda-intervals: how empty the balls through a triangle's corners are.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct LambdaInterval {
  double lower = 0;
  double upper = 0;
};

/// Range of lambda for which some ball of diameter diam(abc) / lambda through
/// a, b, c holds no sample point [Adamy02, Def. 2.1].
///
/// With R_i the circumradius of the cell on side i (infinite on the hull) and r
/// that of the triangle, lambda_i = r / R_i; lower = min(lambda_1, lambda_2);
/// upper = 1 if the triangle is Gabriel, else max(lambda_1, lambda_2).
///
/// @param abc    corners; any length unit, finite, not collinear (asserted)
/// @param below  apex of the cell on one side; none on the hull
/// @param above  apex of the cell on the other side; none on the hull
/// @return dimensionless, in [0, 1], each the double nearest to the exact
///   value or one next to it: slivers and needles included, at any scale,
///   whatever the order of the corners. Whether upper is 1 is decided by the
///   exact predicates::gabriel_triangle, never by these numbers
LambdaInterval lambda_interval(const std::array<Point3, 3>& abc,
                               const std::optional<Point3>& below,
                               const std::optional<Point3>& above);

struct TriangleLambda {
  Triangle corners;
  LambdaInterval lambda;
};

/// The intervals of all Delaunay triangles, by ascending corners; relative
/// error below 2^-35.
std::vector<TriangleLambda> lambda_intervals(
    const delaunay::Triangulation3& triangulation);

}  // namespace umbrella
