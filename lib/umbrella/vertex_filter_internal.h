/// @file
/// One umbrella at each vertex, on several threads: it is the vertex's own
/// business.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/filter.h"
#include "umbrella/ranges.h"
#include "umbrella/star_sweep_internal.h"

namespace umbrella {

/// What a range of vertices chooses.
class Choices {
 public:
  Choices() = default;
  explicit Choices(std::size_t n_triangles) : is_chosen_(3 * n_triangles) {}

  /// @param umbrella  positions in the star; empty if there is none
  void add(const Star& star, std::span<const std::uint32_t> umbrella) {
    if (umbrella.empty()) without_umbrella_.push_back(star.vertex);
    for (const std::uint32_t i : umbrella)
      is_chosen_[star.triangles[i].corner] = 1;
  }
  /// What the range after this one chooses.
  void append(const Choices& next);
  /// @param all  those that were in the stars
  FilterResult among(RankedTriangles all) &&;

 private:
  std::vector<std::uint8_t> is_chosen_;  // 3 t + i: by corner i of triangle t
  std::vector<VertexId> without_umbrella_;
};

/// Indices of triangles, ordered by first corners.
std::vector<TriangleIndex> by_first_corners(
    std::span<const RankedTriangle> triangles);

/// The union of what each vertex chooses.
///
/// @param make_picker  called once by each thread. Of what it returns,
///   pick(star) is the umbrella as positions in the star, empty if there is
///   none
template <class MakePicker>
FilterResult filter_by_vertex(std::size_t n_vertices, RankedTriangles triangles,
                              unsigned threads, const MakePicker& make_picker) {
  struct Part {
    Choices choices;
    bool has_seen_all = true;
  };
  std::vector<TriangleIndex> order;
  const auto choose = [&](IndexRange vertices) {
    auto picker = make_picker(std::as_const(triangles));
    StarSweep sweep(triangles, order, vertices);
    Choices choices(triangles.size());
    for (std::size_t i = vertices.begin; i < vertices.end; ++i) {
      const Star star = sweep.next();
      choices.add(star, picker.pick(star));
    }
    return Part{std::move(choices), sweep.has_seen_all()};
  };
  std::vector<Part> parts = for_ranges(n_vertices, threads, choose);
  // A look at their order beforehand takes as long as a tenth of all this.
  if (!std::ranges::all_of(parts, &Part::has_seen_all)) {
    order = by_first_corners(triangles);
    parts = for_ranges(n_vertices, threads, choose);
  }
  for (std::size_t i = 1; i < parts.size(); ++i)
    parts[0].choices.append(parts[i].choices);
  return std::move(parts[0].choices).among(std::move(triangles));
}

}  // namespace umbrella
