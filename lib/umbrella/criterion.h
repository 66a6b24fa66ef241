/// @file
/// What makes a triangle fit for an umbrella, and which of two is better. A
/// criterion is any type with these two members:
///
///   struct ShortestFirst {
///     bool admissible(const DelaunayTriangle&) const { return true; }
///     Rank rank(const DelaunayTriangle& t) const {
///       return {t.circumradius(), t.area()};
///     }
///   };
///   const auto ranked = ranked_triangles(triangulation, ShortestFirst{});
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include "umbrella/circumspheres.h"
#include "umbrella/delaunay_triangle.h"
#include "umbrella/facets.h"
#include "umbrella/facets_by_corners.h"
#include "umbrella/ranges.h"
#include "umbrella/rank_order.h"
#include "umbrella/triangle.h"

namespace umbrella {

template <class C>
concept Criterion = requires(const C& c, const DelaunayTriangle& t) {
  { c.admissible(t) } -> std::convertible_to<bool>;
  { c.rank(t) } -> std::convertible_to<Rank>;
};

/// A criterion whose rank() is good to a part of kNearTie / 2, or rankable(),
/// and which can say it exactly: the order is the one of exact_rank(), which
/// several threads ask for. No rank is negative; a primary of zero is exact.
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
    const double lambda2 = t.squared_lambda_lower();
    return {lambda2 == 0 && t.on_hull() ? 0 : rankable(lambda2),
            rankable(t.squared_circumradius())};
  }
  ExactRank exact_rank(const DelaunayTriangle& t) const {
    return {t.squared_lambda_lower_ratio(), t.squared_circumradius_ratio()};
  }
};

/// What the criterion admits of the facets of some cells.
template <Criterion C>
FacetList admitted(const delaunay::Triangulation3& triangulation,
                   const Circumspheres& spheres, const C& criterion,
                   IndexRange cells) {
  FacetList facets;
  facets.reserve(cells.size() * 5 / 8);
  FacetBlocks blocks(triangulation, cells);
  for (auto block = blocks.next(); !block.empty(); block = blocks.next()) {
    std::size_t n = 0;
    for (const delaunay::Facet facet : block) {
      // Written always and kept or not: which it is, no processor can guess.
      block[n] = facet;
      n += static_cast<std::size_t>(criterion.admissible(
          DelaunayTriangle(triangulation, spheres, facet)));
    }
    for (const delaunay::Facet facet : block.first(n))
      facets.push_back(spheres.points_of(facet));
  }
  return facets;
}

/// Those of some lowest corners, with ranks, by ascending corners.
template <Criterion C>
std::vector<RankedTriangle> ranked(
    const delaunay::Triangulation3& triangulation, const Circumspheres& spheres,
    const C& criterion, const FacetsByCorners& facets, IndexRange lowest) {
  std::vector<RankedTriangle> triangles;
  triangles.reserve(facets.count(lowest));
  std::vector<FacetRadii> radii;
  FacetsByCorners::Walk walk(facets, lowest);
  for (auto block = walk.next(); !block.empty(); block = walk.next()) {
    radii.resize(block.size());
    spheres.measure(block, radii);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto& [corners, facet] = block[i].triangle;
      const DelaunayTriangle t(triangulation, spheres, facet, &radii[i]);
      // In place: a whole one, copied, waits for its parts to be written.
      RankedTriangle& next = triangles.emplace_back();
      next.corners = corners;
      next.facet = facet;
      next.rank = criterion.rank(t);
      next.squared_lambda = t.squared_lambda_lower();
    }
  }
  return triangles;
}

/// The order of a criterion's ranks; exact if it can say them exactly.
///
/// @param triangulation  must outlive the order
/// @param criterion  the order keeps a copy
template <Criterion C>
RankOrder rank_order(const delaunay::Triangulation3& triangulation,
                     const Circumspheres& spheres, const C& criterion) {
  if constexpr (ExactCriterion<C>)
    return RankOrder([&triangulation, spheres, criterion](delaunay::Facet f) {
      return criterion.exact_rank(DelaunayTriangle(triangulation, spheres, f));
    });
  return {};
}

/// All triangles of the triangulation that the criterion admits, by ascending
/// corners. Depends on the set of points alone if the criterion does.
///
/// @param triangulation  must outlive their order
/// @param threads  at most so many call the criterion, at the same time
template <Criterion C = PaperCriterion>
RankedTriangles ranked_triangles(const delaunay::Triangulation3& triangulation,
                                 const Circumspheres& spheres,
                                 const C& criterion = {},
                                 unsigned threads = 1) {
  const std::size_t n = triangulation.points().size();
  const auto find = [&](IndexRange cells) {
    return admitted(triangulation, spheres, criterion, cells);
  };
  const FacetsByCorners facets(
      n, joined(for_ranges(triangulation.n_finite_cells(), threads, find)));
  const auto rank = [&](IndexRange lowest) {
    return ranked(triangulation, spheres, criterion, facets, lowest);
  };
  return RankedTriangles(joined(for_ranges(n, threads, rank)),
                         rank_order(triangulation, spheres, criterion));
}

template <Criterion C = PaperCriterion>
RankedTriangles ranked_triangles(const delaunay::Triangulation3& triangulation,
                                 const C& criterion = {}) {
  return ranked_triangles(triangulation, Circumspheres(triangulation),
                          criterion);
}

}  // namespace umbrella
