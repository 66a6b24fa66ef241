/// @file
/// Curves of low cost: links are exchanged along alternating trails as long as
/// that pays.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "umbrella/curve_graph_internal.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

/// The cost of links is that of their edges, and of each missing link the price
/// of its vertex. A trail drops and adds links in turn.
class CurveDescent {
 public:
  using VertexId = delaunay::VertexId;
  /// Of a missing link at a vertex; the same at every call.
  using Price = std::function<double(VertexId)>;

  CurveDescent(CurveGraph& graph, CurveLinks& links, Price price)
      : graph_(graph), links_(links), price_(std::move(price)) {}

  /// Makes trails from these vertices, and from all whose links or neighbours
  /// change, until none makes the links cheaper.
  void run(std::vector<VertexId> queue);

  /// The vertices whose links have changed, with repetitions.
  const std::vector<VertexId>& changed() const { return changed_; }
  std::size_t n_moves() const { return n_moves_; }

 private:
  struct Step {
    VertexId v, w;
    double cost;
    bool is_add;
  };

  bool improve(VertexId v);
  void follow(VertexId v, double change, double gain, unsigned depth);
  void take(VertexId v, const CurveGraph::Arc& arc, double change, double gain,
            unsigned depth);
  double rounding() const;
  bool has_step(VertexId v, VertexId w) const;
  void make(const Step& step);
  void unmake();
  void keep_if_better(double change);

  CurveGraph& graph_;
  CurveLinks& links_;
  Price price_;
  std::vector<Step> trail_;
  std::vector<Step> best_;
  double best_change_ = 0;
  unsigned n_steps_ = 0;  // since the trails from a vertex began
  std::vector<VertexId> changed_;
  std::size_t n_moves_ = 0;
};

}  // namespace umbrella
