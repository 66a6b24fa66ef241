/// @file
/// Cells inside and outside, and the surface between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// The cells at one vertex, in parts of one label: cells of a part hang
/// together by facets at the vertex.
class StarParts {
 public:
  struct Part {
    std::span<const delaunay::CellId> cells;
    bool is_inside;
  };

  std::size_t size() const { return begin_.size(); }
  std::size_t n_cells() const { return cells_.size(); }
  Part operator[](std::size_t i) const {
    const std::size_t end = i + 1 < size() ? begin_[i + 1] : cells_.size();
    return {std::span(cells_).subspan(begin_[i], end - begin_[i]),
            is_inside_[i]};
  }
  /// Parts beyond one of each label: none at a vertex of a manifold.
  std::size_t n_faults() const {
    const std::size_t n_inside = n_inside_, n_outside = size() - n_inside_;
    return (n_inside > 1 ? n_inside - 1 : 0) +
           (n_outside > 1 ? n_outside - 1 : 0);
  }

 private:
  friend class Labelling;
  void clear();
  void begin_part(bool is_inside);

  std::vector<delaunay::CellId> cells_;
  std::vector<std::size_t> begin_;
  std::vector<bool> is_inside_;
  std::size_t n_inside_ = 0;
};

/// The cells beyond the hull are always outside, those beyond a window as they
/// are put.
class Labelling {
 public:
  /// All cells are outside.
  /// @param triangulation  of dimension 3; must outlive this object
  explicit Labelling(const delaunay::Triangulation3& triangulation);

  const delaunay::Triangulation3& triangulation() const {
    return triangulation_;
  }
  const delaunay::Cell& cell(delaunay::CellId c) const {
    return triangulation_.cell(c);
  }
  /// Says that the triangulation is a window of a larger one, and these are the
  /// vertices at whose cells it ends. They are on the surface elsewhere, too.
  void set_border(std::span<const VertexId> vertices);
  bool is_at_border(delaunay::CellId c) const;
  /// Whether somebody has asked for more than the window shows.
  bool has_left_window() const { return has_left_window_; }
  void leave_window() { has_left_window_ = true; }
  /// Labels a cell beyond the window.
  void put_beyond(delaunay::CellId c, bool is_inside) {
    is_inside_[index(c)] = is_inside ? 1 : 0;
  }
  bool is_at_border(VertexId v) const {
    return !is_border_.empty() && is_border_[index(v)] != 0;
  }

  bool is_inside(delaunay::CellId c) const { return is_inside_[index(c)] != 0; }
  std::size_t n_inside() const { return n_inside_; }
  bool is_on_surface(delaunay::Facet f) const {
    const delaunay::CellId beyond = cell(f.cell()).neighbor[f.index()].cell();
    return is_inside(f.cell()) != is_inside(beyond);
  }
  /// Whether a triangle of the surface has this corner.
  bool is_used(VertexId v) const { return n_triangles_[index(v)] > 0; }
  /// Facets of the cell on the surface: bit i is facet i.
  unsigned surface_facets(delaunay::CellId c) const;

  /// @pre the cell is not beyond the hull
  void flip(delaunay::CellId c);

  /// The star of a vertex, into `parts`.
  void find_parts(VertexId v, StarParts& parts);

  /// All vertices with faults, ascending.
  std::vector<VertexId> faulty_vertices();

  /// Whether a triangle of the surface has the edge between corners i and k.
  bool is_edge_used(delaunay::CellId c, unsigned i, unsigned k) const;

  /// All triangles of the surface, by ascending corners.
  std::vector<LocatedTriangle> surface() const;

 private:
  template <class Visit>
  void for_each_on_surface(Visit visit) const;

  const delaunay::Triangulation3& triangulation_;
  std::vector<std::uint8_t> is_inside_;
  std::vector<std::uint32_t> n_triangles_;  // by vertex
  std::vector<delaunay::CellId> cell_of_vertex_;
  std::size_t n_inside_ = 0;
  std::vector<std::uint8_t> is_border_;  // by vertex; empty without a window
  bool has_left_window_ = false;

  std::vector<std::uint32_t> seen_;  // last walk that met the cell
  std::uint32_t n_walks_ = 0;
  std::vector<delaunay::CellId> pending_;
};

}  // namespace umbrella
