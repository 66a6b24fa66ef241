#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "umbrella/exchange_internal.h"

namespace umbrella {
namespace {

/// Those of the first that are not among the others. @pre both ascend
std::vector<LocatedTriangle> without(std::span<const LocatedTriangle> all,
                                     std::span<const LocatedTriangle> others) {
  std::vector<LocatedTriangle> result;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                      std::back_inserter(result), by_corners);
  return result;
}

std::vector<double> above_least(std::span<const LocatedTriangle> triangles,
                                const Badness& badness) {
  std::vector<double> result;
  for (const auto& [corners, facet] : triangles)
    result.push_back(badness(corners, facet) - badness.least());
  return result;
}

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

}  // namespace

Exchange exchange_of(const Attempt& solved, const WorkingSurface& surface,
                     const Badness& badness) {
  std::vector<LocatedTriangle> before, after = solved.chosen;
  for (const TriangleIndex t : solved.freed)
    before.push_back(surface.triangle(t));
  std::sort(before.begin(), before.end(), by_corners);
  std::sort(after.begin(), after.end(), by_corners);
  const auto going = above_least(without(before, after), badness);
  const auto coming = above_least(without(after, before), badness);
  return {.worst_going =
              going.empty() ? 0 : *std::max_element(going.begin(), going.end()),
          .mean_going = mean(going),
          .mean_coming = mean(coming)};
}

}  // namespace umbrella
