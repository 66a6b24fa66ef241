#include <algorithm>
#include <cassert>

#include "umbrella/curve_descent_internal.h"

// As in [Lin73]: along a trail the costs of the links dropped have to outweigh
// those added at every point, which loses nothing, for any closed trail that
// pays can be begun so. All trails of at most kAdds additions are tried.

namespace umbrella {
namespace {

// Six found no more than four on coastlines of the 1:50 million map.
constexpr unsigned kAdds = 4;

// Trails from one vertex are given up after so many steps: points that are no
// curve would take exponentially many in kAdds.
constexpr unsigned kMostSteps = 4000;

}  // namespace

bool CurveDescent::has_step(VertexId v, VertexId w) const {
  return std::ranges::any_of(trail_, [&](const Step& step) {
    return (step.v == v && step.w == w) || (step.v == w && step.w == v);
  });
}

void CurveDescent::make(const Step& step) {
  trail_.push_back(step);
  if (step.is_add)
    links_.add(step.v, step.w);
  else
    links_.drop(step.v, step.w);
}

void CurveDescent::unmake() {
  const Step step = trail_.back();
  trail_.pop_back();
  if (step.is_add)
    links_.drop(step.v, step.w);
  else
    links_.add(step.v, step.w);
}

/// What rounding may have made up in the change by this trail.
double CurveDescent::rounding() const {
  double largest = 0;
  for (const Step& step : trail_)
    largest = std::max({largest, step.cost, price_(step.v), price_(step.w)});
  return 1e-12 * largest;
}

void CurveDescent::keep_if_better(double change) {
  if (change >= best_change_ || change >= best_change_ - rounding()) return;
  best_change_ = change;
  best_ = trail_;
}

/// Goes on at v, which has a free place.
/// @param change  of the cost, if the trail ends here
/// @param gain    cost of the links dropped, less that of those added
void CurveDescent::follow(VertexId v, double change, double gain,
                          unsigned depth) {
  keep_if_better(change);
  if (depth == 0 || ++n_steps_ > kMostSteps) return;
  for (const CurveGraph::Arc& arc : graph_.arcs(v)) {
    if (arc.cost >= gain) break;
    if (!links_.has(v, arc.to) && !has_step(v, arc.to))
      take(v, arc, change, gain, depth);
  }
}

/// Links v to the end of the arc, which may have to drop a link for it.
void CurveDescent::take(VertexId v, const CurveGraph::Arc& arc, double change,
                        double gain, unsigned depth) {
  const VertexId w = arc.to;
  const double added = change + arc.cost - price_(v);
  if (!links_.is_full(w)) {
    make({v, w, arc.cost, true});
    keep_if_better(added - price_(w));
    unmake();
    return;
  }
  const std::array<VertexId, 2> old = links_[w];
  for (const VertexId x : old) {
    if (has_step(w, x)) continue;
    const double dropped = graph_.arc(w, x)->cost;
    make({w, x, dropped, false});
    make({v, w, arc.cost, true});
    follow(x, added - dropped + price_(x), gain - arc.cost + dropped,
           depth - 1);
    unmake();
    unmake();
  }
}

bool CurveDescent::improve(VertexId v) {
  assert(trail_.empty());
  best_change_ = 0;
  best_.clear();
  n_steps_ = 0;
  if (!links_.is_full(v)) follow(v, 0, price_(v), kAdds);
  const std::array<VertexId, 2> old = links_[v];
  for (const VertexId w : old) {
    if (w == CurveLinks::kNone) continue;
    const double dropped = graph_.arc(v, w)->cost;
    const double change = price_(v) + price_(w) - dropped;
    make({v, w, dropped, false});
    follow(w, change, dropped, kAdds);
    follow(v, change, dropped, kAdds);
    unmake();
  }
  // In order: an addition may need the place that a step before it has freed.
  for (const Step& step : best_) {
    if (step.is_add)
      links_.add(step.v, step.w);
    else
      links_.drop(step.v, step.w);
    changed_.insert(changed_.end(), {step.v, step.w});
  }
  return !best_.empty();
}

void CurveDescent::run(std::vector<VertexId> queue) {
  std::vector<bool> is_queued(links_.n_vertices());
  for (const VertexId v : queue) is_queued[index(v)] = true;
  const auto push = [&](VertexId v) {
    if (!is_queued[index(v)]) queue.push_back(v);
    is_queued[index(v)] = true;
  };
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const VertexId v = queue[i];
    is_queued[index(v)] = false;
    while (improve(v)) {
      ++n_moves_;
      for (const Step& step : best_) {
        for (const VertexId end : {step.v, step.w}) {
          push(end);
          for (const CurveGraph::Arc& arc : graph_.arcs(end)) push(arc.to);
        }
      }
    }
  }
}

}  // namespace umbrella
