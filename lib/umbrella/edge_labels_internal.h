/// @file
/// What a loop of a surface bounds, told by labels on the edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/triangle.h"

namespace umbrella {

/// The homology of a surface with coefficients in Z/2: each edge has a label of
/// one bit a generator, and a loop of edges bounds some of the triangles, as
/// every loop of a sphere does, if its labels add up to zero.
///
/// An edge that is in neither a spanning forest of the dual edges nor one of
/// the edges is a generator [Eppstein03]; its bit is set on the edges that the
/// cycle of its dual edge with the dual forest crosses.
///
/// What lies beyond the boundary is in pieces, each a face of the dual graph,
/// so that its whole boundary bounds. With one piece these are the loops that
/// do not bound on the triangles alone; with the pieces that the rest of a
/// closed surface has, those that do not bound on that surface.
class EdgeLabels {
 public:
  using Word = std::uint64_t;
  static constexpr std::size_t kBits = 64;  // of a word

  /// An edge of the boundary, and the piece beyond it.
  struct Seam {
    std::array<VertexId, 2> ends;  // ascending
    std::uint32_t piece;
  };
  /// An edge at a vertex.
  struct Spoke {
    VertexId end;
    std::uint32_t edge;
  };

  /// @param triangles  each edge has two, or one on the boundary
  /// @param boundary  all of it, ascending; none: one piece lies beyond
  EdgeLabels(std::size_t n_vertices, std::span<const Triangle> triangles,
             std::span<const Seam> boundary = {});

  std::size_t n_vertices() const { return begin_.size() - 1; }
  /// Twice the number of handles, if the surface is closed.
  std::size_t n_generators() const { return n_generators_; }
  /// Of a label.
  std::size_t n_words() const { return n_words_; }

  std::span<const Spoke> spokes(VertexId v) const {
    return std::span(spokes_).subspan(begin_[index(v)],
                                      begin_[index(v) + 1] - begin_[index(v)]);
  }
  /// None if it is zero, or else of n_words(); some of these are zero, too.
  std::span<const Word> label(std::uint32_t edge) const {
    const std::uint32_t row = row_of_edge_[edge];
    return row == kNoLabel
               ? std::span<const Word>()
               : std::span(label_).subspan(row * n_words_, n_words_);
  }
  /// The smaller ends of edges whose label is not zero; ascending.
  std::vector<VertexId> labelled_ends() const;

 private:
  struct Edge {
    std::array<VertexId, 2> ends;
    std::array<std::uint32_t, 2> faces;
  };
  using DualForest = std::vector<std::uint32_t>;

  void find_edges(std::span<const Triangle> triangles,
                  std::span<const Seam> boundary);
  void add_edge(const Edge& edge);
  void find_spokes();
  DualForest dual_forest() const;
  void grow_dual_tree(std::uint32_t root, DualForest& entry) const;
  std::vector<std::uint32_t> generators(const DualForest& entry) const;
  void prune(std::vector<bool>& is_left) const;
  void label_edges(const DualForest& entry,
                   std::span<const std::uint32_t> generators);
  void toggle(std::uint32_t edge, std::size_t generator);
  void toggle_way_up(std::uint32_t face, const DualForest& entry,
                     std::size_t generator);
  std::uint32_t across(std::uint32_t face, std::uint32_t edge) const {
    const auto& [f, g] = edges_[edge].faces;
    return f == face ? g : f;
  }
  std::size_t n_faces() const {
    return edges_of_triangle_.size() + edges_of_piece_.size();
  }
  std::span<const std::uint32_t> edges_of(std::uint32_t face) const {
    if (face < edges_of_triangle_.size()) return edges_of_triangle_[face];
    return edges_of_piece_[face - edges_of_triangle_.size()];
  }

  std::vector<Edge> edges_;
  // Faces are the triangles, then the pieces beyond the boundary.
  std::vector<std::array<std::uint32_t, 3>> edges_of_triangle_;
  std::vector<std::vector<std::uint32_t>> edges_of_piece_;
  std::vector<Spoke> spokes_;
  std::vector<std::size_t> begin_;
  std::size_t n_generators_ = 0;
  std::size_t n_words_ = 0;
  // Few edges have a label: those have rows of n_words_ words.
  static constexpr std::uint32_t kNoLabel = 0xffff'ffffU;
  std::vector<std::uint32_t> row_of_edge_;
  std::vector<std::uint32_t> labelled_;  // by row: the edge
  std::vector<Word> label_;
};

}  // namespace umbrella
