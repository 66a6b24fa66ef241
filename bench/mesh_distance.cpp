#include "bench/mesh_distance.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace mesh_distance {
namespace {

double point_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point side = b - a;
  const double length2 = side.squaredNorm();
  const double t =
      length2 > 0 ? std::clamp((p - a).dot(side) / length2, 0.0, 1.0) : 0;
  return (p - a - t * side).norm();
}

}  // namespace

double point_to_triangle(const Point& p, const std::array<Point, 3>& abc) {
  const auto& [a, b, c] = abc;
  const Point normal = (b - a).cross(c - a);
  const auto is_left_of = [&](const Point& from, const Point& to) {
    return normal.dot((to - from).cross(p - from)) >= 0;
  };
  if (!normal.isZero() && is_left_of(a, b) && is_left_of(b, c) &&
      is_left_of(c, a))
    return std::abs(normal.normalized().dot(p - a));
  return std::min({point_to_segment(p, a, b), point_to_segment(p, b, c),
                   point_to_segment(p, c, a)});
}

Tree::Tree(std::span<const Point> points, std::span<const Corners> triangles)
    : points_(points),
      triangles_(triangles.begin(), triangles.end()),
      boxes_(2 * std::bit_ceil(triangles.size() + 1)) {
  if (!triangles_.empty()) build(0, 0, triangles_.size());
}

std::array<Point, 3> Tree::corners(std::size_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return {points_[a], points_[b], points_[c]};
}

void Tree::build(std::size_t node, std::size_t first, std::size_t last) {
  Eigen::AlignedBox3d& box = boxes_[node];
  for (std::size_t t = first; t < last; ++t)
    for (const Point& p : corners(t)) box.extend(p);
  if (last - first == 1) return;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto at = [&](const Corners& t) {
    return points_[t[0]][axis] + points_[t[1]][axis] + points_[t[2]][axis];
  };
  const std::size_t middle = first + (last - first) / 2;
  const auto begin = triangles_.begin();
  const auto place = [&](std::size_t i) {
    return begin + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(
      place(first), place(middle), place(last),
      [&](const Corners& a, const Corners& b) { return at(a) < at(b); });
  build(2 * node + 1, first, middle);
  build(2 * node + 2, middle, last);
}

void Tree::search(std::size_t node, std::size_t first, std::size_t last,
                  const Point& p, double& nearest) const {
  if (last - first == 1) {
    nearest = std::min(nearest, point_to_triangle(p, corners(first)));
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const std::array<std::size_t, 2> child = {2 * node + 1, 2 * node + 2};
  const std::array<double, 2> away = {boxes_[child[0]].exteriorDistance(p),
                                      boxes_[child[1]].exteriorDistance(p)};
  const std::size_t near = away[0] <= away[1] ? 0 : 1;
  for (const std::size_t i : {near, 1 - near}) {
    if (away[i] >= nearest) continue;
    search(child[i], i == 0 ? first : middle, i == 0 ? middle : last, p,
           nearest);
  }
}

double Tree::distance(const Point& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (!triangles_.empty()) search(0, 0, triangles_.size(), p, nearest);
  return nearest;
}

}  // namespace mesh_distance
