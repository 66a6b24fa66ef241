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
#include "umbrella/exact_order.h"
#include "umbrella/exact_ratio.h"
#include "umbrella/facets.h"
#include "umbrella/ranges.h"
#include "umbrella/triangle.h"

namespace umbrella {

template <class C>
concept Criterion = requires(const C& c, const DelaunayTriangle& t) {
  { c.admissible(t) } -> std::convertible_to<bool>;
  { c.rank(t) } -> std::convertible_to<Rank>;
};

/// A criterion whose rank() is good to a part of kNearTie / 2 only, and which
/// can say it exactly: the order is then the one of exact_rank(). Ranks must
/// not be negative, and a primary of zero must be exact.
template <class C>
concept ExactCriterion = Criterion<C> &&
    requires(const C& c, const DelaunayTriangle& t) {
  { c.exact_rank(t) } -> std::convertible_to<ExactRank>;
};

/// The paper's: Gabriel triangles, by the lower bound of the lambda-interval.
/// All hull triangles tie at 0 there; the smaller circumradius then goes
/// first. Both are squared.
struct PaperCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.squared_lambda_lower(), t.squared_circumradius()};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_lambda_lower_ratio(), t.squared_circumradius_ratio()};
  }
};

void sort_by_corners(std::vector<RankedTriangle>& triangles);

/// Gabriel triangles, the smaller circumradius first: sizes, not shapes.
struct CircumradiusCriterion {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    return {t.squared_circumradius(), t.squared_lambda_lower()};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_circumradius_ratio(), t.squared_lambda_lower_ratio()};
  }
};

/// What the criterion admits of the facets of some cells, with ranks.
template <Criterion C>
std::vector<RankedTriangle> admitted(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    const C& criterion, IndexRange cells) {
  std::vector<RankedTriangle> triangles;
  // Of a scan some two in five cells give one, of a solid more; what is never
  // used is never laid out.
  triangles.reserve(cells.size());
  FacetBlocks blocks(triangulation, cells);
  std::array<FacetRadii, FacetBlocks::kLargest> radii;
  for (auto block = blocks.next(); !block.empty(); block = blocks.next()) {
    std::size_t n = 0;
    for (const delaunay::Facet facet : block) {
      // Written always and kept or not: which it is, no processor can guess.
      block[n] = facet;
      n += static_cast<std::size_t>(criterion.admissible(
          DelaunayTriangle(triangulation, spheres, facet)));
    }
    spheres.measure(block.first(n), std::span(radii).first(n));
    for (std::size_t i = 0; i < n; ++i) {
      const DelaunayTriangle t(triangulation, spheres, block[i], &radii[i]);
      // In place: a whole one, copied, waits for its parts to be written.
      RankedTriangle& ranked = triangles.emplace_back();
      ranked.corners = t.corners();
      ranked.facet = block[i];
      ranked.rank = criterion.rank(t);
      ranked.squared_lambda = t.squared_lambda_lower();
    }
  }
  return triangles;
}

/// All triangles of the triangulation that the criterion admits, by ascending
/// corners. Depends on the set of points alone if the criterion does.
///
/// @param threads  at most so many call the criterion, at the same time
template <Criterion C = PaperCriterion>
std::vector<RankedTriangle> ranked_triangles(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    const C& criterion = {}, unsigned threads = 1) {
  auto triangles = joined(for_ranges(
      triangulation.n_finite_cells(), threads, [&](IndexRange cells) {
        return admitted(triangulation, spheres, criterion, cells);
      }));
  if constexpr (ExactCriterion<C>)
    order_exactly(triangles, [&](delaunay::Facet facet) {
      return criterion.exact_rank(
          DelaunayTriangle(triangulation, spheres, facet));
    });
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
