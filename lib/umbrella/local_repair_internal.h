/// @file
/// Better topology about single places of a surface that is closed.
#pragma once

#include <cstddef>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/attempt_internal.h"
#include "umbrella/closing.h"
#include "umbrella/triangle.h"

namespace umbrella {

struct LocalRepair {
  std::size_t pieces_joined = 0;
  std::size_t brought_in = 0;
  std::size_t handles_removed = 0;
  Spent spent;
  std::vector<VertexId> left_out;  ///< on no triangle; ascending
};

/// Solves programs of a few vertices, with all else as it is, on all of which
/// as many propagations are spent as on two regions of all points, and as many
/// conflicts as on three:
///
/// - about each small closed piece that hangs together with others, for a
///   surface of fewer components;
/// - about each point that is left out, for one through it;
/// - about each loop of at most options.handle_edges edges that goes round a
///   handle and no tube, for one through the same points without: with all
///   points used, one handle less is four triangles less;
/// - if that has removed any, about loops of up to twice as many edges, for one
///   whose two sides are closed apart from each other, and then about some of
///   up to four times as many that go round a handle that is left, of a tube
///   or not.
///
/// But for loops of three edges, a handle stays at first if the triangles that
/// would come are on average 1.4 times as bad as those that would go, by
/// options.weight; of a longer loop than options.handle_edges, if they are
/// worse on average than the worst of those. At last, where some have gone and
/// only on a component that has been changed, a handle goes if those
/// that come have, on average, at most half more of ball overlap than those
/// that go, or two thirds at a long loop.
///
/// No point is lost, and components never become more.
///
/// @param triangles  of a closed manifold surface, by ascending corners;
///   changed where something was repaired
LocalRepair repair_locally(const delaunay::Triangulation3& triangulation,
                           const ClosingOptions& options,
                           std::vector<LocatedTriangle>& triangles);

}  // namespace umbrella
