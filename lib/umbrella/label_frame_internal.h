/// @file
/// What the steps of closing by cell labels have in common: which triangles are
/// to be kept, which vertices are open, how bad a triangle is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/badness_internal.h"
#include "umbrella/cell_labels.h"
#include "umbrella/labelling_internal.h"

namespace umbrella {

class LabelFrame {
 public:
  LabelFrame(const delaunay::Triangulation3& triangulation, CloseWeight weight,
             std::span<const LocatedTriangle> kept,
             std::span<const VertexId> open);

  const delaunay::Triangulation3& triangulation() const {
    return triangulation_;
  }
  double badness(delaunay::Facet f) const {
    return badness_(corners(triangulation_, f), f);
  }
  /// The root of the badness over the least that there can be: the
  /// circumradius, lambda, the area, or the like for the overlap of balls.
  double weight(delaunay::Facet f) const {
    return std::sqrt(std::max(badness(f) - badness_.least(), 0.0));
  }
  /// Makes these the kept ones.
  void keep(std::span<const LocatedTriangle> kept);
  bool is_kept(delaunay::Facet f) const {
    return (kept_[index(f.cell())] >> f.index() & 1U) != 0;
  }

  bool is_open(VertexId v) const { return is_open_[index(v)] != 0; }
  /// All corners are open: the triangle is free, but for one that is kept.
  bool is_open(delaunay::Facet f) const;
  /// All corners are open; false beyond the hull.
  bool is_open(delaunay::CellId c) const;
  void open(VertexId v) { is_open_[index(v)] = 1; }

 private:
  const delaunay::Triangulation3& triangulation_;
  Badness badness_;
  std::vector<std::uint8_t> kept_;  // by cell; bit i: facet i
  std::vector<std::uint8_t> is_open_;
};

/// Changes the labels to those with all kept triangles on the surface that do
/// not contradict better ones, no closed triangle that is not kept, and of the
/// open ones those that are best by worst-first order: the worst is off the
/// surface where labels exist without it, then the next. Exact: the sets of
/// facets between labels are a linear space over GF(2), in which this greedy
/// choice is optimal. All cells within the hull are inside if nothing says what
/// is.
void label_worst_first(const LabelFrame& frame,
                       std::span<const LocatedTriangle> kept,
                       Labelling& labels);

/// Those of the kept triangles that a surface of small total weight would
/// hold, whose sides are those of the labels: fragments that stand alone, or
/// on the wrong side of others, are not among these. A kept triangle costs its
/// weight where it is not held. All of them if the effort does not suffice.
std::vector<LocatedTriangle> held_by_cut(const LabelFrame& frame,
                                         std::span<const LocatedTriangle> kept,
                                         const Labelling& labels);

}  // namespace umbrella
