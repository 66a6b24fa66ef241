#include <algorithm>

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
      kept_(triangulation.cells().size()),
      is_open_(triangulation.points().size()) {
  for (const LocatedTriangle& t : kept) {
    const Facet beyond =
        triangulation.cell(t.facet.cell()).neighbor[t.facet.index()];
    for (const Facet f : {t.facet, beyond})
      kept_[index(f.cell())] |= static_cast<std::uint8_t>(1U << f.index());
  }
  for (const VertexId v : open) is_open_[index(v)] = 1;
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
    if (relations.is_inside(c)) labels.flip(CellId{c});
  if (labels.n_inside() > 0) return;
  for (std::uint32_t c = 0; c < n; ++c) labels.flip(CellId{c});
}

}  // namespace umbrella
