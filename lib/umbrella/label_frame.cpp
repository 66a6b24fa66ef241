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

  void relate_beyond_hull() {
    const std::size_t first = triangulation_.n_finite_cells();
    for (std::size_t c = first; c < triangulation_.cells().size(); ++c)
      sets_.relate(first, c, 0);
  }

  void relate_across_kept(std::span<const LocatedTriangle> kept) {
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
  void relate(Facet f, std::uint32_t parity) {
    const CellId beyond =
        triangulation_.cell(f.cell()).neighbor[f.index()].cell();
    sets_.relate(index(f.cell()), index(beyond), parity);
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
  relations.relate_beyond_hull();
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
  explicit Costs(const LabelFrame& frame) : frame_(frame) {
    std::vector<double> all;
    for_each_facet(frame.triangulation(),
                   [&](Facet f) { all.push_back(frame.weight(f)); });
    const auto middle =
        all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    median_ = *middle;
  }
  CellCut::Cost operator()(Facet f) const {
    if (!(median_ > 0) || !std::isfinite(median_)) return 1;
    return static_cast<CellCut::Cost>(
        std::clamp(0x1p20 * (frame_.weight(f) / median_), 1.0, 0x1p40));
  }

  /// Calls visit(Facet) once for each facet within the hull or on it.
  template <class Visit>
  static void for_each_facet(const Triangulation3& triangulation, Visit visit) {
    for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i)
        if (c < index(triangulation.cell(CellId{c}).neighbor[i].cell()))
          visit(Facet(CellId{c}, i));
  }

 private:
  const LabelFrame& frame_;
  double median_ = 0;
};

}  // namespace

std::vector<LocatedTriangle> held_by_cut(const LabelFrame& frame,
                                         std::span<const LocatedTriangle> kept,
                                         const Labelling& labels) {
  constexpr std::uint64_t kEffortPerCell = 4000;
  const Triangulation3& triangulation = frame.triangulation();
  const Costs cost(frame);
  CellCut cut(triangulation);
  const auto prefer_label = [&](CellId c, CellCut::Cost amount) {
    cut.add_preference(c, labels.is_inside(c) ? amount : -amount);
  };
  for (std::uint32_t c = 0; c < triangulation.n_finite_cells(); ++c)
    if (!frame.is_open(CellId{c})) prefer_label(CellId{c}, CellCut::kInfinite);
  Costs::for_each_facet(triangulation, [&](Facet f) {
    if (!frame.is_kept(f)) {
      cut.set_cost(f, cost(f));
    } else if (labels.is_on_surface(f)) {
      const Facet other = triangulation.cell(f.cell()).neighbor[f.index()];
      for (const CellId c : {f.cell(), other.cell()})
        if (frame.is_open(c)) prefer_label(c, cost(f));
    }
  });
  std::vector<LocatedTriangle> held(kept.begin(), kept.end());
  if (!cut.run(kEffortPerCell * triangulation.cells().size())) return held;
  std::erase_if(held, [&](const LocatedTriangle& t) {
    const Facet other =
        triangulation.cell(t.facet.cell()).neighbor[t.facet.index()];
    return cut.is_inside(t.facet.cell()) == cut.is_inside(other.cell());
  });
  return held;
}

}  // namespace umbrella
