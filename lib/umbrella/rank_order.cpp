#include "umbrella/rank_order.h"

#include <algorithm>
#include <cmath>

namespace umbrella {

namespace {

int compare_rounded(const Rank& a, const Rank& b) {
  return a < b ? -1 : b < a ? 1 : 0;
}

}  // namespace

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
  return is_near_tie(a, b) ? compare(exact_(a.facet), exact_(b.facet))
                           : compare_rounded(a.rank, b.rank);
}

RankOrder::Keyed RankOrder::with_key(const RankedTriangle& triangle,
                                     std::uint32_t item) const {
  return {&triangle, exact_ ? exact_(triangle.facet) : ExactRank{}, item};
}

void RankOrder::sort(std::vector<Keyed>& keyed) const {
  std::sort(keyed.begin(), keyed.end(), [&](const Keyed& x, const Keyed& y) {
    const RankedTriangle &a = *x.triangle, &b = *y.triangle;
    const int order = is_near_tie(a, b) ? compare(x.exact, y.exact)
                                        : compare_rounded(a.rank, b.rank);
    return order != 0 ? order < 0 : a.corners < b.corners;
  });
}

}  // namespace umbrella
