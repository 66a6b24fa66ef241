/// @file
/// The inequalities of [Adamy02, Def. 3.3] for one region.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "ilp/problem.h"
#include "ilp/solver.h"
#include "umbrella/region_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// A program over the candidates of a region: candidate i is variable i. The
/// other triangles of the surface at the program's vertices take part as
/// variables fixed to true; those of the surface that are candidates are free.
class ClosingProgram {
 public:
  /// @param candidates  distinct, ascending
  /// @param vertices  all corners of these, and perhaps more to be covered;
  ///   ascending
  /// @param may_drop  vertices that may stay without triangles if no fixed
  ///   triangle is there; ascending
  ClosingProgram(const WorkingSurface& surface,
                 std::span<const LocatedTriangle> candidates,
                 std::vector<VertexId> vertices,
                 std::span<const VertexId> may_drop);

  /// Says in addition that the candidates part inside from outside.
  void add_sides(std::span<const ilp::Wall> walls) {
    if (!walls.empty()) problem_.add_sides(walls);
  }

  /// Asks for at least so many candidates fewer than are on the surface.
  void demand_fewer(std::size_t n_triangles);

  const ilp::Problem& problem() const { return problem_; }
  std::size_t n_candidates() const { return n_candidates_; }
  /// Corners of candidates and the region's vertices; ascending.
  std::span<const VertexId> vertices() const { return vertices_; }
  /// Triangles of the surface that are candidates.
  std::span<const TriangleIndex> freed() const { return freed_; }
  /// Triangles of the surface that are not, but stand at a vertex of the
  /// program.
  std::span<const TriangleIndex> fixed() const { return fixed_; }

  /// Vertices that may stay bare, and for each the variable that says so.
  struct Droppable {
    VertexId vertex;
    ilp::VarId is_dropped;
  };
  std::span<const Droppable> droppable() const { return droppable_; }

  /// The vertices of the pairs and rings of a core, ascending. Clauses that
  /// were added later are left out.
  std::vector<VertexId> vertices_of(const ilp::Core& core) const;

 private:
  struct Member {
    Triangle corners;
    ilp::VarId var;
  };
  using Edge = std::array<VertexId, 2>;

  void add_members(const WorkingSurface& surface,
                   std::span<const LocatedTriangle> candidates);
  bool has_vertex(const Member& member, VertexId v) const;
  void add_pairs();
  void add_rings(std::span<const VertexId> may_drop);
  void add_ring(VertexId v, std::span<const Member> members, bool may_drop);
  void let_drop(VertexId v, std::span<const Member> members);

  ilp::Problem problem_;
  std::size_t n_candidates_;
  std::vector<VertexId> vertices_;
  std::vector<Member> members_;  // candidates, then fixed triangles
  std::vector<TriangleIndex> freed_, fixed_;
  std::vector<Edge> edge_of_pair_;
  std::vector<VertexId> vertex_of_ring_;
  std::vector<Droppable> droppable_;
  std::vector<VertexId> ends_;      // scratch: of the spokes of a ring
  std::vector<ilp::Spoke> spokes_;  // scratch
};

}  // namespace umbrella
