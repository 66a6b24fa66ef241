/// @file
/// Closing a filtered curve: a 0/1 program over the Delaunay edges where the
/// filter has left anything but two edges a vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/curve_filter.h"

namespace umbrella {

/// What makes an edge the worse: the larger, the worse.
enum class CurveWeight { Length, LambdaLower };

struct CurveClosingOptions {
  CurveWeight weight = CurveWeight::Length;
  /// Conflicts of one search; the same on every run. Where counting arguments
  /// rule a solution out the search is no match for them: growing the region
  /// soon is better, docs/curve.md "Closing".
  std::uint64_t conflicts = 2'000;
  /// How often a region that has no solution is grown by a ring.
  unsigned max_growth = 8;
  /// Closed curves of at most max(piece_edges, piece_part * n) edges that pass
  /// a region are cut up as long as some other solution exists.
  std::size_t piece_edges = 4;
  double piece_part = 0.02;
};

struct CurveClosingReport {
  std::size_t regions = 0;  ///< at first, before growing
  std::size_t variables = 0;
  std::size_t feasible = 0;    ///< regions closed
  std::size_t infeasible = 0;  ///< programs proven to have no solution
  std::size_t undecided = 0;   ///< programs given up at the limit
  std::size_t grown = 0;       ///< regions closed after growing
  std::uint64_t conflicts = 0;
};

struct CurveClosingResult {
  std::vector<Edge> edges;  ///< at most two a vertex, ascending
  /// Vertices that have fewer: their regions have no solution. Ascending.
  std::vector<delaunay::VertexId> open;
  CurveClosingReport report;
};

/// Edges that both ends picked stay. The vertices that lack edges fall into
/// regions, joined by further Delaunay edges; in each region the edges are
/// switched off worst first as long as a solution with two edges a vertex
/// remains. Where there is none, the region grows and gives up edges.
///
/// @param n_vertices  all ends are below it
/// @param edges  all Delaunay edges, by ascending ends
/// @param agreed  some of them, ascending, at most two a vertex
CurveClosingResult close_curve(std::size_t n_vertices,
                               std::span<const DelaunayEdge> edges,
                               std::span<const Edge> agreed,
                               const CurveClosingOptions& options = {});

}  // namespace umbrella
