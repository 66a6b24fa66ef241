/// @file
/// The inequalities of [Adamy02, Def. 3.3] for one region.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ilp/problem.h"
#include "ilp/rows.h"
#include "ilp/solver.h"
#include "umbrella/region_internal.h"
#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// Some vertices, numbered in a row.
class VertexNumbers {
 public:
  explicit VertexNumbers(std::size_t n_vertices) : number_(n_vertices) {}

  /// Forgets those before.
  void assign(std::span<const VertexId> vertices) {
    vertices_.assign(vertices.begin(), vertices.end());
    for (std::uint32_t i = 0; i < vertices_.size(); ++i)
      number_[index(vertices_[i])] = i;
  }
  bool contains(VertexId v) const {
    const std::uint32_t i = number_[index(v)];
    return i < vertices_.size() && vertices_[i] == v;
  }
  /// @pre contains(v)
  std::uint32_t operator[](VertexId v) const { return number_[index(v)]; }

 private:
  std::vector<VertexId> vertices_;
  std::vector<std::uint32_t> number_;  // of others: anything
};

/// A program over the candidates of a region: candidate i is variable i. The
/// other triangles of the surface at the program's vertices take part as
/// variables fixed to true; those of the surface that are candidates are free.
class ClosingProgram {
 public:
  struct Parts {
    /// Distinct, ascending.
    std::span<const LocatedTriangle> candidates;
    /// All corners of these, and perhaps more to be covered; ascending.
    std::vector<VertexId> vertices;
    /// Those that may stay without triangles if no fixed triangle is there;
    /// ascending.
    std::span<const VertexId> may_drop = {};
  };

  /// @param numbers  scratch, of all vertices
  ClosingProgram(const WorkingSurface& surface, Parts parts,
                 VertexNumbers& numbers);

  /// Says in addition that the candidates part inside from outside.
  void add_sides(std::span<const ilp::Wall> walls) {
    if (!walls.empty()) problem_.add_sides(walls);
  }

  /// Asks for at least so many candidates fewer than are on the surface.
  void demand_fewer(std::size_t n_triangles);

  /// Bars all candidates with corners among these and among others.
  /// @param part  ascending
  void set_apart(std::span<const VertexId> part);

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
  using Edge = std::array<VertexId, 2>;
  /// Corners of a triangle by their place in nodes_; ascending.
  using Member = std::array<std::uint32_t, 3>;
  /// By side, 3 triangle + side: the number of its pair.
  using PairOfSide = std::vector<std::uint32_t>;

  void sort_triangles(const WorkingSurface& surface,
                      std::span<const LocatedTriangle> candidates,
                      const VertexNumbers& numbers);
  void add_members(const WorkingSurface& surface,
                   std::span<const LocatedTriangle> candidates,
                   VertexNumbers& numbers);
  PairOfSide add_pairs();
  void add_rings(const PairOfSide& pairs, std::span<const VertexId> may_drop);
  void let_drop(VertexId v, std::span<const std::uint32_t> corners);

  ilp::Problem problem_;
  std::size_t n_candidates_;
  std::vector<VertexId> vertices_;
  std::vector<TriangleIndex> freed_, fixed_;
  std::vector<VertexId> nodes_;  // those, and other corners of the fixed ones
  std::vector<std::uint8_t> is_free_;  // by node: one of those
  std::vector<Member> members_;  // by variable: candidates, then fixed ones
  std::vector<Edge> edge_of_pair_;
  std::vector<VertexId> vertex_of_ring_;
  std::vector<Droppable> droppable_;
};

}  // namespace umbrella
