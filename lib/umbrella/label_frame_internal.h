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
#include "umbrella/label_window_internal.h"
#include "umbrella/labelling_internal.h"

namespace umbrella {

class LabelFrame {
 public:
  LabelFrame(const delaunay::Triangulation3& triangulation, CloseWeight weight,
             std::span<const LocatedTriangle> kept,
             std::span<const VertexId> open);
  /// @param window  must outlive this object
  LabelFrame(const LabelWindow& window, CloseWeight weight)
      : LabelFrame(window.triangulation(), weight, window.kept(),
                   window.open()) {
    window_ = &window;
  }

  /// Null if there is none.
  const LabelWindow* window() const { return window_; }

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
  /// Delaunay edges from the nearest corner to the nearest vertex that was open
  /// at first, at most kFar.
  unsigned level(delaunay::Facet f) const;
  static constexpr std::uint8_t kFar = 2;
  /// All corners are open; false beyond the hull.
  bool is_open(delaunay::CellId c) const;
  void open(VertexId v) { is_open_[index(v)] = 1; }

 private:
  void find_levels();

  const delaunay::Triangulation3& triangulation_;
  Badness badness_;
  std::vector<std::uint8_t> kept_;  // by cell; bit i: facet i
  std::vector<std::uint8_t> is_open_;
  std::vector<std::uint8_t> level_;  // by vertex
  const LabelWindow* window_ = nullptr;
};

/// Changes the labels to those that are best by this order, each place in
/// favour of what comes first: kept triangles far from open vertices are on the
/// surface, the best first; closed ones there that are not kept are off it; the
/// same for those nearer, level by level; at last the open ones are off it, the
/// worst first. So what contradicts itself gives way near the open vertices.
/// Exact: the sets of facets between labels are a linear space over GF(2), in
/// which this greedy choice is optimal. All cells within the hull are inside if
/// nothing says what is. Labels leave a window if what is far away contradicts
/// itself.
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
