/// @file
/// The programs of holes cut into reconstructed surfaces: real work for the
/// solver, generated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "ilp/problem.h"
#include "umbrella/triangle.h"

namespace support {

struct HoleProgram {
  ilp::Problem problem;
  std::vector<ilp::VarId> worst_first;  ///< free triangles by circumradius
  std::vector<std::int64_t> weights;    ///< of all variables: area, rounded
  ilp::Model old;  ///< the triangles that were there: a model
  std::size_t n_vertices = 0;
};

/// Fixes some free variables at random, and sometimes adds a clause or a linear
/// constraint.
void mutate(ilp::Problem& problem, std::mt19937_64& rng);

class HoleMaker {
 public:
  struct Shape {
    std::string_view name;  ///< one of shapes::all()
    std::size_t n_points;
    double noise = 0;  ///< in distances of neighbours
    std::uint64_t seed = 1;
  };
  explicit HoleMaker(const Shape& shape);

  /// Whether the points gave a closed manifold surface, as holes need.
  bool is_closed() const { return is_closed_; }

  /// Takes the triangles at n vertices about a random one away; free are all
  /// Delaunay triangles with three corners there. The old triangles are one
  /// solution.
  /// @param with_sides  says which cells the free triangles part
  HoleProgram hole(std::size_t n, std::uint64_t seed,
                   bool with_sides = false) const;

 private:
  struct Located {
    umbrella::Triangle corners;
    std::array<std::uint32_t, 2> cells;
    double circumradius2;
    double area;
    bool in_surface;
  };

  std::vector<bool> patch(std::size_t n, std::uint64_t seed) const;
  std::vector<ilp::VarId> add_triangles(const std::vector<bool>& is_in,
                                        HoleProgram& hole) const;
  using Pairs = std::map<std::array<std::size_t, 2>, std::uint32_t>;
  Pairs add_pairs(const std::vector<bool>& is_in,
                  std::span<const ilp::VarId> var_of, ilp::Problem& p) const;
  void add_rings(const std::vector<bool>& is_in,
                 std::span<const ilp::VarId> var_of, const Pairs& pairs,
                 ilp::Problem& p) const;
  void add_sides(std::span<const ilp::VarId> var_of, ilp::Problem& p) const;

  bool is_closed_ = false;
  std::size_t n_vertices_ = 0;
  std::size_t n_cells_ = 0;
  std::vector<Located> triangles_;  // Delaunay, by ascending corners
};

}  // namespace support
