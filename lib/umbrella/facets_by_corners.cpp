#include "umbrella/facets_by_corners.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace umbrella {

FacetsByCorners::FacetsByCorners(std::size_t n_vertices, FacetList facets)
    : facets_(std::move(facets)),
      first_(n_vertices + 1),
      by_lowest_(facets_.size()) {
  for (const FacetPoints& f : facets_) ++first_[index(f.triangle.corners[0])];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  for (std::uint32_t i = 0; i < facets_.size(); ++i)
    by_lowest_[--first_[index(facets_[i].triangle.corners[0])]] = i;
}

std::span<const FacetPoints> FacetsByCorners::Walk::next() {
  constexpr std::size_t kEnough = 128;  // more would not stay in the cache
  block_.clear();
  for (; lowest_.size() > 0 && block_.size() < kEnough; ++lowest_.begin)
    append(lowest_.begin);
  return block_;
}

void FacetsByCorners::Walk::append(std::size_t lowest) {
  const FacetList& facets = all_->facets_;
  const auto& first = all_->first_;
  const auto& by_lowest = all_->by_lowest_;
  constexpr std::size_t kAhead = 32;
  keyed_.clear();
  const std::size_t last = by_lowest.size() - 1;
  for (std::size_t k = first[lowest]; k < first[lowest + 1]; ++k) {
    __builtin_prefetch(&facets[by_lowest[std::min(k + kAhead, last)]]);
    const std::uint32_t position = by_lowest[k];
    const Triangle& t = facets[position].triangle.corners;
    keyed_.push_back(
        {std::uint64_t{index(t[1])} << 32U | index(t[2]), position});
  }
  sort_keyed();
  for (const Keyed& k : keyed_) block_.push_back(facets[k.position]);
}

/// Keys are distinct. Puts each of a few where as many go before it as have
/// smaller keys: more comparisons than sorting takes, but no jump to guess.
void FacetsByCorners::Walk::sort_keyed() {
  constexpr std::size_t kFew = 24;
  if (keyed_.size() > kFew)
    return std::sort(
        keyed_.begin(), keyed_.end(),
        [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  scratch_.resize(keyed_.size());
  for (const Keyed& item : keyed_) {
    std::size_t n_before = 0;
    for (const Keyed& other : keyed_) n_before += other.key < item.key ? 1 : 0;
    scratch_[n_before] = item;
  }
  keyed_.swap(scratch_);
}

}  // namespace umbrella
