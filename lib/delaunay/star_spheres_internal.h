/// @file
/// Circumspheres of the cells that share a new vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "delaunay/triangulation3.h"

namespace delaunay {

/// From the new vertex to a corner of its star.
struct alignas(32) Spoke {
  std::array<double, 3> offset;
  double norm2;  ///< squared length of `offset`
};

/// Three corners of a star cell, as positions among the spokes.
using SpokeTriple = std::array<std::uint32_t, 3>;

struct Star {
  std::span<const Spoke> spokes;
  std::span<const SpokeTriple> corners;  ///< of each cell; an infinite one: 0
  std::span<const CellId> cells;
};

/// Writes centre and squared radii of each cell of the star.
/// @param apex  the new vertex
/// @param all   cells by id
void set_star_spheres(const double* apex, const Star& star, Cell* all);

/// No distance is certain: every test goes to the exact predicate.
void forget_sphere(Cell& cell);

}  // namespace delaunay
