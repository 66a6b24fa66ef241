#include <algorithm>

#include "umbrella/forced_changes_internal.h"

namespace umbrella {

Attempt ForcedChanges::solution(
    const Region& region, const Change& change,
    const std::function<bool(const LocatedTriangle&)>& is_barred) {
  const std::vector<LocatedTriangle>& coming = change.coming;
  std::vector<LocatedTriangle> candidates = solver_.candidates(region);
  std::erase_if(candidates, [&](const LocatedTriangle& t) {
    return is_barred(t) ||
           std::binary_search(coming.begin(), coming.end(), t, by_corners);
  });
  const auto first_added = static_cast<TriangleIndex>(surface_.n_indices());
  std::vector<TriangleIndex> off;
  for (const LocatedTriangle& t : change.going) off.push_back(*find(t));
  std::vector<LocatedTriangle> on = coming;
  std::erase_if(
      on, [this](const LocatedTriangle& t) { return find(t).has_value(); });
  surface_.replace(off, on);
  Attempt result = effort_.all.lend(
      effort_.conflicts_of_each, options_.propagations, [&](Effort& lent) {
        return solver_.attempt({region, std::move(candidates)}, lent, {});
      });
  for (TriangleIndex t = first_added; t < surface_.n_indices(); ++t)
    surface_.remove(t);
  for (const TriangleIndex t : off) surface_.put_back(t);
  result.freed.insert(result.freed.end(), off.begin(), off.end());
  result.chosen.insert(result.chosen.end(), on.begin(), on.end());
  return result;
}

std::optional<TriangleIndex> ForcedChanges::find(
    const LocatedTriangle& triangle) const {
  std::optional<TriangleIndex> result;
  surface_.for_each_at(triangle.corners[0], [&](TriangleIndex t) {
    if (surface_.corners(t) == triangle.corners) result = t;
  });
  return result;
}

std::vector<VertexId> ForcedChanges::ringed(
    std::span<const VertexId> vertices) {
  std::vector<VertexId> result = solver_.neighborhoods().ring(vertices);
  std::erase_if(result, [this](VertexId v) { return !surface_.is_used(v); });
  return result;
}

}  // namespace umbrella
