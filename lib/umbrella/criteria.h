/// @file
/// Criteria besides the paper's, and all of them by name.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "umbrella/criterion.h"

namespace umbrella {

/// The paper's order on all Delaunay triangles: no Gabriel restriction.
struct LambdaCriterion {
  bool admissible(const DelaunayTriangle& /*t*/) const { return true; }
  Rank rank(const DelaunayTriangle& t) const { return paper.rank(t); }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return paper.exact_rank(t);
  }

  PaperCriterion paper;
};

/// Gabriel triangles, the smaller circumradius first: sizes, not shapes.
struct CircumradiusCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {rankable(t.squared_circumradius()), t.squared_lambda_lower()};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_circumradius_ratio(), t.squared_lambda_lower_ratio()};
  }
};

/// Gabriel triangles, the smaller area first; ordered as the doubles are.
struct AreaCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.squared_area(), t.squared_circumradius()};
  }
};

/// How far the circumballs of the two cells at a triangle overlap, by radii
/// R_1, R_2 and distance d of centres: (R_1 + R_2 - d) / min(R_1, R_2)
/// [Parakkat24]. In [0, 2]; 2 if one ball holds the other's centre line.
///
/// With s_i = sqrt(1 - lambda_i^2), so that the centre of cell i stands
/// r s_i / lambda_i over the triangle, it depends on the lambdas alone:
/// centres on both sides (Gabriel)
///   (l_1 / (1 + s_1) + l_2 / (1 + s_2)) max(l_1, l_2),
/// on one side, with l_1 >= l_2,
///   1 + s_1 + l_1 l_2 / (1 + s_2).
/// On the hull, lambda 0, it is the limit: a half-space for a ball.
///
/// @param squared_lambdas  of both cells, in [0, 1]
double intersection_ratio(const std::array<double, 2>& squared_lambdas,
                          bool is_gabriel);

/// All triangles, the smaller overlap of their cells' balls first.
struct BallMergeCriterion {
  bool admissible(const DelaunayTriangle& /*t*/) const { return true; }
  Rank rank(const DelaunayTriangle& t) const {
    return {intersection_ratio(t.squared_lambdas(), t.is_gabriel()),
            t.squared_circumradius()};
  }
};

/// Gabriel triangles, by lambda^p r^q: shapes and sizes weighed. Whole powers,
/// for a product rounds alike on every machine. Scaling the points does not
/// change the order.
struct MixedCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const;

  unsigned lambda_power = 1;
  unsigned radius_power = 1;
};

/// The criteria that can be asked for by name: "paper" first.
std::span<const std::string_view> criterion_names();

/// As ranked_triangles() with the criterion of that name.
///
/// @throws std::invalid_argument  there is no such criterion
RankedTriangles ranked_by(std::string_view criterion,
                          const delaunay::Triangulation3& triangulation,
                          const Circumspheres& spheres, unsigned threads = 1);

/// Throws as ranked_by() does.
void require_criterion(std::string_view name);

}  // namespace umbrella
