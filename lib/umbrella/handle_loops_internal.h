/// @file
/// Short loops round the handles of a surface that changes in few places.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "umbrella/essential_loops_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Looks at the whole surface once, and from then on only where it has changed
/// and where there were loops. What is found there is what the whole surface
/// has there.
class HandleLoops {
 public:
  using Loops = std::vector<std::vector<VertexId>>;

  explicit HandleLoops(unsigned max_edges) : max_edges_(max_edges) {}

  /// Those of EssentialLoops::shortest() of a closed surface.
  Loops all(std::size_t n_vertices, std::span<const LocatedTriangle> triangles);

  /// From now on loops of at most so many edges count. The last call is taken
  /// to have found those that the surface had when all() looked at it.
  /// @pre all() has been called
  void set_max_edges(unsigned max_edges);

  /// Of these those that go through vertices of the triangles that have come
  /// since the last call, `changed`, or through vertices of the loops that it
  /// found, of tubes as well.
  Loops about(const WorkingSurface& surface, std::span<const VertexId> changed);

  /// EssentialLoops::independent of the surface near these vertices and where
  /// it had loops at first, twice a handle at most.
  /// @param changed  vertices of the triangles that have come since all()
  /// @param max_edges  the same in each call
  /// @pre all() has been called
  std::vector<Loops> independent(const WorkingSurface& surface,
                                 std::span<const VertexId> changed,
                                 unsigned max_edges, std::size_t n_alike);

 private:
  unsigned max_edges_;
  std::optional<EssentialLoops> at_first_;  // of the call of all()
  std::optional<std::vector<VertexId>> starts_at_first_;  // of these, long ones
  std::vector<VertexId> on_loops_;  // of the last call; ascending
};

}  // namespace umbrella
