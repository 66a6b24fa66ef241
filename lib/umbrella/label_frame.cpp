#include <algorithm>
#include <array>
#include <cmath>

#include "umbrella/cell_cut_internal.h"
#include "umbrella/label_frame_internal.h"
#include "umbrella/parity_sets_internal.h"

namespace umbrella {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

LabelFrame::LabelFrame(const Triangulation3& triangulation, CloseWeight weight,
                       std::span<const LocatedTriangle> kept,
                       std::span<const VertexId> open)
    : triangulation_(triangulation),
      badness_(triangulation, weight),
      is_open_(triangulation.points().size()),
      level_(triangulation.points().size()) {
  keep(kept);
  for (const VertexId v : open) is_open_[index(v)] = 1;
  find_levels();
}

void LabelFrame::keep(std::span<const LocatedTriangle> kept) {
  kept_.assign(triangulation_.cells().size(), 0);
  for (const LocatedTriangle& t : kept) {
    const Facet beyond =
        triangulation_.cell(t.facet.cell()).neighbor[t.facet.index()];
    for (const Facet f : {t.facet, beyond})
      kept_[index(f.cell())] |= static_cast<std::uint8_t>(1U << f.index());
  }
}

bool LabelFrame::is_open(Facet f) const {
  const Cell& cell = triangulation_.cell(f.cell());
  const auto& corners = delaunay::kFacetCorners[f.index()];
  return std::all_of(corners.begin(), corners.end(),
                     [&](unsigned k) { return is_open(cell.vertex[k]); });
}

/// By vertex, from cell to cell.
void LabelFrame::find_levels() {
  for (std::size_t v = 0; v < is_open_.size(); ++v)
    level_[v] = is_open_[v] != 0 ? 0 : kFar;
  for (std::uint8_t level = 0; level + 1 < kFar; ++level)
    for (std::size_t c = 0; c < triangulation_.n_finite_cells(); ++c) {
      const auto& corners = triangulation_.cells()[c].vertex;
      if (std::any_of(corners.begin(), corners.end(),
                      [&](VertexId v) { return level_[index(v)] == level; }))
        for (const VertexId v : corners)
          level_[index(v)] =
              std::min<std::uint8_t>(level_[index(v)], level + 1);
    }
}

unsigned LabelFrame::level(Facet f) const {
  const Cell& cell = triangulation_.cell(f.cell());
  unsigned level = kFar;
  for (const unsigned k : delaunay::kFacetCorners[f.index()])
    if (cell.vertex[k] != delaunay::kInfinite)
      level = std::min<unsigned>(level, level_[index(cell.vertex[k])]);
  return level;
}

bool LabelFrame::is_open(CellId c) const {
  const Cell& cell = triangulation_.cell(c);
  return !cell.is_infinite() &&
         std::all_of(cell.vertex.begin(), cell.vertex.end(),
                     [&](VertexId v) { return is_open(v); });
}

namespace {

struct WeighedFacet {
  double badness;
  Facet facet;
};

/// Relates all cells to each other, the surest relations first.
class Relations {
 public:
  Relations(const LabelFrame& frame, std::span<const LocatedTriangle> kept)
      : frame_(frame),
        triangulation_(frame.triangulation()),
        kept_(kept),
        sets_(triangulation_.cells().size() + 1) {}

  void relate_all() {
    sort_facets();
    for (unsigned level = LabelFrame::kFar + 1; level-- > 0;) {
      bool agree = relate_across_kept(level);
      for (const Facet f : closed_[level]) agree = relate(f, 0) && agree;
      if (level == LabelFrame::kFar) {
        have_agreed_ = agree;
        if (frame_.window() != nullptr) relate_outside();
      }
    }
    relate_across_open();
  }

  bool is_inside(std::size_t c) {
    return sets_.find(c).parity != sets_.find(hull()).parity;
  }

  /// Whether the triangles far away have, and have related all cells beyond a
  /// window to the hull.
  bool have_agreed() const { return have_agreed_; }

 private:
  /// What lies beyond it.
  std::size_t hull() const { return triangulation_.cells().size(); }

  void relate_beyond_hull() {
    const std::size_t first = triangulation_.n_finite_cells();
    for (std::size_t c = first; c < triangulation_.cells().size(); ++c) {
      const CellId beyond{static_cast<std::uint32_t>(c)};
      if (frame_.window() == nullptr || frame_.window()->is_beyond_hull(beyond))
        sets_.relate(hull(), c, 0);
    }
  }

