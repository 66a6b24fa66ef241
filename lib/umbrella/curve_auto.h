/// @file
/// Curves without a setting: what the filter is sure of, and the cheapest links
/// where it is not. Curves may be closed or open, one or many.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "delaunay/triangulation2.h"

namespace umbrella {

struct CurveAutoOptions {
  /// An edge of more than so many times the spacing is a gap between two ends.
  /// None: what suits the unevenness of the sample, docs/curve.md "Auto".
  std::optional<double> gap = std::nullopt;
  /// Joins all closed pieces into one curve, as far as exchanges of two links
  /// can, and leaves their length to shortest_tour(); else only pieces that
  /// have changed and lie near others.
  bool join_all = false;
};

struct CurveAutoReport {
  std::size_t gabriel_edges = 0;
  std::size_t filter_edges = 0;      ///< picked by one end at least
  std::size_t without_umbrella = 0;  ///< vertices with one Gabriel edge or none
  std::size_t ambiguous = 0;         ///< vertices that are looked at again
  std::size_t moves = 0;             ///< exchanges that made the links cheaper
  std::size_t joined = 0;            ///< small closed pieces opened into others
  std::size_t tours = 0;             ///< closed curves proven shortest
  std::size_t turns = 0;             ///< exchanges for the sake of corners
  double gap = 0;
};

struct CurveAutoResult {
  /// At each vertex the others that it is linked to, kInfinite where it has
  /// fewer than two.
  std::vector<std::array<delaunay::VertexId, 2>> links;
  std::vector<std::array<double, 2>> lambda;  ///< lower bound of each link
  CurveAutoReport report;
};

/// @param triangulation  of dimension 2
CurveAutoResult auto_curves(const delaunay::Triangulation2& triangulation,
                            const CurveAutoOptions& options = {});

}  // namespace umbrella
