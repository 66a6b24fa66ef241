#include <algorithm>
#include <utility>

#include "umbrella/star_sweep_internal.h"

namespace umbrella {

inline void StarSweep::await(TriangleIndex t) {
  await_at(triangles_[t].corners[1], 2 * t);
  await_at(triangles_[t].corners[2], 2 * t + 1);
}

inline void StarSweep::await_at(VertexId v, std::uint32_t link) {
  const std::size_t i = index(v) - begin_;
  if (i < first_link_.size())  // not so where it is below the range
    next_link_[link] = std::exchange(first_link_[i], link);
}

StarSweep::StarSweep(std::span<const RankedTriangle> triangles,
                     std::span<const TriangleIndex> order, IndexRange vertices)
    : triangles_(triangles),
      order_(order),
      begin_(vertices.begin),
      at_(vertices.begin),
      end_(vertices.end),
      first_link_(vertices.size(), kNone),
      next_link_(2 * triangles.size()) {
  reserve(2 * Star::kPadding);
  for (; has_lower_than(begin_); ++next_) await(triangle(next_));
}

Star StarSweep::next() {
  const VertexId v{static_cast<std::uint32_t>(at_++)};
  std::size_t n = 0;
  std::uint32_t odd = 0;
  const auto append = [&](std::uint32_t corner, const RankedTriangle& t,
                          const LinkEdge& edge) {
    if (n == room_) reserve(2 * n);
    star_[n] = {corner, edge};
    for (const VertexId end : edge) odd ^= static_cast<std::uint32_t>(end);
    keys_[n++] = static_cast<float>(t.rank.primary);
  };
  for (std::uint32_t link = first_link_[index(v) - begin_]; link != kNone;
       link = next_link_[link]) {
    const TriangleIndex t = link / 2;
    const Triangle& corners = triangles_[t].corners;
    append(link + t + 1, triangles_[t], {corners[0], corners[2 - link % 2]});
  }
  for (; next_ < triangles_.size(); ++next_) {
    const TriangleIndex t = triangle(next_);
    const auto& [a, b, c] = triangles_[t].corners;
    if (a != v) break;
    append(3 * t, triangles_[t], {b, c});
    await(t);
  }
  std::fill_n(&keys_[n], Star::kPadding, Star::kNoKey);
  return {v, std::span(star_).first(n), std::span(keys_).first(n), odd};
}

void StarSweep::reserve(std::size_t n) {
  room_ = n;
  star_.resize(n);
  keys_.resize(n + Star::kPadding);
}

}  // namespace umbrella
