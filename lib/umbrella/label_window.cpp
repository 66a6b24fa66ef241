// Walks go through cells towards a point, across facets that it is strictly
// beyond, which never leads in a circle in a Delaunay triangulation
// [Devillers02]. A way out of the window is one towards a point far away. Every
// closed triangle on the way says for certain whether the cells at its sides
// are alike.
#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <limits>

#include "predicates/predicates.h"
#include "umbrella/label_window_internal.h"

namespace umbrella {

using delaunay::Cell;
using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

namespace {

/// A window with more of the cells is not worth its making.
constexpr std::size_t kLargestPart = 4;  // one in so many

}  // namespace

LabelWindow::LabelWindow(const Triangulation3& whole,
                         std::span<const LocatedTriangle> kept,
                         std::span<const VertexId> open)
    : whole_(whole),
      all_kept_(kept),
      marks_(whole.points().size()),
      is_met_(whole.cells().size()) {
  std::vector<CellId> cells = mark_centre(open);
  if (!find_cells(cells)) return;
  cells_.emplace(whole, cells);
  for (const VertexId v : open) open_.push_back(cells_->from_original(v));
  for (std::uint32_t v = 0; v < triangulation().points().size(); ++v)
    if (marks_[index(to_original(VertexId{v}))] == Mark::Border)
      border_.push_back(VertexId{v});
  locate_kept();
  box_ = {whole.points().front(), whole.points().front()};
  for (const Point3& p : whole.points())
    box_ = {box_[0].cwiseMin(p), box_[1].cwiseMax(p)};
}

/// @return cells at these vertices, one at each at least
std::vector<CellId> LabelWindow::mark_centre(std::span<const VertexId> open) {
  std::vector<std::uint8_t> is_used(marks_.size());
  for (const LocatedTriangle& t : all_kept_)
    for (const VertexId v : t.corners) is_used[index(v)] = 1;
  for (const VertexId v : open) marks_[index(v)] = Mark::Near;
  std::vector<CellId> cells;
  for (std::uint32_t v = 0; v < marks_.size(); ++v) {
    if (is_used[v] != 0) continue;
    marks_[v] = Mark::Near;
    cells.push_back(cell_at(VertexId{v}));
  }
  const auto is_near = [this](VertexId v) {
    return marks_[index(v)] == Mark::Near;
  };
  for (const auto& [corners, facet] : all_kept_)
    if (std::any_of(corners.begin(), corners.end(), is_near))
      cells.push_back(facet.cell());
  return cells;
}

/// By a walk from a triangle whose vertices have ids that are near, as they are
/// in space then.
CellId LabelWindow::cell_at(VertexId v) const {
  const auto has_v = [&](CellId c) {
    const auto& corners = whole_.cell(c).vertex;
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  const auto near = std::lower_bound(
      all_kept_.begin(), all_kept_.end(), v,
      [](const LocatedTriangle& t, VertexId u) { return t.corners[0] < u; });
  CellId at = (near == all_kept_.end() ? all_kept_.back() : *near).facet.cell();
  while (!has_v(at)) {
    const auto i = facet_towards(whole_.cell(at), whole_.point(v));
    assert(i);  // no cell has a vertex that is no corner of it
    at = whole_.cell(at).neighbor[*i].cell();
  }
  return at;
}

/// All finite cells at the marked vertices, from one at each of them at least;
/// then at their corners, and so on. @return whether they are few
bool LabelWindow::find_cells(std::vector<CellId>& cells) {
  std::vector<CellId> starts = std::move(cells);
  cells.clear();
  for (const CellId c : starts) enter(c, cells);
  for (unsigned ring = 0;; ++ring) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (kLargestPart * cells.size() > whole_.n_finite_cells()) return false;
      enter_neighbors(cells[i], cells);
    }
    const bool is_last = ring == kRings;
    for (const CellId c : cells)
      for (const VertexId v : whole_.cell(c).vertex)
        if (marks_[index(v)] == Mark::None)
          marks_[index(v)] = is_last ? Mark::Border : Mark::Near;
    if (is_last) return true;
  }
}

void LabelWindow::enter(CellId c, std::vector<CellId>& cells) {
  if (index(c) >= whole_.n_finite_cells() || is_met_[index(c)] != 0) return;
  is_met_[index(c)] = 1;
  cells.push_back(c);
}

/// Those across a facet with a corner that is near.
void LabelWindow::enter_neighbors(CellId c, std::vector<CellId>& cells) {
  const Cell& cell = whole_.cell(c);
  std::array<bool, 4> is_near;
  std::transform(cell.vertex.begin(), cell.vertex.end(), is_near.begin(),
                 [this](VertexId v) { return marks_[index(v)] == Mark::Near; });
  const auto n_near = std::count(is_near.begin(), is_near.end(), true);
  for (unsigned i = 0; i < 4; ++i)
    if (n_near > (is_near[i] ? 1 : 0)) enter(cell.neighbor[i].cell(), cells);
}

