/// @file
/// Cells numbered by the points alone.
#pragma once

#include <vector>

#include "delaunay/triangulation3.h"

namespace delaunay {

/// A copy of a triangulation whose cells have the same numbers, and their
/// corners the same order, for whatever number of threads made the original.
/// Finite cells, and infinite ones, go by ascending corners; the corners of a
/// cell ascend, but for the first two where the orientation wants it. For
/// algorithms that break ties by the numbers of cells. Spheres are copied, and
/// may differ in how they are rounded.
class CanonicalCells {
 public:
  explicit CanonicalCells(const Triangulation3& original);

  const Triangulation3& triangulation() const { return triangulation_; }
  /// The facet of the copy for one of the original, and back.
  Facet from_original(Facet f) const;
  Facet to_original(Facet f) const;

 private:
  void number_cells();
  void rewrite_cells();

  const Triangulation3& original_;
  Triangulation3 triangulation_;
  std::vector<CellId> original_of_;  // by cell of the copy
  std::vector<CellId> copy_of_;      // by cell of the original
};

}  // namespace delaunay
