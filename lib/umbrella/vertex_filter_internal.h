/// @file
/// One umbrella at each vertex, on several threads: it is the vertex's own
/// business.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "umbrella/filter.h"
#include "umbrella/incidence_internal.h"
#include "umbrella/ranges.h"

namespace umbrella {

/// What a range of vertices chooses.
class Choices {
 public:
  Choices() = default;
  Choices(std::size_t n_triangles, std::size_t n_vertices)
      : words_((n_triangles + kWordBits - 1) / kWordBits) {
    size_.reserve(n_vertices);
  }

  /// @param umbrella  of the next vertex; empty if there is none
  template <class Umbrella>
  void add(VertexId v, const Umbrella& umbrella) {
    size_.push_back(static_cast<std::uint32_t>(umbrella.size()));
    if (umbrella.empty()) without_umbrella_.push_back(v);
    for (const TriangleIndex t : umbrella)
      words_[t / kWordBits] |= std::uint64_t{1} << t % kWordBits;
  }
  /// What the range after this one chooses.
  void append(const Choices& next);
  /// @param triangles  those that the positions mean
  FilterResult among(const RankedTriangles& triangles) &&;

 private:
  static constexpr std::size_t kWordBits = 64;

  bool holds(TriangleIndex t) const {
    return (words_[t / kWordBits] >> t % kWordBits & 1U) != 0;
  }

  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> size_;  // of the umbrella of a vertex
  std::vector<VertexId> without_umbrella_;
};

/// The union of what each vertex v chooses: picker.pick(v, triangles at v), the
/// umbrella as a range of TriangleIndex, empty if there is none.
///
/// @param make_picker  called once by each thread
template <class MakePicker>
FilterResult filter_by_vertex(std::size_t n_vertices,
                              const RankedTriangles& triangles,
                              unsigned threads, const MakePicker& make_picker) {
  const Incidence incidence(
      n_vertices, triangles.size(),
      [&](TriangleIndex t) -> const Triangle& { return triangles[t].corners; });
  const auto choose = [&](IndexRange vertices) {
    auto picker = make_picker();
    Choices choices(triangles.size(), vertices.size());
    for (std::size_t i = vertices.begin; i < vertices.end; ++i) {
      const VertexId v{static_cast<std::uint32_t>(i)};
      choices.add(v, picker.pick(v, incidence.at(v)));
    }
    return choices;
  };
  std::vector<Choices> parts = for_ranges(n_vertices, threads, choose);
  for (std::size_t i = 1; i < parts.size(); ++i) parts[0].append(parts[i]);
  return std::move(parts[0]).among(triangles);
}

}  // namespace umbrella
