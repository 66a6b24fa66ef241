#include <algorithm>
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
      is_open_(triangulation.points().size()) {
  keep(kept);
  for (const VertexId v : open) is_open_[index(v)] = 1;
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
  explicit Relations(const LabelFrame& frame)
      : frame_(frame),
        triangulation_(frame.triangulation()),
        sets_(triangulation_.cells().size()) {}

  /// The order matters only if some contradict each other, which takes a walk
  /// about an edge, say, that crosses kept triangles alone.
  void relate_across_kept(std::span<const LocatedTriangle> kept) {
    relate_beyond_hull();
    const bool agree = std::all_of(
        kept.begin(), kept.end(),
        [this](const LocatedTriangle& t) { return relate(t.facet, 1); });
    if (agree) return;
    sets_ = ParitySets(triangulation_.cells().size());
    relate_beyond_hull();
    relate_best_first(kept);
  }

  /// Closed triangles; the open ones wait.
  void relate_across_others() {
    for (std::uint32_t c = 0; c < triangulation_.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i) {
        const Facet facet(CellId{c}, i);
        const Facet beyond = triangulation_.cell(facet.cell()).neighbor[i];
        if (index(beyond.cell()) < c || frame_.is_kept(facet)) continue;
        if (frame_.is_open(facet))
          open_.push_back({frame_.badness(facet), facet});
        else
          relate(facet, 0);
      }
  }

  void relate_across_open() {
    std::stable_sort(open_.begin(), open_.end(),
                     [](const WeighedFacet& a, const WeighedFacet& b) {
                       return a.badness > b.badness;
                     });
    for (const WeighedFacet& f : open_) relate(f.facet, 0);
  }

  bool is_inside(std::size_t c) {
    return sets_.find(c).parity !=
           sets_.find(triangulation_.n_finite_cells()).parity;
  }

 private:
  void relate_beyond_hull() {
    const std::size_t first = triangulation_.n_finite_cells();
    for (std::size_t c = first; c < triangulation_.cells().size(); ++c)
      sets_.relate(first, c, 0);
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
  ParitySets sets_;
  std::vector<WeighedFacet> open_;
};

}  // namespace

void label_worst_first(const LabelFrame& frame,
                       std::span<const LocatedTriangle> kept,
                       Labelling& labels) {
  Relations relations(frame);
  relations.relate_across_kept(kept);
  relations.relate_across_others();
  relations.relate_across_open();
  const std::size_t n = frame.triangulation().n_finite_cells();
  for (std::uint32_t c = 0; c < n; ++c)
    if (relations.is_inside(c) != labels.is_inside(CellId{c}))
      labels.flip(CellId{c});
  if (labels.n_inside() > 0) return;
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
