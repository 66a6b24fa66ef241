/// @file
/// Switches of single cells that keep the surface manifold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "umbrella/label_frame_internal.h"

namespace umbrella {

/// A cell with one triangle of the surface, its opposite corner on none, can be
/// switched: the corner comes to the surface. With two, if their common edge's
/// opposite edge is not on the surface, too: they are exchanged for the
/// other two. Both leave the surface what it is, but for its place.
class LabelMoves {
 public:
  /// @param frame, labels  must outlive this object; `labels`, whose surface is
  ///   manifold, is changed
  LabelMoves(const LabelFrame& frame, Labelling& labels)
      : frame_(frame),
        labels_(labels),
        met_(labels.triangulation().cells().size()) {}

  /// Brings in points as long as that is possible, those first for which the
  /// least bad triangles come, and those before that cost no kept triangle.
  /// @param vertices  to begin with
  /// @return how many came to the surface
  std::size_t bring_in(std::span<const VertexId> vertices);

  /// Brings in one point after another by moving the surface up to it: cells
  /// on the way are switched, the nearest to the point first, or taken back if
  /// that does not lead there.
  /// @return how many came to the surface, others on the way included
  std::size_t reach(std::span<const VertexId> vertices);

  /// Takes closed pieces of at most so many triangles away, all corners open,
  /// if all their points can then be brought in elsewhere.
  /// @return how many triangles were taken
  std::size_t dissolve(std::size_t largest);

  /// Exchanges pairs of open triangles that are not kept as long as the worse
  /// of two becomes better, or the better one, the worse being equal.
  /// @return how many pairs
  std::size_t exchange();

 private:
  struct Gain {
    bool is_kept;
    double cost;
    delaunay::Facet facet;  // of the cell to be switched
    friend bool operator<(const Gain& a, const Gain& b) {  // the worse one
      if (a.is_kept != b.is_kept) return a.is_kept;
      if (a.cost != b.cost) return a.cost > b.cost;
      return index(a.facet.cell()) > index(b.facet.cell());
    }
  };

  void consider(delaunay::Facet facet);
  void flip(delaunay::CellId c);
  void take_back();
  std::size_t reach(VertexId v);
  void find_surroundings(VertexId v);
  bool can_switch(delaunay::CellId c) const;
  bool dissolve(std::span<const LocatedTriangle> piece);
  bool find_enclosed(delaunay::CellId start, std::size_t n_walls);
  bool try_exchange(delaunay::CellId c);
  bool is_better(delaunay::CellId c, unsigned facets) const;

  const LabelFrame& frame_;
  Labelling& labels_;
  std::priority_queue<Gain> gains_;
  std::vector<delaunay::CellId> flipped_;  // the last ones, to take them back
  std::vector<delaunay::CellId> enclosed_;
  std::vector<delaunay::CellId> near_;  // around a point, nearest first
  std::vector<std::uint32_t> met_;      // by cell: the last search
  std::uint32_t n_searches_ = 0;
  StarParts parts_;
};

/// Vertices on no triangle of the surface, ascending.
std::vector<VertexId> unused_vertices(const Labelling& labels);

}  // namespace umbrella
