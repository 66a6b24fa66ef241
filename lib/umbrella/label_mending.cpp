// A vertex is manifold if the cells at it that are inside hang together by
// facets at the vertex, and likewise those that are outside: their link is then
// a cycle, the edges at the vertex included (docs/labels.md). Each further part
// is a fault. A switch that lowers the number of faults is taken; where there
// is none one is forced, and its cells are not switched again but by filling,
// the last resort, which goes one way only: so the mending ends, at the latest
// with the hull.
#include <algorithm>
#include <limits>
#include <tuple>

#include "umbrella/label_mending_internal.h"
#include "umbrella/sort_unique_internal.h"

namespace umbrella {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;

namespace {

/// Of the parts of a star with one label, the smallest are tried; a hub of
/// thousands of parts would take too long otherwise.
constexpr std::size_t kMaxProposals = 24;

/// Cells met while switches are weighed, by cell of the triangulation. Beyond
/// it the first switch that is allowed is as good as any.
constexpr std::uint64_t kEffortPerCell = 400;

}  // namespace

LabelMending::LabelMending(LabelFrame& frame, Labelling& labels)
    : frame_(frame),
      labels_(labels),
      faults_(labels.triangulation().points().size()),
      is_frozen_(labels.triangulation().cells().size()),
      ring_is_open_(labels.triangulation().points().size()),
      effort_limit_(kEffortPerCell * labels.triangulation().cells().size()),
      slot_(labels.triangulation().cells().size()) {}

std::size_t LabelMending::run() {
  const std::vector<VertexId> faulty = labels_.faulty_vertices();
  for (const VertexId v : faulty) {
    labels_.find_parts(v, parts_);
    faults_[index(v)] = static_cast<std::uint32_t>(parts_.n_faults());
    faulty_.push(v);
  }
  while ((!faulty_.empty() || !stuck_.empty()) && !labels_.has_left_window()) {
    auto& queue = faulty_.empty() ? stuck_ : faulty_;
    const bool is_stuck = faulty_.empty();
    const VertexId v = queue.top();
    queue.pop();
    if (faults_[index(v)] == 0) continue;
    if (is_stuck)
      force(v);
    else if (!improve(v))
      stuck_.push(v);
  }
  return faulty.size();
}

/// Whether switches are no longer weighed. All cells have another limit than a
/// window, so from there on it shows too little.
bool LabelMending::is_spent() {
  if (effort_ <= effort_limit_) return false;
  if (frame_.window() != nullptr) labels_.leave_window();
  return true;
}

bool LabelMending::improve(VertexId v) {
  if (is_spent()) return false;
  propose(v, Licence::Open);
  std::optional<std::size_t> chosen = best(false);
  if (!chosen && open_ring(v)) {
    propose(v, Licence::Open);
    chosen = best(false);
  }
  if (!chosen) return false;
  apply(Cells(proposals_[*chosen]));
  return true;
}

void LabelMending::force(VertexId v) {
  open_ring(v);
  propose(v, Licence::Open);
  if (proposals_.empty()) propose(v, Licence::Fill);
  const Cells cells = proposals_[is_spent() ? 0 : *best(true)];
  for (const CellId c : cells) is_frozen_[index(c)] = 1;
  apply(cells);
}

/// @return whether some vertex there was not open
bool LabelMending::open_ring(VertexId v) {
  if (ring_is_open_[index(v)] != 0) return false;
  ring_is_open_[index(v)] = 1;
  bool has_opened = false;
  labels_.find_parts(v, parts_);
  for (std::size_t p = 0; p < parts_.size(); ++p)
    for (const CellId c : parts_[p].cells)
      for (const VertexId w : labels_.cell(c).vertex) {
        if (w == delaunay::kInfinite || frame_.is_open(w)) continue;
        frame_.open(w);
        if (labels_.is_at_border(w)) labels_.leave_window();
        has_opened = true;
      }
  return has_opened;
}

void LabelMending::apply(const Cells& cells) {
  for (const CellId c : cells) labels_.flip(c);
  refresh(cells);
}

/// Counts the faults at the corners of these cells anew.
void LabelMending::refresh(std::span<const CellId> cells) {
  corners_.clear();
  for (const CellId c : cells)
    for (const VertexId v : labels_.cell(c).vertex) corners_.push_back(v);
  sort_unique(corners_);
  for (const VertexId v : corners_) {
    labels_.find_parts(v, parts_);
    faults_[index(v)] = static_cast<std::uint32_t>(parts_.n_faults());
    if (faults_[index(v)] > 0) faulty_.push(v);
  }
}

bool LabelMending::is_allowed(CellId c, Licence licence) const {
  if (labels_.cell(c).is_infinite()) return false;
  if (licence == Licence::Fill) return !labels_.is_inside(c);
  return frame_.is_open(c) && is_frozen_[index(c)] == 0;
}

/// Ways to have fewer parts at v: to switch one of several parts of a label,
/// or to join it to another.
void LabelMending::propose(VertexId v, Licence licence) {
  labels_.find_parts(v, parts_);
  effort_ += parts_.n_cells();
  proposals_.clear();
  std::uint32_t slot = 0;
  std::vector<std::size_t> order;
  std::size_t n_inside = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    order.push_back(p);
    n_inside += parts_[p].is_inside ? 1 : 0;
    for (const CellId c : parts_[p].cells) slot_[index(c)] = slot++;
  }
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t a, std::size_t b) {
                     return parts_[a].cells.size() < parts_[b].cells.size();
                   });
  for (const std::size_t p : order) {
    if (proposals_.size() >= kMaxProposals) return;
    const std::size_t n_alike =
        parts_[p].is_inside ? n_inside : parts_.size() - n_inside;
    if (n_alike < 2) continue;
    const auto cells = parts_[p].cells;
    if (std::all_of(cells.begin(), cells.end(),
                    [&](CellId c) { return is_allowed(c, licence); }))
      proposals_.emplace_back(cells.begin(), cells.end());
    propose_path(v, p, licence);
  }
}

