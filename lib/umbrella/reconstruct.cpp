#include "umbrella/reconstruct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "delaunay/spatial_sort.h"
#include "umbrella/filter.h"
#include "umbrella/methods.h"
#include "umbrella/stopwatch.h"
#include "umbrella/surface.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;

std::vector<LocatedTriangle> without_ranks(
    std::span<const RankedTriangle> ranked) {
  std::vector<LocatedTriangle> result(ranked.size());
  std::transform(ranked.begin(), ranked.end(), result.begin(),
                 [](const RankedTriangle& t) {
                   return LocatedTriangle{t.corners, t.facet};
                 });
  return result;
}

/// Lower bounds of the triangles' lambda-intervals.
///
/// @param ranked  by ascending corners, as `triangles`; what was measured of
///   these is not measured again
std::vector<double> lower_lambdas(const Triangulation3& triangulation,
                                  const Circumspheres& spheres,
                                  std::span<const LocatedTriangle> triangles,
                                  std::span<const RankedTriangle> ranked) {
  std::vector<double> lambda(triangles.size());
  std::vector<std::size_t> unknown;
  std::vector<FacetPoints> facets;  // of these
  auto next = ranked.begin();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [corners, facet] = triangles[t];
    while (next != ranked.end() && next->facet != facet &&
           next->corners < corners)
      ++next;
    const bool is_ranked = next != ranked.end() && next->facet == facet;
    const double known = is_ranked ? (next++)->squared_lambda : -1;
    if (known >= 0) {
      lambda[t] = std::sqrt(known);
    } else {
      unknown.push_back(t);
      facets.push_back(spheres.points_of(facet));
    }
  }
  std::vector<FacetRadii> radii(facets.size());
  spheres.measure(facets, radii);
  for (std::size_t i = 0; i < facets.size(); ++i)
    lambda[unknown[i]] =
        std::sqrt(DelaunayTriangle(triangulation, spheres,
                                   facets[i].triangle.facet, &radii[i])
                      .squared_lambda_lower());
  return lambda;
}

class Pipeline {
 public:
  explicit Pipeline(const ReconstructOptions& options)
      : options_(options), method_(parse_method(options.method)) {
    require_criterion(options.criterion);
  }

  Reconstruction run(std::span<const Point3> points);

 private:
  /// What `work` returns; notes the wall clock.
  template <class Work>
  auto timed(std::string_view stage, double& seconds, Work work) {
    if (options_.progress) options_.progress(stage);
    const Stopwatch stopwatch;
    auto value = work();
    seconds = stopwatch.seconds();
    return value;
  }

  /// The triangles to return, and some that have been measured, these by
  /// ascending corners.
  struct Chosen {
    std::vector<LocatedTriangle> triangles;
    std::vector<RankedTriangle> measured;
  };

  Chosen chosen_of(const Triangulation3& triangulation,
                   const Circumspheres& spheres, FilterResult filtered);
  FilterResult filtered(const Triangulation3& triangulation,
                        const Circumspheres& spheres);
  CleanUpResult cleaned(std::size_t n_vertices, FilterResult filtered);
  CleanUpResult cleaned_faces(const Triangulation3& triangulation,
                              const Circumspheres& spheres,
                              const FilterResult& filtered);
  std::vector<Hole> holes(std::size_t n_vertices, const CleanUpResult& clean);
  void finish(const Triangulation3& triangulation, const Circumspheres& spheres,
              const Chosen& chosen);

  void list_dropped(std::span<const std::uint32_t> row);

  const ReconstructOptions& options_;
  Method method_;
  std::vector<VertexId> dropped_;
  std::vector<DropReason> reasons_;
  Reconstruction result_;
};

Reconstruction Pipeline::run(std::span<const Point3> points) {
  const auto triangulation = timed("delaunay", result_.seconds.delaunay, [&] {
    return Triangulation3(points, options_.threads);
  });
  const auto spheres = timed("lambda", result_.seconds.lambda,
                             [&] { return Circumspheres(triangulation); });
  result_.dimension = triangulation.dimension();
  const std::size_t n_cells = triangulation.cells().size();
  const std::size_t n_outside = n_cells - triangulation.n_finite_cells();
  ReconstructCounts& counts = result_.counts;
  counts.points = points.size();
  counts.duplicates = points.size() - triangulation.points().size();
  counts.delaunay_cells = triangulation.n_finite_cells();
  // Four facets a cell, each seen from two cells or from outside the hull.
  counts.delaunay_triangles = (4 * counts.delaunay_cells + n_outside) / 2;
  if (result_.dimension < 3) return std::move(result_);
  finish(triangulation, spheres,
         chosen_of(triangulation, spheres, filtered(triangulation, spheres)));
  return std::move(result_);
}

Pipeline::Chosen Pipeline::chosen_of(const Triangulation3& triangulation,
                                     const Circumspheres& spheres,
                                     FilterResult filtered) {
  const std::size_t n = triangulation.points().size();
  result_.counts.filter_triangles = filtered.triangles.size();
  result_.counts.filter_without_umbrella = filtered.without_umbrella.size();
  if (options_.stage == Stage::Filter)
    return {without_ranks(filtered.triangles),
            std::move(filtered.triangles).list()};

  CleanUpResult clean = options_.faces
                            ? cleaned_faces(triangulation, spheres, filtered)
                            : cleaned(n, std::move(filtered));
  if (options_.stage == Stage::Clean)
    return {without_ranks(clean.triangles), std::move(clean.triangles)};

  const std::vector<Hole> open = holes(n, clean);
  ClosingOptions closing = options_.closing;
  closing.threads = options_.threads;
  // The faces given say which faces and lids are meant.
  closing.regain_faces = closing.regain_faces && !options_.faces;
  closing.open_bores = closing.open_bores && !options_.faces;
  ClosingResult closed = timed("closing", result_.seconds.closing, [&] {
    return close_holes(triangulation, clean.triangles, open, closing);
  });
  result_.closing = closed.report;
  dropped_ = std::move(closed.dropped);
  reasons_ = std::move(closed.reasons);
  return {std::move(closed.triangles), std::move(clean.triangles)};
}

