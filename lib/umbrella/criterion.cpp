#include "umbrella/criterion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace umbrella {
namespace {

bool near(double a, double b) { return std::abs(a - b) <= kNearTie * b; }

/// Calls visit(first, last) for each maximal run of two or more positions in
/// which every value is near the one before.
template <class Iterator, class Value, class Visit>
void for_each_near_run(Iterator first, Iterator last, Value value,
                       Visit visit) {
  while (first != last) {
    Iterator end = first + 1;
    while (end != last && near(value(*(end - 1)), value(*end))) ++end;
    if (end - first > 1) visit(first, end);
    first = end;
  }
}

}  // namespace

std::vector<std::uint32_t> near_ties(
    std::span<const RankedTriangle> triangles) {
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto rank = [&](std::uint32_t i) -> const Rank& {
    return triangles[i].rank;
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return rank(a) < rank(b);
  });

  std::vector<std::uint32_t> ties;
  const auto add = [&](auto first, auto last) {
    ties.insert(ties.end(), first, last);
  };
  const auto primary = [&](std::uint32_t i) { return rank(i).primary; };
  const auto secondary = [&](std::uint32_t i) { return rank(i).secondary; };
  for_each_near_run(
      order.begin(), order.end(), primary, [&](auto first, auto last) {
        if (primary(*first) == 0)  // exact: only the secondary is in doubt
          for_each_near_run(first, last, secondary, add);
        else
          add(first, last);
      });
  return ties;
}

// By the first corner in one pass, then each short list.
void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  std::uint32_t n_keys = 0;
  for (const RankedTriangle& t : triangles)
    n_keys = std::max(n_keys, static_cast<std::uint32_t>(t.corners[0]) + 1);
  std::vector<std::uint32_t> first(n_keys + 1);
  for (const RankedTriangle& t : triangles) ++first[index(t.corners[0])];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<RankedTriangle> sorted(triangles.size());
  for (const RankedTriangle& t : triangles)
    sorted[--first[index(t.corners[0])]] = t;
  for (std::uint32_t k = 0; k < n_keys; ++k)
    std::sort(sorted.begin() + first[k], sorted.begin() + first[k + 1],
              [](const RankedTriangle& a, const RankedTriangle& b) {
                return a.corners < b.corners;
              });
  triangles = std::move(sorted);
}

}  // namespace umbrella
