/// @file
/// The inner loop of the search for a cavity; for bowyer_watson3*.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "delaunay/triangulation3.h"

namespace delaunay {

// Marks of the insertion under way: the signs of Cell::inside2 (in the cavity)
// and Cell::outside2 (next to it).
inline std::uint32_t is_marked(float x) {
  return std::bit_cast<std::uint32_t>(x) >> 31U;
}
inline void mark_if(std::uint32_t yes, float& x) {
  x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) | yes << 31U);
}
inline void unmark(float& x) { x = std::abs(x); }

inline double squared_distance(const Cell& cell, const double* p) {
  const double x = p[0] - cell.center[0];
  const double y = p[1] - cell.center[1];
  const double z = p[2] - cell.center[2];
  return x * x + y * y + z * z;
}

/// Whether a cell is in the cavity cannot be predicted, so nothing branches on
/// it: a facet is written behind both lists, and then they count it or do not.
/// The marks make the two comparisons right for cells seen before: a negated
/// inside2 denies "inside", a negated outside2 affirms "outside". So a cell of
/// the cavity is passed over, and one next to it gives one more facet of the
/// boundary. What the distance leaves open goes to a third list: the exact
/// predicate takes many at a time.
struct CavitySearch {
  Cell* cells;
  Facet* cavity;
  Facet* boundary;
  Facet* open;
  std::array<double, 3> p;  // what is inserted
  std::size_t n_cavity = 0;
  std::size_t n_boundary = 0;
  std::size_t n_open = 0;

  void look(Facet f) {
    Cell& cell = cells[index(f.cell())];
    const Floats radii = {cell.inside2, cell.outside2};
    const auto r2 = __builtin_convertvector(radii, Doubles);
    const double d2 = squared_distance(cell, p.data());
    // Of "inside" and "outside", and of the marks: -1 for yes.
    const Words certain = Doubles{d2, r2[1]} < Doubles{r2[0], d2};
    const auto bits = std::bit_cast<HalfWords>(radii);
    const auto marked = std::bit_cast<Floats>(
        bits | (__builtin_convertvector(certain, HalfWords) & kMarks));
    const std::int32_t in_cavity = bits[0] >> 31U;
    cell.inside2 = marked[0];
    cell.outside2 = marked[1];
    cavity[n_cavity] = f;
    n_cavity -= certain[0];
    boundary[n_boundary] = f;
    n_boundary -= certain[1];
    open[n_open] = f;
    n_open += (certain[0] | certain[1] | in_cavity) + 1;
  }
  /// Whether the cell is in the cavity, or next to it, for all that is known.
  bool has_seen(Facet f) const {
    const Cell& cell = cells[index(f.cell())];
    return (is_marked(cell.inside2) | is_marked(cell.outside2)) != 0;
  }
  /// Adds an open facet, unless its cell was seen meanwhile through another.
  /// @param is_inside  its cell is in the cavity
  void add_unless_seen(Facet f, bool is_inside) {
    const Cell& cell = cells[index(f.cell())];
    const std::uint32_t inside = is_inside;
    const std::uint32_t in_cavity = is_marked(cell.inside2);
    const std::uint32_t next_to_it = is_marked(cell.outside2);
    const std::uint32_t newly_inside = inside & ~(in_cavity | next_to_it);
    add(f, newly_inside, (newly_inside | in_cavity) ^ 1U);
  }
  /// The cell where the search begins.
  void add_seed(CellId seed) { add(Facet(seed, 0), 1, 0); }

  /// Length of the lists that suffices for four more calls, and for adding what
  /// is open then.
  std::size_t needed_room() const {
    return std::max(n_cavity, n_boundary) + n_open + 4;
  }

 private:
  // A number for "inside" and one for "outside".
  using Doubles [[gnu::vector_size(16)]] = double;
  using Words [[gnu::vector_size(16)]] = std::int64_t;
  using Floats [[gnu::vector_size(8)]] = float;
  using HalfWords [[gnu::vector_size(8)]] = std::int32_t;
  static constexpr std::int32_t kMark =
      std::numeric_limits<std::int32_t>::min();
  static constexpr HalfWords kMarks = {kMark, kMark};

  void add(Facet f, std::uint32_t inside, std::uint32_t outside) {
    Cell& cell = cells[index(f.cell())];
    cavity[n_cavity] = f;
    n_cavity += inside;
    mark_if(inside, cell.inside2);
    boundary[n_boundary] = f;
    n_boundary += outside;
    mark_if(outside, cell.outside2);
  }
};

}  // namespace delaunay
