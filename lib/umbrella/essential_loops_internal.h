/// @file
/// Short loops of a surface that do not bound on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/edge_labels_internal.h"

namespace umbrella {

/// Loops whose labels do not add up to zero.
class EssentialLoops {
 public:
  using Seam = EdgeLabels::Seam;

  /// As for EdgeLabels.
  EssentialLoops(std::size_t n_vertices, std::span<const Triangle> triangles,
                 std::span<const Seam> boundary = {});

  /// EdgeLabels::n_generators.
  std::size_t n_generators() const { return labels_.n_generators(); }

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

  /// Vertices such that each loop that does not bound of at most `max_edges`
  /// edges goes through one of them; ascending.
  std::vector<VertexId> starts(unsigned max_edges);
  /// The vertices of each; ascending.
  using Loops = std::vector<std::vector<VertexId>>;
  /// Of the shortest loops of at most `max_edges` edges through each of
  /// starts() at most `n_alike` that bound pairwise; as often as there are some
  /// of which no sum with those before bounds. The short ones first, both
  /// times.
  std::vector<Loops> independent(unsigned max_edges, std::size_t n_alike);

 private:
  using Word = EdgeLabels::Word;
  using Spoke = EdgeLabels::Spoke;
  /// A vertex met, and how.
  struct Step {
    VertexId vertex;
    std::uint32_t from;  // position among the steps
    unsigned depth;
  };
  /// The edge between two steps that closes a loop.
  struct Closing {
    std::array<std::uint32_t, 2> steps;  // ascending
    std::uint32_t edge;
    unsigned n_edges;  // of the loop
  };
  struct Loop {
    std::vector<VertexId> vertices;  // ascending
    std::vector<Word> label;
  };

  std::vector<Loop> shortest_through(std::span<const VertexId> starts,
                                     unsigned max_edges);
  Found sort_out(std::vector<Loop> loops);
  Loop shortest_through(VertexId start, unsigned max_edges);
  Closing walk(VertexId start, unsigned max_edges);
  void enter(std::uint32_t from, const Spoke& spoke);
  std::vector<Word> label_of_loop(std::size_t a, std::size_t b,
                                  std::uint32_t edge) const;
  bool is_essential(std::size_t a, std::size_t b, std::uint32_t edge) const;
  bool go_round_tube(std::span<const Loop> loops);

  const EdgeLabels labels_;

  // Scratch.
  std::vector<Step> steps_;
  std::vector<Word> label_of_step_;
  std::vector<std::uint32_t> step_of_vertex_;
};

}  // namespace umbrella
