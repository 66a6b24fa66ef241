/// @file
/// Orientation of a closed surface in one sweep over its vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/incidence_internal.h"

namespace umbrella {

/// The triangles of a closed surface, those of a component turned alike.
class TurnedTriangles {
 public:
  /// @param labels  2 i, if turned 2 i + 1, in the i-th component
  TurnedTriangles(std::vector<std::uint32_t> labels, std::size_t n_components)
      : labels_(std::move(labels)), n_components_(n_components) {}

  std::size_t n_components() const { return n_components_; }
  /// Counted from 0, by their first triangles.
  std::uint32_t component(TriangleIndex t) const { return labels_[t] >> 1U; }
  /// Against its ascending corners; not so the first of a component.
  bool is_turned(TriangleIndex t) const { return (labels_[t] & 1U) != 0; }

 private:
  std::vector<std::uint32_t> labels_;
  std::size_t n_components_;
};

/// @param triangles  distinct
/// @return none unless the first corners ascend, each edge has two triangles,
///   and all can be turned so that these run along it opposite ways
std::optional<TurnedTriangles> sweep_closed(
    std::size_t n_vertices, std::span<const LocatedTriangle> triangles);

}  // namespace umbrella
