#include <bit>
#include <utility>

#include "umbrella/vertex_filter_internal.h"

namespace umbrella {

void Choices::append(const Choices& next) {
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= next.words_[i];
  size_.insert(size_.end(), next.size_.begin(), next.size_.end());
  without_umbrella_.insert(without_umbrella_.end(),
                           next.without_umbrella_.begin(),
                           next.without_umbrella_.end());
}

FilterResult Choices::among(const RankedTriangles& triangles) && {
  FilterResult result;
  result.without_umbrella = std::move(without_umbrella_);
  std::size_t n = 0;
  for (const std::uint64_t word : words_)
    n += static_cast<std::size_t>(std::popcount(word));
  std::vector<RankedTriangle> chosen;
  chosen.reserve(n);
  std::vector<std::uint32_t> degree(size_.size());
  for (TriangleIndex t = 0; t < triangles.size(); ++t) {
    if (!holds(t)) continue;
    chosen.push_back(triangles[t]);
    for (const VertexId v : triangles[t].corners) ++degree[index(v)];
  }
  result.triangles = RankedTriangles(std::move(chosen), triangles.order());
  // An umbrella's triangles are all here: as many are no others.
  std::vector<VertexId>& unsettled = result.unsettled.emplace();
  for (std::uint32_t v = 0; v < size_.size(); ++v)
    if (size_[v] == 0 || degree[v] != size_[v])
      unsettled.push_back(VertexId{v});
  return result;
}

}  // namespace umbrella
