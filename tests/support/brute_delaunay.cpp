#include "tests/support/brute_delaunay.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "predicates/predicates.h"

namespace tests {
namespace {

using delaunay::index;
using delaunay::Point2;
using delaunay::Point3;
using delaunay::Triangulation2;
using delaunay::Triangulation3;
using delaunay::VertexId;
using Corners = std::vector<VertexId>;

int orientation(std::span<const Point2> p, const Corners& v) {
  return predicates::orient2d(p[index(v[0])].data(), p[index(v[1])].data(),
                              p[index(v[2])].data());
}
int orientation(std::span<const Point3> p, const Corners& v) {
  return predicates::orient3d(p[index(v[0])].data(), p[index(v[1])].data(),
                              p[index(v[2])].data(), p[index(v[3])].data());
}
bool in_ball(std::span<const Point2> p, const Corners& v, std::size_t q) {
  return predicates::incircle_perturbed(p[index(v[0])].data(),
                                        p[index(v[1])].data(),
                                        p[index(v[2])].data(), p[q].data()) > 0;
}
bool in_ball(std::span<const Point3> p, const Corners& v, std::size_t q) {
  return predicates::insphere_perturbed(
             p[index(v[0])].data(), p[index(v[1])].data(),
             p[index(v[2])].data(), p[index(v[3])].data(), p[q].data()) > 0;
}

template <class Point>
bool is_empty(std::span<const Point> points, const Corners& cell) {
  for (std::size_t q = 0; q < points.size(); ++q) {
    const bool is_corner = std::ranges::find(cell, VertexId(q)) != cell.end();
    if (!is_corner && in_ball(points, cell, q)) return false;
  }
  return true;
}

// The next subset of {0 .. n-1} of its size, in lexicographic order.
bool next_subset(Corners& subset, std::size_t n) {
  for (std::size_t i = subset.size(); i-- > 0;) {
    if (index(subset[i]) + subset.size() - i == n) continue;
    auto next = static_cast<std::uint32_t>(index(subset[i]));
    for (; i < subset.size(); ++i) subset[i] = VertexId{++next};
    return true;
  }
  return false;
}

template <class Point>
std::vector<Corners> cells_by_definition(std::span<const Point> points) {
  Corners subset;
  for (std::uint32_t i = 0; i <= Point::RowsAtCompileTime; ++i)
    subset.push_back(VertexId{i});
  std::vector<Corners> cells;
  if (points.size() < subset.size()) return cells;
  do {
    Corners positive = subset;
    const int sign = orientation(points, positive);
    if (sign == 0) continue;
    if (sign < 0) std::swap(positive[0], positive[1]);
    if (is_empty(points, positive)) cells.push_back(subset);
  } while (next_subset(subset, points.size()));
  return cells;
}

template <class Triangulation>
std::string full_ball(const Triangulation& t) {
  for (std::size_t c = 0; c < t.n_finite_cells(); ++c) {
    const auto& v = t.cells()[c].vertex;
    if (!is_empty(t.points(), Corners(v.begin(), v.end())))
      return "the ball of cell " + std::to_string(c) + " is not empty";
  }
  return {};
}

template <class Triangulation>
std::vector<Corners> cells_in_order(const Triangulation& t) {
  std::vector<Corners> cells;
  for (const auto& cell : t.cells().first(t.n_finite_cells())) {
    cells.emplace_back(cell.vertex.begin(), cell.vertex.end());
    std::ranges::sort(cells.back());
  }
  std::ranges::sort(cells);
  return cells;
}

}  // namespace

std::string first_full_ball(const Triangulation2& t) { return full_ball(t); }
std::string first_full_ball(const Triangulation3& t) { return full_ball(t); }

std::vector<Corners> brute_force_cells(std::span<const Point2> points) {
  return cells_by_definition(points);
}
std::vector<Corners> brute_force_cells(std::span<const Point3> points) {
  return cells_by_definition(points);
}

std::vector<Corners> sorted_cells(const Triangulation2& t) {
  return cells_in_order(t);
}
std::vector<Corners> sorted_cells(const Triangulation3& t) {
  return cells_in_order(t);
}

}  // namespace tests
