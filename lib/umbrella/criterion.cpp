#include "umbrella/criterion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "umbrella/buckets_internal.h"

namespace umbrella {
namespace {

bool near(double a, double b) { return std::abs(a - b) <= kNearTie * b; }

/// One key of a rank, and whose it is.
struct Entry {
  double value;
  std::uint32_t position;
};

/// Orders doubles that are not negative as their values do.
std::uint64_t bits(const Entry& e) {
  return std::bit_cast<std::uint64_t>(e.value);
}

/// Buckets are equal steps of the bits, that is of a logarithm.
void sort_by_value(std::vector<Entry>& entries) {
  std::uint64_t lowest = std::numeric_limits<std::uint64_t>::max(), highest = 0;
  for (const Entry& e : entries) {
    lowest = std::min(lowest, bits(e));
    highest = std::max(highest, bits(e));
  }
  const std::size_t n = entries.size();
  const double step =
      static_cast<double>(n) / (static_cast<double>(highest - lowest) + 1);
  bucket_sort(
      entries, n + 1,
      [&](const Entry& e) {
        return static_cast<std::size_t>(static_cast<double>(bits(e) - lowest) *
                                        step);
      },
      [](const Entry& a, const Entry& b) { return a.value < b.value; });
}

/// Appends the positions of the entries that are near another one.
void add_near_ones(std::vector<Entry> entries,
                   std::vector<std::uint32_t>& positions) {
  if (entries.empty()) return;
  sort_by_value(entries);
  bool is_near_previous = false;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_near_next =
        i + 1 < entries.size() && near(entries[i].value, entries[i + 1].value);
    if (is_near_previous || is_near_next)
      positions.push_back(entries[i].position);
    is_near_previous = is_near_next;
  }
}

}  // namespace

std::vector<delaunay::Facet> facets(
    const delaunay::Triangulation3& triangulation) {
  const std::size_t n_cells = triangulation.n_finite_cells();
  std::vector<delaunay::Facet> result(4 * n_cells);
  std::size_t n = 0;
  for (std::uint32_t i = 0; i < n_cells; ++i) {
    const delaunay::CellId c{i};
    for (unsigned k = 0; k < 4; ++k) {
      // Written always and kept or not: which it is, no processor can guess.
      result[n] = delaunay::Facet(c, k);
      n += c < triangulation.cell(c).neighbor[k].cell() ? 1 : 0;
    }
  }
  result.resize(n);
  return result;
}

std::vector<std::uint32_t> near_ties(
    std::span<const RankedTriangle> triangles) {
  // A primary of zero is exact, and only the secondary is in doubt.
  std::vector<Entry> primaries, secondaries_at_zero;
  primaries.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Rank& rank = triangles[i].rank;
    if (rank.primary == 0)
      secondaries_at_zero.push_back({rank.secondary, i});
    else
      primaries.push_back({rank.primary, i});
  }
  std::vector<std::uint32_t> ties;
  add_near_ones(std::move(primaries), ties);
  add_near_ones(std::move(secondaries_at_zero), ties);
  return ties;
}

void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  std::size_t n_lowest = 0;
  for (const RankedTriangle& t : triangles)
    n_lowest = std::max(n_lowest, index(t.corners[0]) + 1);
  bucket_sort(
      triangles, n_lowest,
      [](const RankedTriangle& t) { return index(t.corners[0]); },
      [](const RankedTriangle& a, const RankedTriangle& b) {
        return a.corners < b.corners;
      });
}

}  // namespace umbrella
