#include "delaunay/cell_window.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "delaunay/canonical_order_internal.h"

namespace delaunay {

CellWindow::CellWindow(const Triangulation3& original,
                       std::span<const CellId> cells)
    : original_(original),
      triangulation_(std::span<const Point3>()),
      number_of_(original.points().size(), kNone),
      copy_of_(original.cells().size(), kNone) {
  triangulation_.dimension_ = 3;
  triangulation_.scale_exponent_ = original.scale_exponent();
  number_vertices(cells);
  number_cells(cells);
  copy_cells();
  add_cells_beyond();
  link_cells_beyond();
}

void CellWindow::number_vertices(std::span<const CellId> cells) {
  for (const CellId c : cells)
    for (const VertexId v : original_.cell(c).vertex) number_of_[index(v)] = 0;
  for (std::uint32_t v = 0; v < number_of_.size(); ++v) {
    if (number_of_[v] == kNone) continue;
    number_of_[v] = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(VertexId{v});
    triangulation_.points_.push_back(original_.point(VertexId{v}));
  }
}

/// By ascending corners.
void CellWindow::number_cells(std::span<const CellId> cells) {
  struct Entry {
    Corners corners;
    CellId cell;
  };
  std::vector<Entry> entries;
  entries.reserve(cells.size());
  for (const CellId c : cells)
    entries.push_back({ascending(original_.cell(c).vertex), c});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.corners < b.corners;
  });
  for (const Entry& entry : entries) {
    copy_of_[index(entry.cell)] =
        static_cast<std::uint32_t>(original_of_.size());
    original_of_.push_back(entry.cell);
  }
}

/// All but the neighbors.
void CellWindow::copy_cells() {
  triangulation_.n_finite_cells_ = original_of_.size();
  for (const CellId c : original_of_) {
    Cell cell = original_.cell(c);
    for (VertexId& v : cell.vertex) v = from_original(v);
    cell.vertex = in_canonical_order(cell.vertex);
    triangulation_.cells_.push_back(cell);
  }
}

/// By the corners of the facets where the window ends.
void CellWindow::add_cells_beyond() {
  struct Border {
    Corners corners;  // ascending, kInfinite last
    Facet facet;      // of the copy
  };
  std::vector<Border> border;
  for (std::uint32_t c = 0; c < triangulation_.n_finite_cells(); ++c)
    for (unsigned i = 0; i < 4; ++i) {
      const Facet facet(CellId{c}, i), beyond = beyond_original(facet);
      Cell& cell = triangulation_.cells_[c];
      if (has_cell(beyond.cell())) {
        cell.neighbor[i] = from_original(beyond);
        continue;
      }
      Corners corners = cell.vertex;
      corners[i] = kInfinite;
      border.push_back({ascending(corners), facet});
    }
  std::sort(border.begin(), border.end(), [](const Border& a, const Border& b) {
    return a.corners < b.corners;
  });
  for (const auto& [corners, facet] : border) add_cell_beyond(facet);
}

void CellWindow::add_cell_beyond(Facet facet) {
  const CellId id{static_cast<std::uint32_t>(triangulation_.cells().size())};
  Cell cell = triangulation_.cell(facet.cell());
  cell.vertex[facet.index()] = kInfinite;
  // Seen from the other side.
  std::swap(cell.vertex[(facet.index() + 1) % 4],
            cell.vertex[(facet.index() + 2) % 4]);
  cell.vertex = in_canonical_order(cell.vertex);
  cell.neighbor = {Facet(id, 0), Facet(id, 1), Facet(id, 2), facet};
  original_of_.push_back(beyond_original(facet).cell());
  triangulation_.cells_.push_back(cell);
  triangulation_.cells_[index(facet.cell())].neighbor[facet.index()] =
      Facet(id, 3);
}

/// Those that are infinite in the original, too: to each other, so that a walk
/// around a vertex of the hull goes on there.
void CellWindow::link_cells_beyond() {
  const std::size_t n_finite = triangulation_.n_finite_cells();
  const std::size_t first = original_.n_finite_cells();
  auto& cells = triangulation_.cells_;
  std::vector<std::uint32_t> copy_of(original_.cells().size() - first, kNone);
  for (auto c = static_cast<std::uint32_t>(n_finite); c < cells.size(); ++c)
    if (index(original_of_[c]) >= first)
      copy_of[index(original_of_[c]) - first] = c;
  for (std::size_t c = n_finite; c < cells.size(); ++c) {
    if (index(original_of_[c]) < first) continue;
    const Cell& from = original_.cell(original_of_[c]);
    for (unsigned i = 0; i < 3; ++i) {
      const Facet across = from.neighbor[i];
      const std::uint32_t other = copy_of[index(across.cell()) - first];
      if (other == kNone) continue;
      const VertexId apex =
          original_.cell(across.cell()).vertex[across.index()];
      cells[c]
          .neighbor[position(cells[c].vertex, from_original(from.vertex[i]))] =
          Facet(CellId{other},
                position(cells[other].vertex, from_original(apex)));
    }
  }
}

/// What lies across a facet of a finite cell of the copy.
Facet CellWindow::beyond_original(Facet facet) const {
  const Facet there = to_original(facet);
  return original_.cell(there.cell()).neighbor[there.index()];
}

Facet CellWindow::from_original(Facet f) const {
  const CellId copy = copy_of(f.cell());
  const VertexId apex = original_.cell(f.cell()).vertex[f.index()];
  return Facet(copy,
               position(triangulation_.cell(copy).vertex, from_original(apex)));
}

Facet CellWindow::to_original(Facet f) const {
  const CellId original = original_of(f.cell());
  const VertexId apex = triangulation_.cell(f.cell()).vertex[f.index()];
  return Facet(original,
               position(original_.cell(original).vertex, to_original(apex)));
}

}  // namespace delaunay
