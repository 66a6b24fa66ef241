#include "umbrella/complexes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "umbrella/criterion.h"
#include "umbrella/delaunay_triangle.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What DelaunayTriangle gives quickly is good to half of this.
bool is_near(double value, double bound) {
  return bound < kInfinity && std::abs(value - bound) <= kNearTie * bound;
}

/// The segment of centres of empty balls. Towards side 1 of the axis it reaches
/// to the centre of cell 1, towards side 0 to that of cell 0.
class EmptyBalls {
 public:
  explicit EmptyBalls(const DelaunayTriangle& triangle)
      : triangle_(triangle),
        own_side_(triangle.centers_on_own_side()),
        beyond_hull_(triangle.beyond_hull()) {}

  bool smallest_is_empty() const { return own_side_[0] && own_side_[1]; }

  /// Whether the ball with this lambda and its centre on side `s` lies before
  /// the end on side `s`: it is no larger than the ball of cell s.
  bool ends_after(unsigned s, double squared_lambda) const {
    if (squared_lambda == 1) return own_side_[s];
    if (squared_lambda == 0) return beyond_hull_[s];  // others may underflow
    return own_side_[s] && lambda(s, squared_lambda) <= squared_lambda;
  }

  /// Whether the ball with its centre on the other side lies before that end.
  bool ends_beyond(unsigned s, double squared_lambda) const {
    return own_side_[s] ||
           (squared_lambda < 1 && lambda(s, squared_lambda) >= squared_lambda);
  }

  /// As ends_after() and ends_beyond(), for a ball of that radius.
  bool radius_ends_after(unsigned s, double r2) const {
    if (r2 == kInfinity) return beyond_hull_[s];  // others may overflow
    return own_side_[s] && cell_radius(s, r2) >= r2;
  }
  bool radius_ends_beyond(unsigned s, double r2) const {
    return own_side_[s] || cell_radius(s, r2) <= r2;
  }

  /// Square of the radius of the smallest empty ball.
  double smallest_radius() const {
    if (smallest_is_empty()) return triangle_.exact_squared_circumradius();
    const auto R2 = triangle_.exact_squared_cell_radii();
    return std::min(R2[0], R2[1]);
  }

  bool radius_is_at_most(double bound) const {
    const double r2 = triangle_.squared_circumradius();
    return (is_near(r2, bound) ? triangle_.exact_squared_circumradius() : r2) <=
           bound;
  }

 private:
  /// Rounded once where the bound is close.
  double lambda(unsigned s, double bound) const {
    const double lambda2 = triangle_.squared_lambdas()[s];
    return is_near(lambda2, bound) ? triangle_.exact_squared_lambdas()[s]
                                   : lambda2;
  }
  double cell_radius(unsigned s, double bound) const {
    const double R2 = triangle_.squared_cell_radii()[s];
    return is_near(R2, bound) ? triangle_.exact_squared_cell_radii()[s] : R2;
  }

  const DelaunayTriangle& triangle_;
  std::array<bool, 2> own_side_, beyond_hull_;
};

/// The triangles for whose empty balls the predicate holds.
template <class Predicate>
std::vector<LocatedTriangle> triangles_where(
    const Triangulation3& triangulation, const Circumspheres& spheres,
    Predicate holds) {
  std::vector<LocatedTriangle> result;
  for (const delaunay::Facet facet : facets(triangulation)) {
    const DelaunayTriangle triangle(triangulation, spheres, facet);
    if (holds(EmptyBalls(triangle)))
      result.push_back({triangle.corners(), facet});
  }
  std::sort(result.begin(), result.end(),
            [](const LocatedTriangle& a, const LocatedTriangle& b) {
              return a.corners < b.corners;
            });
  return result;
}

double square(double x) { return x * x; }

/// A ball on side `s` for c >= 0, and on the other for c < 0.
bool holds_up_to(const EmptyBalls& balls, unsigned s, double c) {
  const double squared_lambda = square(1 - std::abs(c));
  return c >= 0 ? balls.ends_after(s, squared_lambda)
                : balls.ends_beyond(s, squared_lambda);
}

}  // namespace

std::vector<LocatedTriangle> lambda_complex(const Triangulation3& triangulation,
                                            const Circumspheres& spheres,
                                            double lower, double upper) {
  assert(0 <= lower && lower <= upper && upper <= 1);
  const double lower2 = square(lower), upper2 = square(upper);
  return triangles_where(triangulation, spheres, [&](const EmptyBalls& balls) {
    const auto towards = [&](unsigned s) {
      return balls.ends_after(s, lower2) && balls.ends_beyond(1 - s, upper2);
    };
    return towards(0) || towards(1);
  });
}

std::vector<LocatedTriangle> gabriel_complex(
    const Triangulation3& triangulation, const Circumspheres& spheres) {
  return triangles_where(triangulation, spheres, [](const EmptyBalls& balls) {
    return balls.smallest_is_empty();
  });
}

std::vector<LocatedTriangle> beta_skeleton(const Triangulation3& triangulation,
                                           const Circumspheres& spheres,
                                           double beta) {
  assert(beta >= 1);
  const double squared_lambda = 1 / square(beta);
  return triangles_where(triangulation, spheres, [&](const EmptyBalls& balls) {
    return balls.ends_after(0, squared_lambda) &&
           balls.ends_after(1, squared_lambda);
  });
}

std::vector<LocatedTriangle> gamma_graph(const Triangulation3& triangulation,
                                         const Circumspheres& spheres,
                                         double c0, double c1) {
  assert(-1 <= c0 && c0 <= c1 && c1 <= 1);
  return triangles_where(triangulation, spheres, [&](const EmptyBalls& balls) {
    const auto towards = [&](unsigned s) {
      return holds_up_to(balls, s, c1) && holds_up_to(balls, 1 - s, -c0);
    };
    return towards(0) || towards(1);
  });
}

std::vector<LocatedTriangle> alpha_shape(const Triangulation3& triangulation,
                                         const Circumspheres& spheres,
                                         double alpha) {
  assert(alpha >= 0);
  const double alpha2 = square(alpha * spheres.scale());
  return triangles_where(triangulation, spheres, [&](const EmptyBalls& balls) {
    const auto towards = [&](unsigned s) {
      return balls.radius_ends_after(s, alpha2) &&
             balls.radius_ends_beyond(1 - s, alpha2);
    };
    return balls.radius_is_at_most(alpha2) && (towards(0) || towards(1));
  });
}

std::optional<double> smallest_alpha(const Triangulation3& triangulation,
                                     const Circumspheres& spheres) {
  if (triangulation.dimension() < 3) return std::nullopt;
  std::vector<double> least(triangulation.points().size(), kInfinity);
  for (const delaunay::Facet facet : facets(triangulation)) {
    const DelaunayTriangle triangle(triangulation, spheres, facet);
    const double r2 = EmptyBalls(triangle).smallest_radius();
    for (const VertexId v : triangle.corners())
      least[index(v)] = std::min(least[index(v)], r2);
  }
  const double alpha2 = *std::max_element(least.begin(), least.end());
  double scaled = std::sqrt(alpha2);
  if (square(scaled) < alpha2) scaled = std::nextafter(scaled, kInfinity);
  return scaled / spheres.scale();
}

}  // namespace umbrella
