/// @file
/// The closing that cannot fail: every Delaunay cell is inside or outside, and
/// the surface is what lies between.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/closing.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct CellLabelOptions {
  CloseWeight weight = CloseWeight::Circumradius;
  /// Closed pieces of at most so many triangles are dissolved if their points
  /// can be reached from elsewhere.
  std::size_t piece_triangles = 12;
  /// Once true, there is no second look at the first labels, points are brought
  /// in only by single cells and nothing is improved: what is left to do takes
  /// little time, and the result is closed all the same.
  const std::atomic<bool>* stop = nullptr;
  /// Likewise after so much wall clock; then the result depends on the machine.
  double seconds = std::numeric_limits<double>::infinity();
  /// The caller promises that `kept` ascends by corners and is manifold at all
  /// vertices that are neither open nor bare. The result is the same. Where
  /// these are few, the time goes with their number, but for some passes over
  /// all vertices, cells and triangles.
  bool is_closed_elsewhere = false;
};

struct CellLabelReport {
  std::size_t given_up = 0;      ///< kept triangles that are not in the result
  std::size_t mended = 0;        ///< vertices that were not manifold at first
  std::size_t brought_in = 0;    ///< points that the first labels left out
  std::size_t dissolved = 0;     ///< triangles of small closed pieces
  std::size_t improvements = 0;  ///< pairs of triangles exchanged
};

struct CellLabelResult {
  std::vector<LocatedTriangle> triangles;  ///< by ascending corners
  std::vector<VertexId> left_out;          ///< on no triangle; ascending
  CellLabelReport report;
};

/// A closed, manifold surface without self-intersections, for any set of points
/// of dimension 3, from a surface that may be open, torn or missing. It holds
/// the kept triangles but for those that contradict others, and passes through
/// all points but for those that could not be reached; docs/labels.md. The time
/// is bounded, the result depends on the arguments alone.
///
/// To close the regions that are left open, pass all triangles of the surface,
/// and the vertices of the regions. To start from the certain triangles alone,
/// pass these, and all vertices. A closed manifold surface and no open vertex
/// gives the same surface, with points that it leaves out brought in.
///
/// @param kept  triangles of the surface, distinct; in any order
/// @param open  vertices, ascending: a triangle with all corners among these
///   may be on the surface where none is kept. Elsewhere the surface is what is
///   kept, unless that is not manifold there, or leaves a point out.
/// @pre the triangulation has dimension 3 (else the result is empty)
CellLabelResult close_by_cell_labels(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> kept, std::span<const VertexId> open,
    const CellLabelOptions& options = {});

}  // namespace umbrella
