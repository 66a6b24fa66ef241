/// @file
/// The whole way in the plane: points in, closed curves through them out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation2.h"
#include "umbrella/curve_auto.h"
#include "umbrella/curve_closing.h"
#include "umbrella/curve_tour.h"

namespace umbrella {

/// Closed curves as edges one after another, each curve counter-clockwise from
/// its first vertex, the curves by first vertex; after them the edges that are
/// on no simple closed curve, as they came.
///
/// @param edges  of the triangulation, distinct, ascending
std::vector<Edge> as_oriented_curves(const delaunay::Triangulation2& vertices,
                                     std::span<const Edge> edges);

enum class CurveMode {
  Auto,    ///< closed or open, as the sample says: auto_curves()
  Paper,   ///< what the filter picks, as printed
  Closed,  ///< all points on closed curves: close_curve()
  Open,    ///< auto_curves() with gaps of four times the spacing
  Tour,    ///< one closed curve of least length: shortest_tour()
  Mutual   ///< what both ends pick, no more: for samples with outliers
};

struct CurveOptions {
  CurveMode mode = CurveMode::Auto;
  CurveClosingOptions closing = {};
  TourOptions tour = {};
};

/// The counts of the report, under its names.
struct CurveCounts {
  std::size_t points = 0;      ///< rows
  std::size_t duplicates = 0;  ///< rows that repeat an earlier one
  std::size_t delaunay_cells = 0;
  std::size_t delaunay_edges = 0;
  std::size_t gabriel_edges = 0;
  std::size_t filter_edges = 0;
  std::size_t filter_without_umbrella = 0;
};

/// Wall clock of each stage.
struct CurveSeconds {
  double delaunay = 0;
  double lambda = 0;
  double filter = 0;
  double closing = 0;
};

struct CurveReconstruction {
  int dimension = -1;  ///< of the points: 2 if there is a triangulation
  /// Rows of the input, duplicates as the first of them; in the order of
  /// as_oriented_curves(), which depends on the set of points alone.
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<double> lambda;  ///< lower bound of each edge
  CurveCounts counts;
  CurveClosingReport closing;              ///< of CurveMode::Closed
  std::optional<CurveAutoReport> descent;  ///< of Auto and Open
  std::optional<TourResult> tour;          ///< of Tour; edges left out
  /// Distinct points without two edges, ascending.
  std::vector<std::uint32_t> open_rows;
  CurveSeconds seconds;
};

/// @param points  any unit; duplicates are merged. Collinear points give no
///   edges and a dimension below 2
/// @throws std::invalid_argument  a coordinate is not finite (names the row)
CurveReconstruction reconstruct_curve(std::span<const delaunay::Point2> points,
                                      const CurveOptions& options = {});

}  // namespace umbrella
