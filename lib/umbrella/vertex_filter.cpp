#include <bit>
#include <utility>

#include "umbrella/vertex_filter_internal.h"

namespace umbrella {

void Choices::append(const Choices& next) {
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= next.words_[i];
  without_umbrella_.insert(without_umbrella_.end(),
                           next.without_umbrella_.begin(),
                           next.without_umbrella_.end());
}

FilterResult Choices::among(std::span<const RankedTriangle> triangles) && {
  FilterResult result;
  result.without_umbrella = std::move(without_umbrella_);
  std::size_t n = 0;
  for (const std::uint64_t word : words_)
    n += static_cast<std::size_t>(std::popcount(word));
  result.triangles.reserve(n);
  for (TriangleIndex t = 0; t < triangles.size(); ++t)
    if (holds(t)) result.triangles.push_back(triangles[t]);
  return result;
}

}  // namespace umbrella
