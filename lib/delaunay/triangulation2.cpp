/// @file
/// Bowyer-Watson insertion [Bowyer81; Watson81] along the rounds of
/// insertion_order(). A cavity is a disc without inner vertices, so its
/// triangles form a tree: a walk around it in one sense meets each triangle
/// and each boundary edge once, needs no marks, and links every new triangle to
/// the one before. k triangles die and k + 2 are born, so that cells are an
/// exact array without holes at all times.
///
/// All coordinates are taken relative to the point to insert; a triangle
/// entered across an edge then costs one vertex fetch and a 3 x 3 determinant.
/// What its error bound leaves open goes to the exact predicates.
#include "delaunay/triangulation2.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "delaunay/spatial_sort.h"
#include "predicates/predicates.h"

namespace delaunay {
namespace {

constexpr std::array<unsigned, 3> kNext = {1, 2, 0};
constexpr std::array<unsigned, 3> kPrevious = {2, 0, 1};

/// A vertex as seen from the point being inserted.
struct Corner {
  double x = 0;
  double y = 0;
  double n2 = 0;  ///< squared distance
  VertexId id = kInfinite;
};

double cross(const Corner& a, const Corner& b) { return a.x * b.y - a.y * b.x; }

// u = 2^-53 throughout. Differences, squares and their sum leave n2 with a
// relative error of 4u, and cross(a, b) with 4u |a||b| since |ax by| + |ay bx|
// <= |a||b|; with one more product and two sums the determinant
// a.n2 cross(b, c) + ... is off by at most 11u |a||b||c| (|a| + |b| + |c|) to
// first order, and 2 |a||b| <= |a|^2 + |b|^2 turns that into 11u (a.n2 b.n2 +
// ...). 14u covers higher orders and the rounding of the bound itself.
constexpr double kCircleError = 0x1p-53 * 14;
// Likewise 4u (|ax by| + |ay bx|).
constexpr double kSideError = 0x1p-53 * 5;

// Both bounds hold up to underflow: a few 2^-1074 in a cross product, times
// squared distances. With coordinates below 2^64 that stays below 2^-900.
constexpr double kUnderflow = 0x1p-900;
constexpr int kMaxExponent = 64;

/// Coordinates in a range where the bounds hold, or a note that there is none.
class Coordinates {
 public:
  /// Keeps a view of `points`; copies them only if they have to be scaled.
  explicit Coordinates(std::span<const Point2> points) : view_(points) {
    double largest = 0;
    for (const Point2& p : points)
      largest = std::max({largest, std::abs(p.x()), std::abs(p.y())});
    const int exponent = largest > 0 ? std::ilogb(largest) + 1 : 0;
    if (std::abs(exponent) <= kMaxExponent) return;
    if (!scale(-exponent)) slack_ = std::numeric_limits<double>::infinity();
  }
  Coordinates(const Coordinates&) = delete;
  Coordinates& operator=(const Coordinates&) = delete;

  const Point2& operator[](VertexId v) const { return view_[index(v)]; }
  /// To be added to each error bound; infinite if no bound holds.
  double slack() const { return slack_; }

 private:
  // By a power of two, if no bit is lost: no predicate changes.
  bool scale(int exponent) {
    scaled_.reserve(view_.size());
    for (const Point2& p : view_) {
      const Point2 q(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent));
      if (std::ldexp(q.x(), -exponent) != p.x() ||
          std::ldexp(q.y(), -exponent) != p.y()) {
        return false;
      }
      scaled_.push_back(q);
    }
    view_ = scaled_;
    return true;
  }

  std::vector<Point2> scaled_;
  std::span<const Point2> view_;
  double slack_ = kUnderflow;
};

class Builder {
 public:
  /// Starts with the positive or negative triangle abc.
  Builder(std::span<const Point2> points, const std::array<VertexId, 3>& abc);
  void insert(VertexId v);
  /// Moves the cells beyond the hull to the end, and hands all over.
  std::pair<LazyVector<Cell2>, std::size_t> finish();

 private:
  /// A triangle in conflict with the point: apex d, other corners a and b,
  /// counter-clockwise.
  struct Root {
    CellId cell;
    unsigned apex;
    Corner a, b, d;
  };
  /// An edge of the cavity, from the end of the edge before to b.
  struct Edge {
    Corner b;
    Side outside;
  };

  Cell2& cell(CellId c) { return cells_[index(c)]; }
  const Cell2& cell(CellId c) const { return cells_[index(c)]; }
  Side& across(Side s) { return cell(s.cell()).neighbor[s.index()]; }
  void link(Side s, Side t) {
    across(s) = t;
    across(t) = s;
  }

  Corner corner(VertexId v) const;
  bool right_of(const Corner& a, const Corner& b) const;
  bool in_circle(const Corner& a, const Corner& b, const Corner& c) const;
  bool beyond_hull(const Cell2& cell) const;

