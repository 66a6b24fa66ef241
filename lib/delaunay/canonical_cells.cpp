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

/// Each cell is read and written once; of its neighbours only bytes are read.
void CanonicalCells::rewrite_cells() {
  const std::size_t n = original_.cells().size();
  // By cell of the original: the places of its corners in the copy.
  std::vector<std::uint8_t> places(n);
  for (std::size_t c = 0; c < n; ++c) {
    const Cell& from = original_.cells()[c];
    const Corners corners = ordered(from);
    for (unsigned i = 0; i < 4; ++i)
      places[c] |=
          static_cast<std::uint8_t>(position(corners, from.vertex[i]) << 2 * i);
  }
  const auto copied = [&](Facet f) {
    return Facet(copy_of_[index(f.cell())],
                 places[index(f.cell())] >> 2 * f.index() & 3U);
  };
  for (std::uint32_t c = 0; c < n; ++c) {
    const Cell& from = original_.cells()[c];
    Cell to = from;
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned place = copied(Facet(CellId{c}, i)).index();
      to.vertex[place] = from.vertex[i];
      to.neighbor[place] = copied(from.neighbor[i]);
    }
    triangulation_.cells_[index(copy_of_[c])] = to;
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
