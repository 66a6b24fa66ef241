// A cheapest simple cycle of G_v, where a cost belongs to each pair of
// consecutive edges. Nodes of the search are directed edges ("arcs") of G_v;
// cycles are looked for from each edge in turn among the edges after it. The
// distance back to the start, by Dijkstra over arcs, ignores that a cycle must
// not meet a vertex twice, so it is a lower bound, and nearly always tight: the
// search for simple cycles by branch and bound hardly branches.
#include "umbrella/umbrella_choice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "umbrella/incidence_internal.h"
#include "umbrella/vertex_filter_internal.h"

namespace umbrella {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"first", "least-sum",
                                                    "flattest"};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Steps of the search at one vertex. All of OILPUMP, 30933 vertices, takes
/// less than 2 million with Gabriel triangles; without that restriction a
/// single vertex may take any number.
constexpr std::size_t kMostSteps = 20'000;

/// Arc 2 e runs along edge e from its first end to its second, 2 e + 1 back.
using Arc = std::uint32_t;

class CycleFinder {
 public:
  CycleFinder(std::span<const Point3> points,
              std::span<const RankedTriangle> triangles, UmbrellaChoice choice)
      : points_(points),
        triangles_(triangles),
        choice_(choice),
        is_on_path_(points.size()),
        leaving_(points.size()) {}

  /// @return the umbrella chosen, as positions in the star; empty if there is
  ///   none
  std::vector<std::uint32_t> pick(const Star& star) {
    build(star);
    best_.clear();
    best_cost_ = kInfinity;
    n_steps_ = 0;
    for (Arc e = 0; e < edges_.size(); ++e) search_from(2 * e);
    clear();
    std::vector<std::uint32_t> umbrella;
    for (const Arc arc : best_) umbrella.push_back(order_[arc / 2]);
    return umbrella;
  }

 private:
  VertexId tail(Arc a) const { return edges_[a / 2][a % 2]; }
  VertexId head(Arc a) const { return edges_[a / 2][1 - a % 2]; }

  /// Edges in the order of the triangles.
  void build(const Star& star) {
    at_ = star.vertex;
    order_.resize(star.triangles.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(
        order_, {}, [&](std::uint32_t i) { return star.triangles[i].corner; });
    edges_.clear();
    weights_.clear();
    for (const std::uint32_t i : order_) {
      const auto arc = static_cast<Arc>(2 * edges_.size());
      edges_.push_back(star.triangles[i].edge);
      weights_.push_back(triangles_[star.triangles[i].triangle()].rank.primary);
      leaving_[index(tail(arc))].push_back(arc);
      leaving_[index(head(arc))].push_back(arc + 1);
    }
  }

  void clear() {
    for (const LinkEdge& edge : edges_)
      for (const VertexId p : edge) leaving_[index(p)].clear();
  }

  /// Of going from one arc to a next one.
  double cost(Arc from, Arc to) const {
    if (choice_ == UmbrellaChoice::LeastSum) return weights_[to / 2];
    const VertexId p = head(from);
    const double cosine = side(p, tail(from)).dot(side(p, head(to)));
    return std::max(0.0, 1 + cosine);  // rounding must not make it negative
  }

  /// Unit vector from the axis v p towards q, at right angles to it.
  Point3 side(VertexId p, VertexId q) const {
    const Point3& v = points_[index(at_)];
    const Point3 axis = (points_[index(p)] - v).stableNormalized();
    const Point3 to_q = (points_[index(q)] - v).stableNormalized();
    return (to_q - axis.dot(to_q) * axis).stableNormalized();
  }

  /// Distances of all arcs after `start` back to it.
  void measure(Arc start) {
    using Entry = std::pair<double, Arc>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    to_start_.assign(2 * edges_.size(), kInfinity);
    queue.emplace(0, start);
    while (!queue.empty()) {
      const auto [distance, arc] = queue.top();
      queue.pop();
      if (distance > to_start_[arc]) continue;
      // Arcs into the tail are those that leave it, turned round.
      for (const Arc turned : leaving_[index(tail(arc))]) {
        const Arc before = turned ^ 1U;
        if (before / 2 <= start / 2 || before / 2 == arc / 2) continue;
        const double longer = distance + cost(before, arc);
        if (longer >= to_start_[before]) continue;
        to_start_[before] = longer;
        queue.emplace(longer, before);
      }
    }
  }

  /// An arc of the path, what the path costs up to it, and the arcs after it
  /// that may still be tried, the most promising last.
  struct Step {
    Arc arc;
    double cost;
    std::vector<std::pair<double, Arc>> next;
  };

  void search_from(Arc start) {
    measure(start);
    std::vector<Step> path;
    push(path, {start, 0, {}}, start);
    while (!path.empty()) {
      Step& last = path.back();
      if (last.next.empty() || ++n_steps_ > kMostSteps) {
        is_on_path_[index(head(last.arc))] = false;
        path.pop_back();
        continue;
      }
      const auto [bound, arc] = last.next.back();
      last.next.pop_back();
      const double so_far = last.cost + cost(last.arc, arc);
      if (bound >= best_cost_)
        last.next.clear();
      else if (head(arc) == tail(start))
        accept(path, arc, so_far + cost(arc, start));
      else
        push(path, {arc, so_far, {}}, start);
    }
  }

  void push(std::vector<Step>& path, Step step, Arc start) {
    is_on_path_[index(head(step.arc))] = true;
    for (const Arc arc : leaving_[index(head(step.arc))]) {
      if (arc / 2 <= start / 2 || is_on_path_[index(head(arc))]) continue;
      const double bound = step.cost + cost(step.arc, arc) + to_start_[arc];
      if (bound < best_cost_) step.next.emplace_back(bound, arc);
    }
    std::sort(step.next.begin(), step.next.end(), std::greater<>());
    path.push_back(std::move(step));
  }

  void accept(const std::vector<Step>& path, Arc last, double total) {
    if (total >= best_cost_) return;
    best_cost_ = total;
    best_.clear();
    for (const Step& step : path) best_.push_back(step.arc);
    best_.push_back(last);
  }

  std::span<const Point3> points_;
  std::span<const RankedTriangle> triangles_;
  UmbrellaChoice choice_;

  VertexId at_{};
  std::vector<std::uint32_t> order_;  // positions in the star, of edges
  std::vector<LinkEdge> edges_;
  std::vector<double> weights_;            // of edges
  std::vector<bool> is_on_path_;           // by vertex
  std::vector<std::vector<Arc>> leaving_;  // by vertex
  std::vector<double> to_start_;           // by arc

  std::vector<Arc> best_;
  double best_cost_ = kInfinity;
  std::size_t n_steps_ = 0;
};

}  // namespace

std::span<const std::string_view> umbrella_choice_names() { return kNames; }

UmbrellaChoice umbrella_choice(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
    throw std::invalid_argument("there is no choice of umbrellas '" +
                                std::string(name) + "'");
  return static_cast<UmbrellaChoice>(found - kNames.begin());
}

FilterResult umbrella_filter(std::span<const Point3> points,
                             RankedTriangles triangles, UmbrellaChoice choice,
                             unsigned threads) {
  if (choice == UmbrellaChoice::First)
    return umbrella_filter(points.size(), std::move(triangles), threads);
  return filter_by_vertex(points.size(), std::move(triangles), threads,
                          [&](const RankedTriangles& all) {
                            return CycleFinder(points, all, choice);
                          });
}

}  // namespace umbrella
