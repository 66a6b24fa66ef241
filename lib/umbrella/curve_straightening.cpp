#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

#include "umbrella/curve_straightening_internal.h"

// The trails are those of curve_descent, but closed, and only such as leave one
// curve. The edges dropped have to outweigh those added, as in [Lin73], but for
// the last, for what the corners cost is only known then.

namespace umbrella {
namespace {

using delaunay::Point2;

constexpr auto kNowhere = std::numeric_limits<std::uint32_t>::max();

// docs/curve.md "Straightening": what chose these three.
constexpr double kCornerPrice = 1.5;
constexpr unsigned kDrops = 5;
constexpr unsigned kMostSteps = 2000;

}  // namespace

CurveStraightening::CurveStraightening(CurveGraph& graph, CurveLinks& links)
    : graph_(graph),
      links_(links),
      place_(links.n_vertices(), kNowhere),
      corner_(links.n_vertices()),
      is_queued_(links.n_vertices()) {}

double CurveStraightening::corner(VertexId v) const {
  const auto& t = graph_.triangulation();
  const Point2 a = t.point(links_[v][0]) - t.point(v);
  const Point2 b = t.point(links_[v][1]) - t.point(v);
  const double shorter = std::min(a.stableNorm(), b.stableNorm());
  const double cosine = a.stableNormalized().dot(b.stableNormalized());
  return kCornerPrice * shorter * (1 + cosine) / 2;
}

bool CurveStraightening::has_step(std::size_t first, VertexId v,
                                  VertexId w) const {
  for (std::size_t i = first; i + 1 < trail_.size(); i += 2) {
    if ((trail_[i] == v && trail_[i + 1] == w) ||
        (trail_[i] == w && trail_[i + 1] == v))
      return true;
  }
  return false;
}

bool CurveStraightening::can_drop(VertexId v, VertexId w) const {
  return w != CurveLinks::kNone && place_[index(w)] != kNowhere &&
         !has_added(v, w);
}

/// Goes on at the trail's last vertex, which lacks a link.
/// @param gain  cost of the edges dropped, less that of those added
void CurveStraightening::follow(double gain, unsigned depth) {
  if (++n_steps_ > kMostSteps) return;
  const VertexId v = trail_.back();
  for (const CurveGraph::Arc& arc : graph_.arcs(v)) {
    if (links_.has(v, arc.to) || has_dropped(v, arc.to)) continue;
    if (arc.to == trail_.front()) close(arc, gain);
    if (arc.cost < gain && depth > 0 && place_[index(arc.to)] != kNowhere)
      take(arc, gain, depth);
  }
}

/// Links the last vertex to the end of the arc, which drops a link for it.
void CurveStraightening::take(const CurveGraph::Arc& arc, double gain,
                              unsigned depth) {
  const VertexId v = trail_.back();
  const VertexId w = arc.to;
  const std::array<VertexId, 2> old = links_[w];
  for (const VertexId x : old) {
    if (!can_drop(w, x)) continue;
    const double dropped = graph_.arc(w, x)->cost;
    links_.drop(w, x);
    links_.add(v, w);
    trail_.insert(trail_.end(), {w, x});
    follow(gain - arc.cost + dropped, depth - 1);
    trail_.resize(trail_.size() - 2);
    links_.drop(v, w);
    links_.add(w, x);
  }
}

/// Links the last vertex to the first one, to see what the trail is worth.
void CurveStraightening::close(const CurveGraph::Arc& arc, double gain) {
  const VertexId v = trail_.back();
  links_.add(v, arc.to);
  const double change = change_of_corners() + arc.cost - gain;
  links_.drop(v, arc.to);
  if (change < best_change_ && !sides_met(cuts()).empty()) {
    best_change_ = change;
    best_ = trail_;
  }
}

double CurveStraightening::change_of_corners() const {
  std::vector<VertexId> touched = trail_;
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  double change = 0;
  for (const VertexId v : touched) change += corner(v) - corner_[index(v)];
  return change;
}

/// By ascending place.
std::vector<CurveStraightening::Cut> CurveStraightening::cuts() const {
  std::vector<Cut> cuts;
  for (std::uint32_t i = 0; i < trail_.size(); i += 2) {
    const std::uint32_t from = place_[index(trail_[i])];
    const std::uint32_t to = place_[index(trail_[i + 1])];
    const bool forward = (from + 1) % n_near() == to;
    assert(forward || (to + 1) % n_near() == from);
    cuts.push_back({forward ? from : to, i / 2, forward});
  }
  std::ranges::sort(cuts, {}, &Cut::place);
  return cuts;
}

/// The sides of cuts at which a walk along the new curve enters the parts
/// between them, 2 c before the c-th cut and 2 c + 1 behind it; empty if the
/// walk does not enter all.
std::vector<std::uint32_t> CurveStraightening::sides_met(
    const std::vector<Cut>& cuts) const {
  const auto n = static_cast<std::uint32_t>(cuts.size());
  std::array<std::uint32_t, 2 * kDrops> side_of{};  // of a vertex of the trail
  for (std::uint32_t c = 0; c < n; ++c) {
    const std::uint32_t first = 2 * cuts[c].step;
    side_of[first] = 2 * c + (cuts[c].forward ? 0 : 1);
    side_of[first + 1] = 2 * c + (cuts[c].forward ? 1 : 0);
  }
  std::array<std::uint32_t, 2 * kDrops> linked_to{};  // of a side
  for (std::uint32_t i = 1; i < 2 * n; i += 2) {
    const std::uint32_t next = (i + 1) % (2 * n);
    linked_to[side_of[i]] = side_of[next];
    linked_to[side_of[next]] = side_of[i];
  }
  std::vector<std::uint32_t> met;
  std::uint32_t side = 1;
  do {
    met.push_back(side);
    const bool forward = side % 2 == 1;
    const std::uint32_t leave =
        forward ? (side + 1) % (2 * n) : (side + 2 * n - 1) % (2 * n);
    side = linked_to[leave];
  } while (side != 1);
  if (met.size() < n) met.clear();
  return met;
}

void CurveStraightening::make_best() {
  trail_ = std::exchange(best_, {});
  const std::vector<Cut> at = cuts();
  const auto n = static_cast<std::uint32_t>(at.size());
  std::vector<VertexId> ring;
  ring.reserve(ring_.size());
  for (const std::uint32_t side : sides_met(at)) {
    const std::uint32_t cut = side / 2;
    const bool forward = side % 2 == 1;
    // The part from behind one cut to the next one.
    std::uint32_t place = (at[forward ? cut : (cut + n - 1) % n].place + 1);
    const std::uint32_t last = at[forward ? (cut + 1) % n : cut].place;
    const std::size_t begin = ring.size();
    for (place %= n_near(); place != last; place = (place + 1) % n_near())
      ring.push_back(ring_[place]);
    ring.push_back(ring_[last]);
    if (!forward)
      std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(begin),
                   ring.end());
  }
  assert(ring.size() == ring_.size());
  ring_ = std::move(ring);
  for (std::size_t i = 0; i < trail_.size(); i += 2)
    links_.drop(trail_[i], trail_[i + 1]);
  for (std::size_t i = 1; i < trail_.size(); i += 2)
    links_.add(trail_[i], trail_[(i + 1) % trail_.size()]);
  for (const VertexId v : trail_) corner_[index(v)] = corner(v);
  number_places();
}

