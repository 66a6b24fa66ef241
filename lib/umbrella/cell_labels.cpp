// First labels by a union-find with parity, worst-first; then cells are
// switched until the surface is manifold; from there on by moves that keep it
// so. Each step is deterministic, and has a proof of its end in docs/labels.md.
#include "umbrella/cell_labels.h"

#include <vector>

#include "delaunay/canonical_cells.h"
#include "umbrella/label_frame_internal.h"
#include "umbrella/label_mending_internal.h"
#include "umbrella/label_moves_internal.h"

namespace umbrella {
namespace {

/// Ties go by the numbers of cells here.
CellLabelResult close_canonical(const delaunay::Triangulation3& triangulation,
                                std::span<const LocatedTriangle> kept,
                                std::span<const VertexId> open,
                                const CellLabelOptions& options) {
  CellLabelResult result;
  LabelFrame frame(triangulation, options.weight, kept, open);
  Labelling labels(triangulation);
  label_worst_first(frame, kept, labels);
  if (!labels.faulty_vertices().empty()) {
    const auto held = held_by_cut(frame, kept, labels);
    frame.keep(held);
    label_worst_first(frame, held, labels);
  }
  result.report.mended = LabelMending(frame, labels).run();

  LabelMoves moves(frame, labels);
  const auto is_stopped = [&] {
    return options.stop != nullptr && *options.stop;
  };
  bool goes_on = true;
  while (goes_on && !is_stopped()) {
    result.report.dissolved += moves.dissolve(options.piece_triangles);
    std::size_t n = moves.bring_in(unused_vertices(labels));
    n += moves.reach(unused_vertices(labels));
    const std::size_t n_exchanged = moves.exchange();
    result.report.brought_in += n;
    result.report.improvements += n_exchanged;
    goes_on = n_exchanged > 0 && !unused_vertices(labels).empty();
  }
  if (is_stopped())
    result.report.brought_in += moves.bring_in(unused_vertices(labels));
  result.triangles = labels.surface();
  result.left_out = unused_vertices(labels);
  for (const LocatedTriangle& t : kept)
    result.report.given_up += labels.is_on_surface(t.facet) ? 0 : 1;
  return result;
}

delaunay::Facet in_lower_cell(const delaunay::Triangulation3& triangulation,
                              delaunay::Facet f) {
  const delaunay::Facet other =
      triangulation.cell(f.cell()).neighbor[f.index()];
  return other.cell() < f.cell() ? other : f;
}

}  // namespace

CellLabelResult close_by_cell_labels(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> kept, std::span<const VertexId> open,
    const CellLabelOptions& options) {
  if (triangulation.dimension() < 3) return {};
  const delaunay::CanonicalCells cells(triangulation);
  std::vector<LocatedTriangle> located(kept.begin(), kept.end());
  for (LocatedTriangle& t : located)
    t.facet =
        in_lower_cell(cells.triangulation(), cells.from_original(t.facet));
  CellLabelResult result =
      close_canonical(cells.triangulation(), located, open, options);
  for (LocatedTriangle& t : result.triangles)
    t.facet = in_lower_cell(triangulation, cells.to_original(t.facet));
  return result;
}

}  // namespace umbrella
