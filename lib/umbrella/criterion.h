/// @file
/// What makes a triangle fit for an umbrella, and which of two is better.
///
/// A criterion is any type with these two members:
///
///   struct ShortestFirst {
///     bool admissible(const DelaunayTriangle&) const { return true; }
///     Rank rank(const DelaunayTriangle& t) const {
///       return {t.circumradius(), t.area()};
///     }
///   };
///   const auto ranked = ranked_triangles(triangulation, ShortestFirst{});
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/circumspheres.h"
#include "umbrella/delaunay_triangle.h"
#include "umbrella/exact_ratio.h"
#include "umbrella/facets.h"
#include "umbrella/triangle.h"

namespace umbrella {

template <class C>
concept Criterion = requires(const C& c, const DelaunayTriangle& t) {
  { c.admissible(t) } -> std::convertible_to<bool>;
  { c.rank(t) } -> std::convertible_to<Rank>;
};

/// A criterion whose rank() is good to a part of kNearTie only, and which can
/// say it exactly. Triangles whose ranks differ by less are asked for
/// nearest_rank(), rounded once, and where that is the same for
/// exact_rank(): so the order is the one of exact_rank(). Ranks must not be
/// negative, and a primary of zero must be exact.
template <class C>
concept ExactCriterion = Criterion<C> &&
    requires(const C& c, const DelaunayTriangle& t) {
  { c.nearest_rank(t) } -> std::convertible_to<Rank>;
  { c.exact_rank(t) } -> std::convertible_to<ExactRank>;
};

/// Twice what rank() of an ExactCriterion may be off by, relatively.
inline constexpr double kNearTie = 0x1p-28;

/// The paper's: Gabriel triangles, by the lower bound of the lambda-interval.
/// All hull triangles tie at 0 there; the smaller circumradius then goes
/// first. Both are squared.
struct PaperCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.squared_lambda_lower(), t.squared_circumradius()};
  }
  Rank nearest_rank(const DelaunayTriangle& t) const {
    return {t.exact_squared_lambda_lower(), t.exact_squared_circumradius()};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_lambda_lower_ratio(), t.squared_circumradius_ratio()};
  }
};

/// Positions of the triangles whose ranks are too close to another's to trust.
std::vector<std::uint32_t> near_ties(std::span<const RankedTriangle> triangles);

/// Orders triangles whose ranks are equal, or may be for their primaries
/// are, as `exact` does: their secondary ranks become consecutive numbers,
/// the same for the same exact rank.
///
/// @param ties  near_ties(triangles), with the ranks there rounded once
void break_ties(std::vector<RankedTriangle>& triangles,
                std::vector<std::uint32_t> ties,
                const std::function<ExactRank(delaunay::Facet)>& exact);

void sort_by_corners(std::vector<RankedTriangle>& triangles);

/// Gabriel triangles, the smaller circumradius first: sizes, not shapes.
struct CircumradiusCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.squared_circumradius(), t.squared_lambda_lower()};
  }
  Rank nearest_rank(const DelaunayTriangle& t) const {
    return {t.exact_squared_circumradius(), t.exact_squared_lambda_lower()};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_circumradius_ratio(), t.squared_lambda_lower_ratio()};
  }
};

/// All triangles of the triangulation that the criterion admits, by ascending
/// corners. Depends on the set of points alone if the criterion does.
template <Criterion C = PaperCriterion>
std::vector<RankedTriangle> ranked_triangles(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    const C& criterion = {}) {
  const auto triangle = [&](delaunay::Facet facet) {
    return DelaunayTriangle(triangulation, spheres, facet);
  };
  std::vector<RankedTriangle> triangles;
  triangles.reserve(triangulation.n_finite_cells() / 2);
  FacetBlocks blocks(triangulation);
  std::array<FacetRadii, FacetBlocks::kLargest> radii;
  for (auto block = blocks.next(); !block.empty(); block = blocks.next()) {
    std::size_t n = 0;
    for (const delaunay::Facet facet : block) {
      // Written always and kept or not: which it is, no processor can guess.
      block[n] = facet;
      n += static_cast<std::size_t>(criterion.admissible(triangle(facet)));
    }
    spheres.measure(block.first(n), std::span(radii).first(n));
    for (std::size_t i = 0; i < n; ++i) {
      const DelaunayTriangle t(triangulation, spheres, block[i], &radii[i]);
      triangles.push_back({t.corners(), block[i], criterion.rank(t)});
    }
  }
  if constexpr (ExactCriterion<C>) {
    std::vector<std::uint32_t> ties = near_ties(triangles);
    for (const std::uint32_t i : ties)
      triangles[i].rank = criterion.nearest_rank(triangle(triangles[i].facet));
    break_ties(triangles, std::move(ties), [&](delaunay::Facet facet) {
      return criterion.exact_rank(triangle(facet));
    });
  }
  sort_by_corners(triangles);
  return triangles;
}

template <Criterion C = PaperCriterion>
std::vector<RankedTriangle> ranked_triangles(
    const delaunay::Triangulation3& triangulation, const C& criterion = {}) {
  return ranked_triangles(triangulation, Circumspheres(triangulation),
                          criterion);
}

}  // namespace umbrella
