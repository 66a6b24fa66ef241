/// @file
/// Delaunay triangulations by definition, for few points: the oracle of the
/// constructions and of their validators.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "delaunay/triangulation2.h"
#include "delaunay/triangulation3.h"

namespace tests {

/// Empty if no cell's perturbed circumsphere holds a point. O(cells points).
std::string first_full_ball(const delaunay::Triangulation2& t);
std::string first_full_ball(const delaunay::Triangulation3& t);

/// All sets of corners whose perturbed circumsphere is empty, each sorted, in
/// ascending order. For up to 50 distinct points.
std::vector<std::vector<delaunay::VertexId>> brute_force_cells(
    std::span<const delaunay::Point2> points);
std::vector<std::vector<delaunay::VertexId>> brute_force_cells(
    std::span<const delaunay::Point3> points);

/// The finite cells of a triangulation in the form of brute_force_cells().
std::vector<std::vector<delaunay::VertexId>> sorted_cells(
    const delaunay::Triangulation2& t);
std::vector<std::vector<delaunay::VertexId>> sorted_cells(
    const delaunay::Triangulation3& t);

}  // namespace tests
