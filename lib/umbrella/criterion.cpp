#include "umbrella/criterion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

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

std::vector<std::uint32_t> near_ties(std::span<const Candidate> candidates) {
  std::vector<std::uint32_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto rank = [&](std::uint32_t i) -> const Rank& {
    return candidates[i].triangle.rank;
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

std::vector<RankedTriangle> by_corners(std::span<const Candidate> candidates) {
  std::vector<RankedTriangle> triangles(candidates.size());
  std::transform(candidates.begin(), candidates.end(), triangles.begin(),
                 [](const Candidate& c) { return c.triangle; });
  std::sort(triangles.begin(), triangles.end(),
            [](const RankedTriangle& a, const RankedTriangle& b) {
              return a.corners < b.corners;
            });
  return triangles;
}

}  // namespace umbrella