void LabelWindow::locate_kept() {
  const auto is_far = [this](VertexId v) {
    return marks_[index(v)] == Mark::None;
  };
  for (std::size_t i = 0; i < all_kept_.size(); ++i) {
    LocatedTriangle t = all_kept_[i];
    if (std::any_of(t.corners.begin(), t.corners.end(), is_far)) continue;
    if (!cells_->has_cell(t.facet.cell()))
      t.facet = whole_.cell(t.facet.cell()).neighbor[t.facet.index()];
    if (!cells_->has_cell(t.facet.cell())) continue;
    for (VertexId& v : t.corners) v = cells_->from_original(v);
    t.facet = in_lower_cell(cells_->from_original(t.facet));
    kept_.push_back(t);
    place_of_kept_.push_back(i);
  }
}

Facet LabelWindow::in_lower_cell(Facet f) const {
  const Facet other = triangulation().cell(f.cell()).neighbor[f.index()];
  return other.cell() < f.cell() ? other : f;
}

std::optional<LabelWindow::End> LabelWindow::way_out(CellId beyond,
                                                     unsigned direction) const {
  CellId at = cells_->original_of(beyond);
  const Point3 target = far_point(at, direction);
  End end = {std::nullopt, 0};
  for (std::size_t step = 0; step < whole_.cells().size(); ++step) {
    const Cell& cell = whole_.cell(at);
    if (cell.is_infinite()) return end;
    const auto i = facet_towards(cell, target);
    if (!i) return std::nullopt;
    const Triangle crossed = corners(whole_, Facet(at, *i));
    if (is_near(crossed)) {
      end.cell = cells_->copy_of(at);
      return end;
    }
    end.parity ^= is_kept(crossed) ? 1U : 0U;
    at = cell.neighbor[*i].cell();
  }
  return std::nullopt;
}

/// Straight out of the box from a corner of the cell, or to its side where no
/// number is farther out.
Point3 LabelWindow::far_point(CellId from, unsigned direction) const {
  const Cell& cell = whole_.cell(from);
  const auto k = static_cast<Eigen::Index>(direction / 2);
  Point3 result = whole_.point(cell.vertex[0]);
  const double width = box_[1][k] - box_[0][k];
  const double far =
      direction % 2 == 0 ? box_[1][k] + width : box_[0][k] - width;
  constexpr double kMost = std::numeric_limits<double>::max();
  result[k] = std::clamp(far, -kMost, kMost);
  return result;
}

/// One that the point is strictly beyond; none if it lies in the cell.
std::optional<unsigned> LabelWindow::facet_towards(const Cell& cell,
                                                   const Point3& point) const {
  for (unsigned i = 0; i < 4; ++i) {
    std::array<const double*, 4> at;
    for (unsigned k = 0; k < 4; ++k)
      at[k] = k == i ? point.data() : whole_.point(cell.vertex[k]).data();
    if (predicates::orient3d(at[0], at[1], at[2], at[3]) < 0) return i;
  }
  return std::nullopt;
}

bool LabelWindow::is_near(const Triangle& corners) const {
  return std::any_of(corners.begin(), corners.end(), [this](VertexId v) {
    return marks_[index(v)] == Mark::Near;
  });
}

bool LabelWindow::is_kept(const Triangle& corners) const {
  return std::binary_search(all_kept_.begin(), all_kept_.end(),
                            LocatedTriangle{corners, {}}, by_corners);
}

std::vector<LocatedTriangle> LabelWindow::with_rest(
    std::span<const LocatedTriangle> triangles) const {
  std::vector<LocatedTriangle> inside(triangles.begin(), triangles.end());
  for (LocatedTriangle& t : inside) {
    for (VertexId& v : t.corners) v = to_original(v);
    t.facet = original_in_lower_cell(t.facet);
  }
  std::vector<LocatedTriangle> outside;
  auto next = place_of_kept_.begin();
  for (std::size_t i = 0; i < all_kept_.size(); ++i) {
    if (next != place_of_kept_.end() && *next == i)
      ++next;
    else
      outside.push_back(all_kept_[i]);
  }
  std::vector<LocatedTriangle> result;
  result.reserve(outside.size() + inside.size());
  std::merge(outside.begin(), outside.end(), inside.begin(), inside.end(),
             std::back_inserter(result), by_corners);
  return result;
}

/// From the side of a cell that the window has, then from the lower one.
Facet LabelWindow::original_in_lower_cell(Facet f) const {
  if (triangulation().cell(f.cell()).is_infinite())
    f = triangulation().cell(f.cell()).neighbor[f.index()];
  const Facet here = cells_->to_original(f);
  const Facet other = whole_.cell(here.cell()).neighbor[here.index()];
  return other.cell() < here.cell() ? other : here;
}

}  // namespace umbrella
