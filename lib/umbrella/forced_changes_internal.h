/// @file
/// Programs about a closed surface in which some triangles have to go or come.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/region_solver_internal.h"

namespace umbrella {

class ForcedChanges {
 public:
  /// @param surface  closed and manifold
  /// @param effort  of all changes
  ForcedChanges(const delaunay::Triangulation3& triangulation,
                const ClosingOptions& options, WorkingSurface& surface,
                LocalEffort& effort)
      : options_(options),
        surface_(surface),
        is_open_(triangulation.points().size()),
        groups_(triangulation, {}, surface),
        solver_(triangulation, options, surface, is_open_, groups_),
        effort_(effort) {}

  /// What is forced.
  struct Change {
    std::vector<LocatedTriangle> going;   ///< all on the surface
    std::vector<LocatedTriangle> coming;  ///< by ascending corners; some may be
                                          ///< on the surface, and stay then
  };

  /// What the program of a region gives under a change, which is part of
  /// `freed` and `chosen` of the result. The surface is as before.
  ///
  /// @param is_barred  triangles that may not come
  Attempt solution(
      const Region& region, const Change& change,
      const std::function<bool(const LocatedTriangle&)>& is_barred =
          [](const LocatedTriangle&) { return false; });

  /// The triangle as the surface has it.
  std::optional<TriangleIndex> find(const LocatedTriangle& triangle) const;

  /// Triangles of the region that a program about it may take.
  std::vector<LocatedTriangle> candidates(const Region& region) {
    return solver_.candidates(region);
  }

  /// With the vertices joined to these; what has been left out stays out, so
  /// that the number of triangles tells that of handles.
  std::vector<VertexId> ringed(std::span<const VertexId> vertices);

  /// How many pieces more the surface would have.
  auto n_pieces_added(const Attempt& solved) {
    return solver_.n_pieces_added(solved, effort_.all);
  }

  /// Neither is the effort spent nor has the clock run out.
  bool may_go_on() const {
    return !effort_.all.is_spent() && !solver_.is_over();
  }

  const RegionSolver& solver() const { return solver_; }

 private:
  const ClosingOptions& options_;
  WorkingSurface& surface_;
  std::vector<bool> is_open_;  // none
  PointGroups groups_;
  RegionSolver solver_;
  LocalEffort& effort_;
};

}  // namespace umbrella
