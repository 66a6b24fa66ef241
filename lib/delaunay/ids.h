/// @file
/// Indices with a type: they index flat arrays, compare and hash, but a CellId
/// never passes for a VertexId.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace delaunay {

enum class VertexId : std::uint32_t {};
enum class CellId : std::uint32_t {};

/// Apex of the cells beyond the convex hull; has no coordinates.
inline constexpr VertexId kInfinite{0xffff'ffffU};

/// Row of `id` in a per-vertex or per-cell array.
template <class Id>
requires std::is_enum_v<Id>
constexpr std::size_t index(Id id) { return static_cast<std::size_t>(id); }

}  // namespace delaunay
