#include "umbrella/lambda_interval.h"

#include <algorithm>
#include <cmath>

#include "predicates/gabriel.h"
#include "umbrella/circumradius_internal.h"
#include "umbrella/circumspheres.h"
#include "umbrella/criterion.h"
#include "umbrella/delaunay_triangle.h"

namespace umbrella {
namespace {

double lambda_towards(const std::array<Point3, 3>& abc,
                      const std::optional<Point3>& apex) {
  if (!apex) return 0;
  return std::sqrt(exact_squared_lambda({abc[0], abc[1], abc[2], *apex}));
}

bool outside_diametral_ball(const std::array<Point3, 3>& abc,
                            const std::optional<Point3>& apex) {
  return !apex ||
         predicates::gabriel_triangle(abc[0].data(), abc[1].data(),
                                      abc[2].data(), apex->data()) >= 0;
}

}  // namespace

LambdaInterval lambda_interval(const std::array<Point3, 3>& abc,
                               const std::optional<Point3>& below,
                               const std::optional<Point3>& above) {
  const double l1 = lambda_towards(abc, below);
  const double l2 = lambda_towards(abc, above);
  const bool is_gabriel =
      outside_diametral_ball(abc, below) && outside_diametral_ball(abc, above);
  return {std::min(l1, l2), is_gabriel ? 1 : std::max(l1, l2)};
}

std::vector<TriangleLambda> lambda_intervals(
    const delaunay::Triangulation3& triangulation) {
  const Circumspheres spheres(triangulation);
  std::vector<TriangleLambda> intervals;
  for (const delaunay::Facet facet : facets(triangulation)) {
    const DelaunayTriangle t(triangulation, spheres, facet);
    intervals.push_back({t.corners(), t.lambda()});
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const TriangleLambda& a, const TriangleLambda& b) {
              return a.corners < b.corners;
            });
  return intervals;
}

}  // namespace umbrella
