/// @file
/// The empty balls through the corners of a Delaunay facet, triangle or edge:
/// what every subcomplex in complexes.h asks about.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "umbrella/criterion.h"

namespace umbrella {

/// The centres of these balls are a segment of the facet's axis. Towards side 1
/// it reaches to the centre of cell 1, towards side 0 to that of cell 0.
///
/// @tparam Facet  answers as DelaunayTriangle does; what is not called exact
/// may
///   be off by half of kNearTie, relatively
template <class Facet>
class EmptyBalls {
 public:
  explicit EmptyBalls(const Facet& facet)
      : facet_(facet),
        own_side_(facet.centers_on_own_side()),
        beyond_hull_(facet.beyond_hull()) {}

  bool smallest_is_empty() const { return own_side_[0] && own_side_[1]; }

  /// Square of the radius of the smallest empty ball.
  double smallest_radius() const {
    if (smallest_is_empty()) return facet_.exact_squared_circumradius();
    const auto R2 = facet_.exact_squared_cell_radii();
    return std::min(R2[0], R2[1]);
  }

  /// For every lambda between these two some ball is empty.
  bool hold_lambdas(double squared_lower, double squared_upper) const {
    const auto towards = [&](unsigned s) {
      return ends_after(s, squared_lower) && ends_beyond(1 - s, squared_upper);
    };
    return towards(0) || towards(1);
  }

  /// Both balls of that lambda are empty.
  bool hold_both(double squared_lambda) const {
    return ends_after(0, squared_lambda) && ends_after(1, squared_lambda);
  }

  /// The balls c0 and c1 of gamma_graph() are empty.
  bool hold_gammas(double c0, double c1) const {
    const auto towards = [&](unsigned s) {
      return holds_gamma(s, c1) && holds_gamma(1 - s, -c0);
    };
    return towards(0) || towards(1);
  }

  /// Some ball of that radius is empty.
  bool hold_radius(double r2) const {
    const auto towards = [&](unsigned s) {
      return radius_ends_after(s, r2) && radius_ends_beyond(1 - s, r2);
    };
    const double smallest = facet_.squared_circumradius();
    return (is_near(smallest, r2) ? facet_.exact_squared_circumradius()
                                  : smallest) <= r2 &&
           (towards(0) || towards(1));
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static bool is_near(double value, double bound) {
    return bound < kInfinity && std::abs(value - bound) <= kNearTie * bound;
  }

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
  bool holds_gamma(unsigned s, double c) const {
    const double lambda = 1 - std::abs(c);
    return c >= 0 ? ends_after(s, lambda * lambda)
                  : ends_beyond(s, lambda * lambda);
  }
  bool radius_ends_after(unsigned s, double r2) const {
    if (r2 == kInfinity) return beyond_hull_[s];  // others may overflow
    return own_side_[s] && cell_radius(s, r2) >= r2;
  }
  bool radius_ends_beyond(unsigned s, double r2) const {
    return own_side_[s] || cell_radius(s, r2) <= r2;
  }

  /// Rounded once where the bound is close.
  double lambda(unsigned s, double bound) const {
    const double lambda2 = facet_.squared_lambdas()[s];
    return is_near(lambda2, bound) ? facet_.exact_squared_lambdas()[s]
                                   : lambda2;
  }
  double cell_radius(unsigned s, double bound) const {
    const double R2 = facet_.squared_cell_radii()[s];
    return is_near(R2, bound) ? facet_.exact_squared_cell_radii()[s] : R2;
  }

  const Facet& facet_;
  std::array<bool, 2> own_side_, beyond_hull_;
};

/// The least alpha whose square is no less.
inline double root_from_above(double alpha2) {
  const double root = std::sqrt(alpha2);
  return root * root < alpha2
             ? std::nextafter(root, std::numeric_limits<double>::infinity())
             : root;
}

}  // namespace umbrella
