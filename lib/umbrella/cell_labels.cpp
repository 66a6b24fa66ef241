// First labels by a union-find with parity, worst-first; then cells are
// switched until the surface is manifold; from there on by moves that keep it
// so. Each step is deterministic, and has a proof of its end in docs/labels.md.
#include "umbrella/cell_labels.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "delaunay/canonical_cells.h"
#include "umbrella/label_frame_internal.h"
#include "umbrella/label_mending_internal.h"
#include "umbrella/label_moves_internal.h"
#include "umbrella/label_window_internal.h"
#include "umbrella/stopwatch.h"

namespace umbrella {
namespace {

/// The options, and the time since they were given.
class Order {
 public:
  explicit Order(const CellLabelOptions& options) : options_(options) {}

  const CellLabelOptions& options() const { return options_; }
  bool is_over() const {
    return (options_.stop != nullptr && *options_.stop) ||
           (std::isfinite(options_.seconds) &&
            watch_.seconds() >= options_.seconds);
  }

 private:
  const CellLabelOptions& options_;
  Stopwatch watch_;
};

/// Ties go by the numbers of cells here. @return none if the labels have left a
/// window
std::optional<CellLabelReport> close_canonical(
    LabelFrame& frame, std::span<const LocatedTriangle> kept,
    const Order& order, Labelling& labels) {
  CellLabelReport report;
  label_worst_first(frame, kept, labels);
  if (!order.is_over() && !labels.faulty_vertices().empty()) {
    const auto held = held_by_cut(frame, kept, labels);
    frame.keep(held);
    label_worst_first(frame, held, labels);
  }
  report.mended = LabelMending(frame, labels).run();
  if (labels.has_left_window()) return std::nullopt;

  LabelMoves moves(frame, labels);
  bool goes_on = true;
  while (goes_on && !order.is_over()) {
    report.dissolved += moves.dissolve(order.options().piece_triangles);
    report.brought_in += moves.bring_in(unused_vertices(labels));
    if (order.is_over()) break;
    report.brought_in += moves.reach(unused_vertices(labels));
    if (labels.has_left_window()) return std::nullopt;
    if (order.is_over()) break;
    const std::size_t n_exchanged = moves.exchange();
    report.improvements += n_exchanged;
    goes_on = n_exchanged > 0 && !unused_vertices(labels).empty();
  }
  if (order.is_over())
    report.brought_in += moves.bring_in(unused_vertices(labels));
  if (labels.has_left_window()) return std::nullopt;
  for (const LocatedTriangle& t : kept)
    report.given_up += labels.is_on_surface(t.facet) ? 0 : 1;
  return report;
}

delaunay::Facet in_lower_cell(const delaunay::Triangulation3& triangulation,
                              delaunay::Facet f) {
  const delaunay::Facet other =
      triangulation.cell(f.cell()).neighbor[f.index()];
  return other.cell() < f.cell() ? other : f;
}

std::optional<CellLabelResult> close_in_window(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> kept, std::span<const VertexId> open,
    const Order& order) {
  if (kept.empty()) return std::nullopt;
  const LabelWindow window(triangulation, kept, open);
  if (!window.is_small()) return std::nullopt;
  LabelFrame frame(window, order.options().weight);
  Labelling labels(window.triangulation());
  labels.set_border(window.border());
  const auto report = close_canonical(frame, window.kept(), order, labels);
  if (!report) return std::nullopt;
  CellLabelResult result;
  result.report = *report;
  result.triangles = window.with_rest(labels.surface());
  result.left_out = unused_vertices(labels);
  for (VertexId& v : result.left_out) v = window.to_original(v);
  return result;
}

CellLabelResult close_in_whole(const delaunay::Triangulation3& triangulation,
                               std::span<const LocatedTriangle> kept,
                               std::span<const VertexId> open,
                               const Order& order) {
  const delaunay::CanonicalCells cells(triangulation);
  std::vector<LocatedTriangle> located(kept.begin(), kept.end());
  for (LocatedTriangle& t : located)
    t.facet =
        in_lower_cell(cells.triangulation(), cells.from_original(t.facet));
  LabelFrame frame(cells.triangulation(), order.options().weight, located,
                   open);
  Labelling labels(cells.triangulation());
  CellLabelResult result;
  result.report = *close_canonical(frame, located, order, labels);
  result.triangles = labels.surface();
  for (LocatedTriangle& t : result.triangles)
    t.facet = in_lower_cell(triangulation, cells.to_original(t.facet));
  result.left_out = unused_vertices(labels);
  return result;
}

}  // namespace

CellLabelResult close_by_cell_labels(
    const delaunay::Triangulation3& triangulation,
    std::span<const LocatedTriangle> kept, std::span<const VertexId> open,
    const CellLabelOptions& options) {
  if (triangulation.dimension() < 3) return {};
  const Order order(options);
  if (options.is_closed_elsewhere)
    if (auto result = close_in_window(triangulation, kept, open, order))
      return std::move(*result);
  return close_in_whole(triangulation, kept, open, order);
}

}  // namespace umbrella
