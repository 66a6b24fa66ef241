/// @file
/// One umbrella at each vertex, on several threads: it is the vertex's own
/// business.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/filter.h"
#include "umbrella/incidence_internal.h"
#include "umbrella/ranges.h"

namespace umbrella {

/// What a range of vertices chooses.
class Choices {
 public:
  explicit Choices(std::size_t n_triangles = 0)
      : words_((n_triangles + kWordBits - 1) / kWordBits) {}

  void add(TriangleIndex t) {
    words_[t / kWordBits] |= std::uint64_t{1} << t % kWordBits;
  }
  void add_without_umbrella(VertexId v) { without_umbrella_.push_back(v); }
  /// What the range after this one chooses.
  void append(const Choices& next);
  /// @param triangles  those that the positions mean
  FilterResult among(std::span<const RankedTriangle> triangles) &&;

 private:
  static constexpr std::size_t kWordBits = 64;

  bool holds(TriangleIndex t) const {
    return (words_[t / kWordBits] >> t % kWordBits & 1U) != 0;
  }

  std::vector<std::uint64_t> words_;
  std::vector<VertexId> without_umbrella_;
};

/// The union of what each vertex v chooses: picker.pick(v, triangles at v), a
/// range of TriangleIndex, empty if there is no umbrella.
///
/// @param make_picker  called once by each thread
template <class MakePicker>
FilterResult filter_by_vertex(std::size_t n_vertices,
                              std::span<const RankedTriangle> triangles,
                              unsigned threads, const MakePicker& make_picker) {
  const Incidence incidence(
      n_vertices, triangles.size(),
      [&](TriangleIndex t) -> const Triangle& { return triangles[t].corners; });
  const auto choose = [&](IndexRange vertices) {
    auto picker = make_picker();
    Choices choices(triangles.size());
    for (std::size_t i = vertices.begin; i < vertices.end; ++i) {
      const VertexId v{static_cast<std::uint32_t>(i)};
      const auto& umbrella = picker.pick(v, incidence.at(v));
      if (umbrella.empty()) choices.add_without_umbrella(v);
      for (const TriangleIndex t : umbrella) choices.add(t);
    }
    return choices;
  };
  std::vector<Choices> parts = for_ranges(n_vertices, threads, choose);
  for (std::size_t i = 1; i < parts.size(); ++i) parts[0].append(parts[i]);
  return std::move(parts[0]).among(triangles);
}

}  // namespace umbrella
