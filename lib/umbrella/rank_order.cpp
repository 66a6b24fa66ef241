#include "umbrella/rank_order.h"

#include <algorithm>
#include <cmath>

namespace umbrella {

bool RankOrder::is_near(double x, double y) {
  return std::abs(x - y) <= kNearTie * std::max(x, y);
}

bool RankOrder::is_near_tie(const Rank& a, const Rank& b) {
  const bool both_zero = a.primary == 0 && b.primary == 0;
  return both_zero ? is_near(a.secondary, b.secondary)
                   : is_near(a.primary, b.primary);
}

int RankOrder::compare_ranks(const RankedTriangle& a,
                             const RankedTriangle& b) const {
  if (is_near_tie(a, b)) return compare(exact_(a.facet), exact_(b.facet));
  return a.rank < b.rank ? -1 : b.rank < a.rank ? 1 : 0;
}

void RankOrder::sort(std::span<const RankedTriangle> triangles,
                     std::span<TriangleIndex> some) const {
  struct Item {
    TriangleIndex triangle;
    ExactRank exact;  // what is found out about it stays with it
  };
  std::vector<Item> items;
  for (const TriangleIndex t : some)
    items.push_back({t, exact_ ? exact_(triangles[t].facet) : ExactRank{}});
  std::sort(items.begin(), items.end(), [&](const Item& x, const Item& y) {
    const RankedTriangle &a = triangles[x.triangle], &b = triangles[y.triangle];
    const int order =
        is_near_tie(a, b) ? compare(x.exact, y.exact) : compare_ranks(a, b);
    return order != 0 ? order < 0 : a.corners < b.corners;
  });
  std::transform(items.begin(), items.end(), some.begin(),
                 [](const Item& item) { return item.triangle; });
}

}  // namespace umbrella
