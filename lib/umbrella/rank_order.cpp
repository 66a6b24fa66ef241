#include "umbrella/rank_order.h"

#include <algorithm>
#include <cmath>

namespace umbrella {

bool RankOrder::is_near(double x, double y) {
  // Two that are infinite are.
  return !(std::abs(x - y) > kNearTie * std::max(x, y));
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

RankOrder::Keyed RankOrder::with_key(const RankedTriangle& triangle,
                                     std::uint32_t item) const {
  return {&triangle, exact_ ? exact_(triangle.facet) : ExactRank{}, item};
}

void RankOrder::sort(std::vector<Keyed>& keyed) const {
  std::sort(keyed.begin(), keyed.end(), [&](const Keyed& x, const Keyed& y) {
    const RankedTriangle &a = *x.triangle, &b = *y.triangle;
    const int order =
        is_near_tie(a, b) ? compare(x.exact, y.exact) : compare_ranks(a, b);
    return order != 0 ? order < 0 : a.corners < b.corners;
  });
}

}  // namespace umbrella