/// The fewest cells that join the part to another of its label at v.
void LabelMending::propose_path(VertexId v, std::size_t part, Licence licence) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  struct Step {
    CellId cell;
    std::size_t from;
  };
  std::vector<Step> steps;
  std::vector<bool> is_met(parts_.n_cells());  // by slot
  const auto enter = [&](CellId c, std::size_t from) {
    is_met[slot_[index(c)]] = true;
    steps.push_back({c, from});
  };
  for (const CellId c : parts_[part].cells) enter(c, kNone);
  for (std::size_t next = 0; next < steps.size(); ++next) {
    const Cell& cell = labels_.cell(steps[next].cell);
    for (unsigned i = 0; i < 4; ++i) {
      const CellId beyond = cell.neighbor[i].cell();
      if (cell.vertex[i] == v || is_met[slot_[index(beyond)]]) continue;
      if (labels_.is_inside(beyond) == parts_[part].is_inside) {
        Cells& path = proposals_.emplace_back();
        for (std::size_t k = next; steps[k].from != kNone; k = steps[k].from)
          path.push_back(steps[k].cell);
        return;
      }
      if (is_allowed(beyond, licence)) enter(beyond, next);
    }
  }
}

void LabelMending::count_facets(CellId c, int sign, Effect& effect) const {
  for (unsigned i = 0; i < 4; ++i) {
    const Facet facet(c, i);
    if (!labels_.is_on_surface(facet)) continue;
    effect.kept_lost += frame_.is_kept(facet) ? sign : 0;
    if (sign < 0) effect.worst = std::max(effect.worst, frame_.badness(facet));
  }
}

LabelMending::Effect LabelMending::effect_of(const Cells& cells) {
  Effect effect;
  corners_.clear();
  for (const CellId c : cells)
    for (const VertexId v : labels_.cell(c).vertex) corners_.push_back(v);
  sort_unique(corners_);
  for (const VertexId v : corners_) {
    effect.faults -= faults_[index(v)];
    effect.points_lost += labels_.is_used(v) ? 1 : 0;
  }
  for (const CellId c : cells) count_facets(c, 1, effect);
  for (const CellId c : cells) labels_.flip(c);
  for (const CellId c : cells) count_facets(c, -1, effect);
  for (const VertexId v : corners_) {
    labels_.find_parts(v, other_parts_);
    effort_ += other_parts_.n_cells();
    effect.faults += static_cast<std::int64_t>(other_parts_.n_faults());
    effect.points_lost -= labels_.is_used(v) ? 1 : 0;
  }
  for (const CellId c : cells) labels_.flip(c);
  return effect;
}

bool LabelMending::is_better(const Effect& a, const Effect& b, bool is_forced) {
  if (is_forced && a.faults != b.faults) return a.faults < b.faults;
  return std::tie(a.points_lost, a.kept_lost, a.worst, a.faults) <
         std::tie(b.points_lost, b.kept_lost, b.worst, b.faults);
}

/// Of the proposals, or of those that lower the number of faults.
std::optional<std::size_t> LabelMending::best(bool is_forced) {
  std::optional<std::size_t> chosen;
  Effect least;
  for (std::size_t i = 0; i < proposals_.size(); ++i) {
    const Effect effect = effect_of(proposals_[i]);
    if (!is_forced && effect.faults >= 0) continue;
    if (chosen && !is_better(effect, least, is_forced)) continue;
    chosen = i;
    least = effect;
  }
  return chosen;
}

}  // namespace umbrella
