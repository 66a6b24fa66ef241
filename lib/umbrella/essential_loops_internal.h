/// @file
/// Short loops of a surface that do not bound on it.
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
class EssentialLoops {
 public:
  /// An edge of the boundary, and the piece beyond it.
  struct Seam {
    std::array<VertexId, 2> ends;  // ascending
    std::uint32_t piece;
  };

  /// @param triangles  each edge has two, or one on the boundary
  /// @param boundary  all of it, ascending; none: one piece lies beyond
  EssentialLoops(std::size_t n_vertices, std::span<const Triangle> triangles,
                 std::span<const Seam> boundary = {});

  /// Twice the number of handles, if the surface is closed.
  std::size_t n_generators() const { return n_generators_; }

  /// Whether there is a loop that does not bound of at most `max_edges` edges.
  bool has_loop(unsigned max_edges);

  struct Found {
    /// The vertices of each loop that does not go round a tube, ascending; the
    /// short ones first, each once.
    std::vector<std::vector<VertexId>> loops;
    std::vector<VertexId> vertices;  ///< of these and the others; ascending
  };
  /// For each vertex a shortest loop through it that does not bound, if it has
  /// at most `max_edges` edges. A tube has at least kTube such loops that have
  /// no vertex in common and bound pairwise.
  Found shortest(unsigned max_edges);
  /// The same for some vertices, ascending.
  Found shortest(std::span<const VertexId> starts, unsigned max_edges);
  static constexpr std::size_t kTube = 4;

 private:
  struct Edge {
    std::array<VertexId, 2> ends;
    std::array<std::uint32_t, 2> faces;
  };
  struct Spoke {
    VertexId end;
    std::uint32_t edge;
  };
  /// A vertex met, and how.
  struct Step {
    VertexId vertex;
    std::uint32_t from;  // position among the steps
    unsigned depth;
  };
  using DualForest = std::vector<std::uint32_t>;
  using Word = std::uint64_t;
  struct Loop {
    std::vector<VertexId> vertices;  // ascending
    std::vector<Word> label;
  };

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
  std::span<const Word> label(std::uint32_t edge) const {
    const std::uint32_t row = row_of_edge_[edge];
    return row == kNoLabel
               ? std::span<const Word>()
               : std::span(label_).subspan(row * n_words_, n_words_);
  }
  std::uint32_t across(std::uint32_t face, std::uint32_t edge) const {
    const auto& [f, g] = edges_[edge].faces;
    return f == face ? g : f;
  }
  std::span<const Spoke> spokes(VertexId v) const {
    return std::span(spokes_).subspan(begin_[index(v)],
                                      begin_[index(v) + 1] - begin_[index(v)]);
  }
  std::vector<VertexId> labelled_ends() const;
  std::vector<VertexId> widened(std::span<const VertexId> vertices,
                                unsigned n_edges) const;
  std::vector<Loop> shortest_through(std::span<const VertexId> starts,
                                     unsigned max_edges);
  Found sort_out(std::vector<Loop> loops);
  Loop shortest_through(VertexId start, unsigned max_edges);
  void walk(VertexId start, unsigned max_depth);
  std::vector<Word> label_of_loop(std::size_t a, std::size_t b,
                                  std::uint32_t edge) const;
  bool is_essential(std::size_t a, std::size_t b, std::uint32_t edge) const;
  bool go_round_tube(std::span<const Loop> loops);

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

  // Scratch.
  std::vector<Step> steps_;
  std::vector<Word> label_of_step_;
  std::vector<std::uint32_t> step_of_vertex_;
};

}  // namespace umbrella
