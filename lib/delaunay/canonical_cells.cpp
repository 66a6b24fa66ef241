#include "delaunay/canonical_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "delaunay/canonical_order_internal.h"

namespace delaunay {
namespace {

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

/// By their lowest corner, of which few have the same, then by the others. No
/// finite cell comes after an infinite one.
void CanonicalCells::number_cells() {
  const std::size_t n = original_.cells().size();
  const std::size_t n_points = original_.points().size();
  std::vector<Corners> corners(n);
  std::vector<std::uint32_t> first(2 * n_points + 1);
  const auto bucket = [&](std::size_t c) {
    return index(corners[c][0]) +
           (c < original_.n_finite_cells() ? 0 : n_points);
  };
  for (std::size_t c = 0; c < n; ++c) {
    corners[c] = ascending(original_.cells()[c].vertex);
    ++first[bucket(c) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (std::uint32_t c = 0; c < n; ++c)
    original_of_[first[bucket(c)]++] = CellId{c};
  for (std::size_t b = 0, begin = 0; b < 2 * n_points; begin = first[b++])
    std::sort(original_of_.begin() + static_cast<std::ptrdiff_t>(begin),
              original_of_.begin() + static_cast<std::ptrdiff_t>(first[b]),
              [&](CellId x, CellId y) {
                return corners[index(x)] < corners[index(y)];
              });
  for (std::uint32_t c = 0; c < n; ++c)
    copy_of_[index(original_of_[c])] = CellId{c};
}

/// Each cell is read and written once; of its neighbours only bytes are read.
void CanonicalCells::rewrite_cells() {
  const std::size_t n = original_.cells().size();
  // By cell of the original: the places of its corners in the copy.
  std::vector<std::uint8_t> places(n);
  for (std::size_t c = 0; c < n; ++c) {
    const Cell& from = original_.cells()[c];
    const Corners corners = in_canonical_order(from.vertex);
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
