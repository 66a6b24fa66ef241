#include "umbrella/complexes.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "umbrella/criterion.h"
#include "umbrella/delaunay_triangle.h"
#include "umbrella/empty_balls_internal.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using Balls = EmptyBalls<DelaunayTriangle>;

/// The triangles for whose empty balls the predicate holds.
template <class Predicate>
std::vector<LocatedTriangle> triangles_where(
    const Triangulation3& triangulation, const Circumspheres& spheres,
    Predicate holds) {
  std::vector<LocatedTriangle> result;
  for (const delaunay::Facet facet : facets(triangulation)) {
    const DelaunayTriangle triangle(triangulation, spheres, facet);
    if (holds(Balls(triangle))) result.push_back({triangle.corners(), facet});
  }
  std::sort(result.begin(), result.end(), by_corners);
  return result;
}

}  // namespace

std::vector<LocatedTriangle> lambda_complex(const Triangulation3& triangulation,
                                            const Circumspheres& spheres,
                                            double lower, double upper) {
  assert(0 <= lower && lower <= upper && upper <= 1);
  return triangles_where(triangulation, spheres, [&](const Balls& balls) {
    return balls.hold_lambdas(lower * lower, upper * upper);
  });
}

std::vector<LocatedTriangle> gabriel_complex(
    const Triangulation3& triangulation, const Circumspheres& spheres) {
  return triangles_where(triangulation, spheres, [](const Balls& balls) {
    return balls.smallest_is_empty();
  });
}

std::vector<LocatedTriangle> beta_skeleton(const Triangulation3& triangulation,
                                           const Circumspheres& spheres,
                                           double beta) {
  assert(beta >= 1);
  return triangles_where(triangulation, spheres, [&](const Balls& balls) {
    return balls.hold_both(1 / (beta * beta));
  });
}

std::vector<LocatedTriangle> gamma_graph(const Triangulation3& triangulation,
                                         const Circumspheres& spheres,
                                         double c0, double c1) {
  assert(-1 <= c0 && c0 <= c1 && c1 <= 1);
  return triangles_where(triangulation, spheres, [&](const Balls& balls) {
    return balls.hold_gammas(c0, c1);
  });
}

std::vector<LocatedTriangle> alpha_shape(const Triangulation3& triangulation,
                                         const Circumspheres& spheres,
                                         double alpha) {
  assert(alpha >= 0);
  const double scaled = alpha * spheres.scale();
  return triangles_where(triangulation, spheres, [&](const Balls& balls) {
    return balls.hold_radius(scaled * scaled);
  });
}

std::optional<double> smallest_alpha(const Triangulation3& triangulation,
                                     const Circumspheres& spheres) {
  if (triangulation.dimension() < 3) return std::nullopt;
  std::vector<double> least(triangulation.points().size(),
                            std::numeric_limits<double>::infinity());
  for (const delaunay::Facet facet : facets(triangulation)) {
    const DelaunayTriangle triangle(triangulation, spheres, facet);
    const double r2 = Balls(triangle).smallest_radius();
    for (const VertexId v : triangle.corners())
      least[index(v)] = std::min(least[index(v)], r2);
  }
  return root_from_above(*std::max_element(least.begin(), least.end())) /
         spheres.scale();
}

}  // namespace umbrella