  void sort_facets() {
    relate_beyond_hull();
    for (const LocatedTriangle& t : kept_)
      walls_[frame_.level(t.facet)].push_back(t);
    for (std::uint32_t c = 0; c < triangulation_.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i) {
        const Facet facet(CellId{c}, i);
        const Facet beyond = triangulation_.cell(facet.cell()).neighbor[i];
        if (index(beyond.cell()) < c || frame_.is_kept(facet)) continue;
        if (frame_.is_open(facet))
          open_.push_back({frame_.badness(facet), facet});
        else
          closed_[frame_.level(facet)].push_back(facet);
      }
  }

  /// The order matters only if some contradict each other, which takes a walk
  /// about an edge, say, that crosses kept triangles alone.
  /// @return whether that is not so
  bool relate_across_kept(unsigned level) {
    const ParitySets before = sets_;
    const bool agree = std::all_of(
        walls_[level].begin(), walls_[level].end(),
        [this](const LocatedTriangle& t) { return relate(t.facet, 1); });
    if (agree) return true;
    sets_ = before;
    relate_best_first(walls_[level]);
    return false;
  }

  void relate_across_open() {
    std::stable_sort(open_.begin(), open_.end(),
                     [](const WeighedFacet& a, const WeighedFacet& b) {
                       return a.badness > b.badness;
                     });
    for (const WeighedFacet& f : open_) relate(f.facet, 0);
  }

  bool is_related_to_hull(std::size_t c) {
    return sets_.find(c).root == sets_.find(hull()).root;
  }

  /// Cells beyond the window to others and to the hull, along ways outside. Few
  /// ways are enough, for most of these cells hang together.
  void relate_outside() {
    constexpr int kRounds = 3;
    std::size_t n_apart = 1;
    for (int round = 0; round < kRounds && n_apart > 0; ++round) {
      n_apart = 0;
      for (std::size_t c = triangulation_.n_finite_cells(); c < hull(); ++c) {
        if (is_related_to_hull(c)) continue;
        ++n_apart;
        if (n_apart <= kMostWays) relate_outside(c);
      }
    }
    have_agreed_ = have_agreed_ && n_apart == 0;
  }

  void relate_outside(std::size_t c) {
    for (unsigned way = 0; way < LabelWindow::kDirections; ++way) {
      const auto end =
          frame_.window()->way_out(CellId{static_cast<std::uint32_t>(c)}, way);
      if (!end) continue;
      const std::size_t other = end->cell ? index(*end->cell) : hull();
      have_agreed_ = sets_.relate(c, other, end->parity) && have_agreed_;
      if (is_related_to_hull(c)) return;
    }
  }

  void relate_best_first(std::span<const LocatedTriangle> kept) {
    std::vector<WeighedFacet> walls;
    walls.reserve(kept.size());
    for (const LocatedTriangle& t : kept)
      walls.push_back({frame_.badness(t.facet), t.facet});
    std::stable_sort(walls.begin(), walls.end(),
                     [](const WeighedFacet& a, const WeighedFacet& b) {
                       return a.badness < b.badness;
                     });
    for (const WeighedFacet& wall : walls) relate(wall.facet, 1);
  }

  /// @return whether that agrees with what was said before
  bool relate(Facet f, std::uint32_t parity) {
    const CellId beyond =
        triangulation_.cell(f.cell()).neighbor[f.index()].cell();
    return sets_.relate(index(f.cell()), index(beyond), parity);
  }

  const LabelFrame& frame_;
  const Triangulation3& triangulation_;
  static constexpr std::size_t kMostWays = 1000;  // in one round

  static constexpr std::size_t kLevels = LabelFrame::kFar + 1;

