#include "delaunay/canonical_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace delaunay {
namespace {

using Corners = std::array<VertexId, 4>;

Corners ascending(const Cell& cell) {
  Corners corners = cell.vertex;
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool is_even_permutation(const Corners& corners) {
  unsigned inversions = 0;
  for (unsigned k = 0; k < 4; ++k)
    for (unsigned i = 0; i < k; ++i)
      inversions += corners[i] > corners[k] ? 1U : 0U;
  return inversions % 2 == 0;
}

/// In the order of a copy.
Corners ordered(const Cell& cell) {
  Corners corners = ascending(cell);
  if (!is_even_permutation(cell.vertex)) std::swap(corners[0], corners[1]);
  return corners;
}

unsigned position(const Corners& corners, VertexId v) {
  return static_cast<unsigned>(std::find(corners.begin(), corners.end(), v) -
                               corners.begin());
}

/// The facet of cell `to`, which has the corners of `from`, opposite the same.
Facet translated(const Cell& from, unsigned i, CellId id, const Cell& to) {
  return Facet(id, position(to.vertex, from.vertex[i]));
}

}  // namespace

CanonicalCells::CanonicalCells(const Triangulation3& original)
    : original_(original),
      triangulation_(original),
      original_of_(original.cells().size()),
      copy_of_(original.cells().size()) {
  number_cells();
  rewrite_cells();
}

void CanonicalCells::number_cells() {
  const auto n_finite = static_cast<std::ptrdiff_t>(original_.n_finite_cells());
  std::vector<std::pair<Corners, CellId>> order;
  order.reserve(original_.cells().size());
  for (const Cell& cell : original_.cells())
    order.emplace_back(ascending(cell),
                       CellId{static_cast<std::uint32_t>(order.size())});
  std::sort(order.begin(), order.begin() + n_finite);
  std::sort(order.begin() + n_finite, order.end());
  for (std::uint32_t c = 0; c < order.size(); ++c) {
    original_of_[c] = order[c].second;
    copy_of_[index(order[c].second)] = CellId{c};
  }
}

void CanonicalCells::rewrite_cells() {
  for (std::uint32_t c = 0; c < original_of_.size(); ++c) {
    const Cell& from = original_.cell(original_of_[c]);
    Cell& to = triangulation_.cells_[c];
    to = from;
    to.vertex = ordered(from);
  }
  for (std::uint32_t c = 0; c < original_of_.size(); ++c) {
    const Cell& from = original_.cell(original_of_[c]);
    Cell& to = triangulation_.cells_[c];
    for (unsigned i = 0; i < 4; ++i)
      to.neighbor[position(to.vertex, from.vertex[i])] =
          from_original(from.neighbor[i]);
  }
}

Facet CanonicalCells::from_original(Facet f) const {
  const CellId copy = copy_of_[index(f.cell())];
  return translated(original_.cell(f.cell()), f.index(), copy,
                    triangulation_.cell(copy));
}

Facet CanonicalCells::to_original(Facet f) const {
  const CellId original = original_of_[index(f.cell())];
  return translated(triangulation_.cell(f.cell()), f.index(), original,
                    original_.cell(original));
}

}  // namespace delaunay