  void step_across(Root& root, unsigned side) const;
  Root locate() const;
  void dig(const Root& root);
  void add_cell(const Corner& a, const Edge& edge);
  void swap_cells(CellId i, CellId j);

  Coordinates coordinates_;
  LazyVector<Cell2> cells_;
  VertexId v_ = kInfinite;  // the point being inserted
  Point2 p_;                // and where it is
  CellId last_{0};          // finite; where the next walk starts

  // Of one insertion; members to keep their memory.
  std::vector<Edge> edges_;   // of the cavity, yet to visit, next one last
  std::vector<CellId> free_;  // cells to reuse
  Side first_, previous_;     // open sides of the new cells so far
  bool is_first_ = true;
};

Builder::Builder(std::span<const Point2> points,
                 const std::array<VertexId, 3>& abc)
    : coordinates_(points) {
  cells_.reserve(2 * points.size() - 2);
  auto [a, b, c] = abc;
  const int sign = predicates::orient2d(
      coordinates_[a].data(), coordinates_[b].data(), coordinates_[c].data());
  assert(sign != 0);
  if (sign < 0) std::swap(b, c);
  for (const auto& v :
       {std::array{a, b, c}, std::array{c, b, kInfinite},
        std::array{a, c, kInfinite}, std::array{b, a, kInfinite}})
    cells_.push_back({v, {}});
  for (unsigned i = 0; i < 3; ++i) {
    link(Side(CellId{0}, i), Side(CellId{i + 1}, 2));
    // Around the corner that hull edges i and i + 1 share.
    link(Side(CellId{i + 1}, 1), Side(CellId{kNext[i] + 1}, 0));
  }
}

Corner Builder::corner(VertexId v) const {
  if (v == kInfinite) return {};
  const Point2& q = coordinates_[v];
  const double x = q.x() - p_.x();
  const double y = q.y() - p_.y();
  return {x, y, x * x + y * y, v};
}

// Sign of orient2d(a, b, p) < 0.
bool Builder::right_of(const Corner& a, const Corner& b) const {
  const double left = a.x * b.y;
  const double right = a.y * b.x;
  const double sign = left - right;
  const double error =
      kSideError * (std::abs(left) + std::abs(right)) + coordinates_.slack();
  if (sign > error) return false;
  if (sign < -error) return true;
  return predicates::orient2d(coordinates_[a.id].data(),
                              coordinates_[b.id].data(), p_.data()) < 0;
}

// The sign of predicates::incircle_perturbed(a, b, c, p) > 0.
bool Builder::in_circle(const Corner& a, const Corner& b,
                        const Corner& c) const {
  const double sign =
      a.n2 * cross(b, c) + b.n2 * cross(c, a) + c.n2 * cross(a, b);
  const double error =
      kCircleError * (a.n2 * b.n2 + b.n2 * c.n2 + c.n2 * a.n2) +
      coordinates_.slack();
  if (sign > error) return true;
  if (sign < -error) return false;
  return predicates::incircle_perturbed(
             coordinates_[a.id].data(), coordinates_[b.id].data(),
             coordinates_[c.id].data(), p_.data()) > 0;
}

// The circle through a hull edge and infinity is the open half-plane beyond
// it, and of its line the edge alone: the limit of the perturbed circle.
bool Builder::beyond_hull(const Cell2& cell) const {
  const Point2& a = coordinates_[cell.vertex[0]];
  const Point2& b = coordinates_[cell.vertex[1]];
  const int side = predicates::orient2d(a.data(), b.data(), p_.data());
  if (side != 0) return side > 0;
  const auto rank = [](const Point2& q) { return std::pair(q.x(), q.y()); };
  return (rank(a) < rank(p_)) == (rank(p_) < rank(b));
}

/// Enters the triangle across a side of root.
void Builder::step_across(Root& root, unsigned side) const {
  if (side == kNext[root.apex])
    root.a = std::exchange(root.b, root.d);  // (b, d)
  else if (side == kPrevious[root.apex])
    root.b = std::exchange(root.a, root.d);  // (d, a)
  const Side entry = cell(root.cell).neighbor[side];
  std::swap(root.a, root.b);
  root.cell = entry.cell();
  root.apex = entry.index();
  root.d = corner(cell(root.cell).vertex[root.apex]);
}

/// Walks towards the point [Devillers02]; every step leaves the circle's
/// power of the point smaller, so that the walk ends.
Builder::Root Builder::locate() const {
  const auto& start = cell(last_).vertex;
  Root root = {last_, 2, corner(start[0]), corner(start[1]), corner(start[2])};
  if (right_of(root.a, root.b)) step_across(root, root.apex);
  while (root.d.id != kInfinite) {
    if (right_of(root.b, root.d))
      step_across(root, kNext[root.apex]);
    else if (right_of(root.d, root.a))
      step_across(root, kPrevious[root.apex]);
    else
      break;
  }
  return root;
}

/// The new triangle on a boundary edge from a; linked to its neighbours but
/// the one that follows.
void Builder::add_cell(const Corner& a, const Edge& edge) {
  const CellId id = free_.back();
  free_.pop_back();

  // Corners in the order a, b, v, turned so that kInfinite comes last.
  unsigned at_a = 0;
  if (a.id == kInfinite) at_a = 2;
  if (edge.b.id == kInfinite) at_a = 1;
  const unsigned at_b = kNext[at_a];
  const unsigned at_v = kNext[at_b];

  Cell2& fresh = cell(id);
  fresh.vertex[at_a] = a.id;
  fresh.vertex[at_b] = edge.b.id;
  fresh.vertex[at_v] = v_;
  link(Side(id, at_v), edge.outside);
  if (is_first_)
    first_ = Side(id, at_b);
  else
    link(Side(id, at_b), previous_);
  is_first_ = false;
  previous_ = Side(id, at_a);
  if (at_a == 0) last_ = id;
}

/// Replaces the cavity around root by the star of v_.
void Builder::dig(const Root& root) {
  const auto born = static_cast<std::uint32_t>(cells_.size());
  cells_.resize(cells_.size() + 2);
  free_.clear();
  for (const CellId id : {CellId{born + 1}, CellId{born}, root.cell})
    free_.push_back(id);
  is_first_ = true;

  const auto& outside = cell(root.cell).neighbor;
  edges_.clear();
  edges_.push_back({root.a, outside[kPrevious[root.apex]]});
  edges_.push_back({root.d, outside[kNext[root.apex]]});
  edges_.push_back({root.b, outside[root.apex]});
  Corner a = root.a;
  while (!edges_.empty()) {
    Edge& edge = edges_.back();
    const CellId id = edge.outside.cell();
    const unsigned i = edge.outside.index();
    const Cell2& beyond = cell(id);
    const Corner d = corner(beyond.vertex[i]);
    const bool dies =
        beyond.is_infinite() ? beyond_hull(beyond) : in_circle(edge.b, a, d);
    if (dies) {  // its two other edges take the place of this one
      edge.outside = beyond.neighbor[kPrevious[i]];
      edges_.push_back({d, beyond.neighbor[kNext[i]]});
      free_.push_back(id);
    } else {
      add_cell(a, edge);
      a = edge.b;
      edges_.pop_back();
    }
  }
  link(first_, previous_);
}

void Builder::insert(VertexId v) {
  v_ = v;
  p_ = coordinates_[v];
  dig(locate());
}

void Builder::swap_cells(CellId i, CellId j) {
  std::swap(cell(i), cell(j));
  for (const auto& [here, there] : {std::pair(i, j), std::pair(j, i)}) {
    for (unsigned k = 0; k < 3; ++k) {
      Side& s = cell(here).neighbor[k];
      if (s.cell() == here)  // they were neighbours
        s = Side(there, s.index());
      else
        across(s) = Side(here, k);
    }
  }
}

std::pair<LazyVector<Cell2>, std::size_t> Builder::finish() {
  std::uint32_t low = 0;
  auto high = static_cast<std::uint32_t>(cells_.size());
  while (true) {
    while (low < high && !cells_[low].is_infinite()) ++low;
    while (low < high && cells_[high - 1].is_infinite()) --high;
    if (low == high) break;
    swap_cells(CellId{low++}, CellId{--high});
  }
  return {std::move(cells_), low};
}

/// Brings a third point that is not collinear with the first two to their
/// side; false if there is none.
bool start_with_triangle(std::span<const Point2> points,
                         std::vector<VertexId>& order) {
  if (order.size() < 3) return false;
  const double* a = points[index(order[0])].data();
  const double* b = points[index(order[1])].data();
  const auto third =
      std::find_if(order.begin() + 2, order.end(), [&](VertexId v) {
        return predicates::orient2d(a, b, points[index(v)].data()) != 0;
      });
  if (third == order.end()) return false;
  std::rotate(order.begin() + 2, third, third + 1);
  return true;
}

}  // namespace

Triangulation2::Triangulation2(std::span<const Point2> points) {
  if (points.size() > max_points())
    throw std::invalid_argument("too many points: " +
                                std::to_string(points.size()));
  auto [distinct, vertex_of_row] = spatial_order(points);
  points_ = std::move(distinct);
  vertex_of_row_ = std::move(vertex_of_row);

  std::vector<VertexId> order = insertion_order(points_.size());
  if (!start_with_triangle(points_, order)) {
    dimension_ = std::min(static_cast<int>(points_.size()), 2) - 1;
    return;
  }
  dimension_ = 2;
  Builder builder(points_, {order[0], order[1], order[2]});
  for (std::size_t i = 3; i < order.size(); ++i) builder.insert(order[i]);
  std::tie(cells_, n_finite_cells_) = builder.finish();
}

}  // namespace delaunay