  std::span<const LocatedTriangle> kept_;
  ParitySets sets_;
  std::array<std::vector<LocatedTriangle>, kLevels> walls_;  // kept
  std::array<std::vector<Facet>, kLevels> closed_;           // and not kept
  std::vector<WeighedFacet> open_;
  bool have_agreed_ = true;
};

}  // namespace

void label_worst_first(const LabelFrame& frame,
                       std::span<const LocatedTriangle> kept,
                       Labelling& labels) {
  Relations relations(frame, kept);
  relations.relate_all();
  const std::size_t n = frame.triangulation().n_finite_cells();
  const bool is_window = frame.window() != nullptr;
  if (is_window && !relations.have_agreed()) labels.leave_window();
  if (is_window)
    for (std::size_t c = n; c < frame.triangulation().cells().size(); ++c)
      labels.put_beyond(CellId{static_cast<std::uint32_t>(c)},
                        relations.is_inside(c));
  for (std::uint32_t c = 0; c < n; ++c)
    if (relations.is_inside(c) != labels.is_inside(CellId{c}))
      labels.flip(CellId{c});
  if (is_window || labels.n_inside() > 0) return;
  for (std::uint32_t c = 0; c < n; ++c) labels.flip(CellId{c});
}

namespace {

/// Weights as whole numbers: the median at 2^20, so that neither the facets of
/// dense parts vanish nor those of slivers count without end.
class Costs {
 public:
  /// @param weights  all that will be asked for
  explicit Costs(std::vector<double> weights) {
    const auto middle =
        weights.begin() + static_cast<std::ptrdiff_t>(weights.size() / 2);
    std::nth_element(weights.begin(), middle, weights.end());
    if (middle != weights.end()) median_ = *middle;
  }
  CellCut::Cost operator()(double weight) const {
    if (!(median_ > 0) || !std::isfinite(median_)) return 1;
    return static_cast<CellCut::Cost>(
        std::clamp(0x1p20 * (weight / median_), 1.0, 0x1p40));
  }

 private:
  double median_ = 0;
};

/// The cells that are open: what is kept elsewhere is not asked about.
class OpenCells {
 public:
  OpenCells(const LabelFrame& frame, const Labelling& labels)
      : frame_(frame), labels_(labels) {
    const Triangulation3& triangulation = frame.triangulation();
    for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c)
      if (frame.is_open(CellId{c})) cells_.push_back(CellId{c});
    for (const CellId c : cells_)
      for (unsigned i = 0; i < 4; ++i) {
        const Facet f(c, i);
        const bool other_is_open = frame.is_open(beyond(f));
        if (other_is_open && beyond(f) < c) continue;
        facets_.push_back({frame.weight(f), f, other_is_open});
      }
  }

  std::span<const CellId> cells() const { return cells_; }

  void weigh(CellCut& cut) const {
    std::vector<double> weights;
    for (const OpenFacet& f : facets_) weights.push_back(f.weight);
    const Costs cost(std::move(weights));
    for (const auto& [weight, f, other_is_open] : facets_) {
      if (frame_.is_kept(f)) {
        if (!labels_.is_on_surface(f)) continue;
        prefer_label(cut, f.cell(), f.cell(), cost(weight));
        if (other_is_open)
          prefer_label(cut, beyond(f), beyond(f), cost(weight));
      } else if (other_is_open) {
        cut.set_cost(f, cost(weight));
      } else {
        prefer_label(cut, f.cell(), beyond(f), cost(weight));
      }
    }
  }

 private:
  struct OpenFacet {
    double weight;
    Facet facet;
    bool other_is_open;
  };

  CellId beyond(Facet f) const {
    return frame_.triangulation().cell(f.cell()).neighbor[f.index()].cell();
  }
  /// What it costs if c does not get the label that `like` has.
  void prefer_label(CellCut& cut, CellId c, CellId like,
                    CellCut::Cost amount) const {
    cut.add_preference(c, labels_.is_inside(like) ? amount : -amount);
  }

  const LabelFrame& frame_;
  const Labelling& labels_;
  std::vector<CellId> cells_;
  std::vector<OpenFacet> facets_;  // with an open cell, each once
};

}  // namespace

std::vector<LocatedTriangle> held_by_cut(const LabelFrame& frame,
                                         std::span<const LocatedTriangle> kept,
                                         const Labelling& labels) {
  constexpr std::uint64_t kEffortPerCell = 4000;
  const OpenCells open(frame, labels);
  CellCut cut(frame.triangulation(), open.cells());
  open.weigh(cut);
  std::vector<LocatedTriangle> held(kept.begin(), kept.end());
  if (!cut.run(kEffortPerCell * open.cells().size())) return held;
  const auto is_inside = [&](CellId c) {
    return frame.is_open(c) ? cut.is_inside(c) : labels.is_inside(c);
  };
  std::erase_if(held, [&](const LocatedTriangle& t) {
    const Facet other =
        frame.triangulation().cell(t.facet.cell()).neighbor[t.facet.index()];
    return is_inside(t.facet.cell()) == is_inside(other.cell());
  });
  return held;
}

}  // namespace umbrella
