#include <algorithm>
#include <numeric>
#include <utility>

#include "umbrella/sort_unique_internal.h"
#include "umbrella/vertex_filter_internal.h"

namespace umbrella {

void Choices::append(const Choices& next) {
  for (std::size_t i = 0; i < is_chosen_.size(); ++i)
    is_chosen_[i] |= next.is_chosen_[i];
  without_umbrella_.insert(without_umbrella_.end(),
                           next.without_umbrella_.begin(),
                           next.without_umbrella_.end());
}

// In place: a new array of that size would cost as much as the choice.
FilterResult Choices::among(RankedTriangles all) && {
  FilterResult result;
  const RankOrder order = all.order();
  std::vector<RankedTriangle> triangles = std::move(all).list();
  std::vector<VertexId>& unsettled = result.unsettled.emplace();
  auto kept = triangles.begin();
  const std::uint8_t* by = is_chosen_.data();
  for (const RankedTriangle& t : triangles) {
    const int is_kept = by[0] | by[1] | by[2];
    // Copied always, kept or not: which it is, no processor can guess.
    *kept = t;
    kept += is_kept;
    if (is_kept != (by[0] & by[1] & by[2]))
      for (unsigned i = 0; i < 3; ++i)
        if (by[i] == 0) unsettled.push_back(t.corners[i]);
    by += 3;
  }
  triangles.erase(kept, triangles.end());
  unsettled.insert(unsettled.end(), without_umbrella_.begin(),
                   without_umbrella_.end());
  sort_unique(unsettled);
  result.triangles = RankedTriangles(std::move(triangles), order);
  result.without_umbrella = std::move(without_umbrella_);
  return result;
}

std::vector<TriangleIndex> by_first_corners(
    std::span<const RankedTriangle> triangles) {
  std::vector<TriangleIndex> order(triangles.size());
  std::iota(order.begin(), order.end(), TriangleIndex{0});
  std::ranges::sort(order, {}, [&](TriangleIndex t) {
    return std::pair(triangles[t].corners[0], t);
  });
  return order;
}

}  // namespace umbrella
