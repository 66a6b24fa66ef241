/// @file
/// Closed curves of low cost whose corners count too: links are exchanged along
/// alternating trails that leave the curve one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrella/curve_graph_internal.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

/// The cost of a curve is that of its edges and, for each corner with sides a
/// and b and the angle theta, 1.5 min(|a|, |b|) cos^2(theta / 2).
class CurveStraightening {
 public:
  using VertexId = delaunay::VertexId;

  CurveStraightening(CurveGraph& graph, CurveLinks& links);

  /// Exchanges links between the vertices given until no trail makes the curve
  /// cheaper; those between other vertices stay.
  ///
  /// @param near  some vertices of a closed curve, in its order
  /// @return the number of exchanges
  std::size_t run(std::span<const VertexId> near);

 private:
  bool improve(VertexId v);
  void follow(double gain, unsigned depth);
  void take(const CurveGraph::Arc& arc, double gain, unsigned depth);
  void close(const CurveGraph::Arc& arc, double gain);
  void make_best();
  void number_places();

  bool can_drop(VertexId v, VertexId w) const;
  bool has_dropped(VertexId v, VertexId w) const { return has_step(0, v, w); }
  bool has_added(VertexId v, VertexId w) const { return has_step(1, v, w); }
  bool has_step(std::size_t first, VertexId v, VertexId w) const;
  double corner(VertexId v) const;
  double change_of_corners() const;

  /// A place between two neighbours on the curve where a link was dropped.
  struct Cut {
    std::uint32_t place;  ///< of the former one
    std::uint32_t step;   ///< of the trail, half of the index of its first end
    bool forward;         ///< the trail drops the link in the curve's sense
  };
  std::vector<Cut> cuts() const;
  std::vector<std::uint32_t> sides_met(const std::vector<Cut>& cuts) const;
  std::uint32_t n_near() const {
    return static_cast<std::uint32_t>(ring_.size());
  }

  CurveGraph& graph_;
  CurveLinks& links_;
  std::vector<std::uint32_t> place_;  // of a vertex in ring_
  std::vector<VertexId> ring_;        // the near vertices, in order
  std::vector<double> corner_;        // of a vertex, before the trail
  std::vector<bool> is_queued_;       // of a vertex
  // Vertices t0, t1, ...: links t0 t1, t2 t3, ... are dropped and t1 t2, t3 t4,
  // ... added; closed when the last one is linked to t0.
  std::vector<VertexId> trail_;
  std::vector<VertexId> best_;
  double best_change_ = 0;
  unsigned n_steps_ = 0;  // since the trails from a vertex began
};

}  // namespace umbrella
