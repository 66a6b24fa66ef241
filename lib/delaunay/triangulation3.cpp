/// @file
/// Orders the points, deals with inputs that do not span space, and inserts
/// them in rounds (bowyer_watson3.cpp).
#include "delaunay/triangulation3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "delaunay/parallel_insertion_internal.h"
#include "delaunay/spatial_sort.h"
#include "predicates/predicates.h"

namespace delaunay {
namespace {

/// Vertices that span the affine hull of the points, at most four.
struct Frame {
  std::array<VertexId, 4> vertex;
  int size = 0;
};

bool are_collinear(const Point3& a, const Point3& b, const Point3& c) {
  // Collinear in space is collinear in the three coordinate planes.
  for (int drop = 0; drop < 3; ++drop) {
    const auto plane = [drop](const Point3& p) {
      return std::array<double, 2>{p[drop == 0 ? 1 : 0], p[drop == 2 ? 1 : 2]};
    };
    const auto u = plane(a);
    const auto v = plane(b);
    const auto w = plane(c);
    if (predicates::orient2d(u.data(), v.data(), w.data()) != 0) return false;
  }
  return true;
}

Frame find_frame(std::span<const Point3> points) {
  Frame frame;
  const auto at = [&](int i) -> const Point3& {
    return points[index(frame.vertex[i])];
  };
  for (std::uint32_t i = 0; i < points.size() && frame.size < 4; ++i) {
    const Point3& p = points[i];
    const bool extends =
        frame.size < 2 ||
        (frame.size == 2 && !are_collinear(at(0), at(1), p)) ||
        (frame.size == 3 && predicates::orient3d(at(0).data(), at(1).data(),
                                                 at(2).data(), p.data()) != 0);
    if (extends) frame.vertex[frame.size++] = VertexId{i};
  }
  return frame;
}

/// Exponent e such that the points times 2^e fill [-1, 1] and keep every bit;
/// 0 when there is none.
int scaling_exponent(std::span<const Point3> points) {
  double largest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Point3& p : points)
    for (const double x : p) {
      largest = std::max(largest, std::abs(x));
      if (x != 0) smallest = std::min(smallest, std::abs(x));
    }
  const int e = -(std::ilogb(largest) + 1);
  // 53 significant bits from here down stay normal or exactly representable.
  return std::ilogb(smallest) + e >= -900 ? e : 0;
}

/// Exact, by the choice of the exponent.
void scale(LazyVector<Point3>& points, int exponent) {
  if (exponent == 0) return;
  // In two steps, for 2^1074 is no double.
  const double first = std::ldexp(1, exponent / 2);
  const double second = std::ldexp(1, exponent - exponent / 2);
  for (Point3& p : points)
    for (double& x : p) x = x * first * second;
}

LazyVector<Point3> points_of_vertices(std::size_t n,
                                      std::span<const Point3> rows,
                                      std::span<const VertexId> vertex_of_row) {
  LazyVector<Point3> points(n);
  for (std::size_t row = 0; row < rows.size(); ++row)
    points[index(vertex_of_row[row])] = rows[row] + Point3::Zero();  // no -0
  return points;
}

}  // namespace

Triangulation3::Triangulation3(std::span<const Point3> points,
                               unsigned threads) {
  if (points.size() > max_points())
    throw std::invalid_argument(
        std::to_string(points.size()) + " points; at most " +
        std::to_string(max_points()) + " can be triangulated");
  auto [distinct, vertex_of_row] = spatial_order(points, threads);
  points_ = std::move(distinct);
  vertex_of_row_ = std::move(vertex_of_row);
  const Frame frame = find_frame(points_);
  dimension_ = frame.size - 1;
  if (dimension_ < 3) return;

  // The mesh has its own copy of the points, so none is kept beside it.
  const std::size_t n = points_.size();
  const int exponent = scaling_exponent(points_);
  scale(points_, exponent);
  scale_exponent_ = -exponent;
  InsertionOptions options;
  options.threads = static_cast<unsigned>(std::clamp<std::size_t>(
      n / options.min_vertices, 1,
      std::clamp(threads, 1U, InsertionOptions::kMaxThreads)));
  {
    Mesh3 mesh(std::exchange(points_, {}), options.threads);
    n_finite_cells_ = insert_all(mesh, frame.vertex, options);
    cells_ = std::move(mesh.cells);
    counters_ = mesh.counters;
  }
  points_ = points_of_vertices(n, points, vertex_of_row_);
}

}  // namespace delaunay