FilterResult Pipeline::filtered(const Triangulation3& triangulation,
                                const Circumspheres& spheres) {
  if (!method_.is_umbrella()) {
    FilterResult result = timed("filter", result_.seconds.filter, [&] {
      return method_filter(method_, triangulation, spheres);
    });
    result_.counts.admissible_triangles = result.triangles.size();
    return result;
  }
  double seconds = 0;
  auto ranked = timed("lambda", seconds, [&] {
    return ranked_by(options_.criterion, triangulation, spheres,
                     options_.threads);
  });
  result_.seconds.lambda += seconds;
  result_.counts.admissible_triangles = ranked.size();
  return timed("filter", result_.seconds.filter, [&] {
    return umbrella_filter(triangulation.points(), std::move(ranked),
                           options_.umbrella, options_.threads);
  });
}

CleanUpResult Pipeline::cleaned(std::size_t n_vertices, FilterResult filtered) {
  CleanUpResult clean = timed("clean_up", result_.seconds.clean_up, [&] {
    return clean_up(n_vertices, std::move(filtered.triangles),
                    options_.clean_up, filtered.unsettled);
  });
  ReconstructCounts& counts = result_.counts;
  counts.deleted_type2 = clean.n_type2;
  counts.deleted_type3 = clean.n_type3;
  counts.dissolved = clean.n_dissolved;
  counts.clean_triangles = clean.triangles.size();
  counts.clean_without_umbrella = clean.without_umbrella.size();
  return clean;
}

/// The given faces, cleaned. What the filter would choose counts as deleted, as
/// if it had been there: it joins points that have no face to the holes.
CleanUpResult Pipeline::cleaned_faces(const Triangulation3& triangulation,
                                      const Circumspheres& spheres,
                                      const FilterResult& filtered) {
  GivenFaces given = locate_faces(triangulation, spheres, *options_.faces);
  result_.faces = given.counts;
  FilterResult instead;
  instead.triangles = std::move(given.triangles);
  CleanUpResult clean =
      cleaned(triangulation.points().size(), std::move(instead));
  const auto before = [](const RankedTriangle& a, const RankedTriangle& b) {
    return a.corners < b.corners;
  };
  std::vector<RankedTriangle> others, deleted;
  std::ranges::set_difference(filtered.triangles, clean.triangles,
                              std::back_inserter(others), before);
  std::ranges::set_union(clean.deleted, others, std::back_inserter(deleted),
                         before);
  clean.deleted = std::move(deleted);
  return clean;
}

std::vector<Hole> Pipeline::holes(std::size_t n_vertices,
                                  const CleanUpResult& clean) {
  std::vector<Hole> found = timed("holes", result_.seconds.holes, [&] {
    return find_holes(n_vertices, clean.triangles, clean.deleted,
                      clean.without_umbrella);
  });
  result_.counts.holes = found.size();
  for (const Hole& hole : found)
    result_.counts.largest_hole_vertices =
        std::max(result_.counts.largest_hole_vertices, hole.vertices.size());
  return found;
}

void Pipeline::finish(const Triangulation3& triangulation,
                      const Circumspheres& spheres, const Chosen& chosen) {
  result_.triangles = timed("surface", result_.seconds.surface, [&] {
    result_.lambda = lower_lambdas(triangulation, spheres, chosen.triangles,
                                   chosen.measured);
    return orient(triangulation.points(), chosen.triangles).triangles;
  });
  result_.surface = timed("certificate", result_.seconds.certificate, [&] {
    return check_surface(triangulation.points(), result_.triangles);
  });

  const std::vector<std::uint32_t> row = delaunay::first_rows(
      triangulation.points().size(), triangulation.vertex_of_row());
  for (std::uint32_t& v : result_.surface.unused_vertices) v = row[v];
  std::sort(result_.surface.unused_vertices.begin(),
            result_.surface.unused_vertices.end());
  list_dropped(row);
  for (IndexedTriangle& t : result_.triangles)
    for (std::uint32_t& v : t) v = row[v];
}

/// Rows ascending, each with its reason.
void Pipeline::list_dropped(std::span<const std::uint32_t> row) {
  std::vector<std::pair<std::uint32_t, DropReason>> dropped;
  for (std::size_t i = 0; i < dropped_.size(); ++i)
    dropped.emplace_back(row[index(dropped_[i])], reasons_[i]);
  std::sort(dropped.begin(), dropped.end());
  for (const auto& [r, reason] : dropped) {
    result_.dropped_rows.push_back(r);
    result_.drop_reasons.push_back(reason);
  }
}

}  // namespace

Reconstruction reconstruct(std::span<const Point3> points,
                           const ReconstructOptions& options) {
  return Pipeline(options).run(points);
}

}  // namespace umbrella
