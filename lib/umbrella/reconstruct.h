/// @file
/// The whole way in one call: points in, a closed oriented surface out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/closing.h"
#include "umbrella/criteria.h"
#include "umbrella/given_faces.h"
#include "umbrella/triangle.h"
#include "umbrella/umbrella_choice.h"

namespace umbrella {

/// What to stop after.
enum class Stage { Filter, Clean, Closed };

struct ReconstructOptions {
  Stage stage = Stage::Closed;
  /// What finds the candidates, see parse_method(). But for "umbrella", what
  /// the next two say has no effect.
  std::string_view method = "umbrella";
  /// One of criterion_names().
  std::string_view criterion = "paper";
  UmbrellaChoice umbrella = UmbrellaChoice::First;
  CleanUpOptions clean_up = {};
  ClosingOptions closing = {};
  /// At most so many, closing.threads notwithstanding; the result is the same
  /// for any number.
  unsigned threads = 1;
  /// Triangles of another surface, as rows of the points: those that are
  /// Delaunay take the place of the filter's choice, which says no more than
  /// which points belong to which hole.
  std::optional<std::span<const IndexedTriangle>> faces = {};
  /// Called at the start of each stage with its name as in `seconds`.
  std::function<void(std::string_view)> progress = {};
};

/// The counts of the report, under its names.
struct ReconstructCounts {
  std::size_t points = 0;      ///< rows
  std::size_t duplicates = 0;  ///< rows that repeat an earlier one
  std::size_t delaunay_cells = 0;
  std::size_t delaunay_triangles = 0;
  std::size_t admissible_triangles = 0;  ///< Gabriel, by the paper's criterion
  std::size_t filter_triangles = 0;
  std::size_t filter_without_umbrella = 0;
  std::size_t deleted_type2 = 0;
  std::size_t deleted_type3 = 0;
  std::size_t dissolved = 0;
  std::size_t clean_triangles = 0;
  std::size_t clean_without_umbrella = 0;
  std::size_t holes = 0;
  std::size_t largest_hole_vertices = 0;

  friend bool operator==(const ReconstructCounts&,
                         const ReconstructCounts&) = default;
};

/// Wall clock of each stage.
struct ReconstructSeconds {
  double delaunay = 0;
  double lambda = 0;
  double filter = 0;
  double clean_up = 0;
  double holes = 0;
  double closing = 0;
  double surface = 0;  ///< lambdas, orientation
  double certificate = 0;
};

struct Reconstruction {
  int dimension = -1;  ///< of the points: 3 if there is a triangulation
  /// Rows of the input, duplicates as the first of them. Oriented outward if
  /// the surface is closed and manifold. In an order that depends on the set
  /// of points alone.
  std::vector<IndexedTriangle> triangles;
  /// Lower bound of each triangle's lambda-interval.
  std::vector<double> lambda;
  ReconstructCounts counts;
  FaceCounts faces;  ///< of ReconstructOptions::faces
  ClosingReport closing;
  std::vector<std::uint32_t> dropped_rows;  ///< left out to close, ascending
  std::vector<DropReason> drop_reasons;     ///< of dropped_rows
  /// Certificate of `triangles`, over the distinct points; its
  /// unused_vertices are rows of the input.
  SurfaceReport surface;
  ReconstructSeconds seconds;
};

/// @param points  any unit; duplicates are merged
/// @throws std::invalid_argument  a coordinate is not finite (names the row),
///   or there is no such criterion or method
Reconstruction reconstruct(std::span<const Point3> points,
                           const ReconstructOptions& options = {});

}  // namespace umbrella