/// Makes the best of the trails that begin with a link of v.
bool CurveStraightening::improve(VertexId v) {
  n_steps_ = 0;
  best_.clear();
  const std::array<VertexId, 2> old = links_[v];
  // What rounding may make up.
  const double cost = graph_.arc(v, old[0])->cost + graph_.arc(v, old[1])->cost;
  best_change_ = -1e-12 * cost;
  for (const VertexId w : old) {
    if (!can_drop(v, w)) continue;
    const double dropped = graph_.arc(v, w)->cost;
    links_.drop(v, w);
    for (const bool from_v : {false, true}) {
      trail_ = from_v ? std::vector{w, v} : std::vector{v, w};
      follow(dropped, kDrops - 1);
    }
    trail_.clear();
    links_.add(v, w);
  }
  if (best_.empty()) return false;
  make_best();
  return true;
}

void CurveStraightening::number_places() {
  for (std::uint32_t place = 0; place < n_near(); ++place)
    place_[index(ring_[place])] = place;
}

std::size_t CurveStraightening::run(std::span<const VertexId> near) {
  ring_.assign(near.begin(), near.end());
  number_places();
  std::vector<VertexId> queue;
  const auto push = [&](VertexId v) {
    if (place_[index(v)] == kNowhere || is_queued_[index(v)]) return;
    is_queued_[index(v)] = true;
    queue.push_back(v);
  };
  for (const VertexId v : ring_) {
    corner_[index(v)] = corner(v);
    push(v);
  }
  std::size_t n_made = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    is_queued_[index(queue[i])] = false;
    while (improve(queue[i])) {
      ++n_made;
      for (const VertexId v : trail_)
        for (const CurveGraph::Arc& arc : graph_.arcs(v)) push(arc.to);
      trail_.clear();
    }
  }
  for (const VertexId v : ring_) place_[index(v)] = kNowhere;
  return n_made;
}

}  // namespace umbrella
