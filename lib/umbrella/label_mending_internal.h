/// @file
/// From any labels to labels whose surface is manifold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "umbrella/label_frame_internal.h"

namespace umbrella {

/// Switches cells at faulty vertices until there is none. Where no switch of
/// open cells helps, the ring of the vertex is opened.
class LabelMending {
 public:
  /// @param frame, labels  changed; must outlive this object
  LabelMending(LabelFrame& frame, Labelling& labels);

  /// @return how many vertices were faulty at first
  std::size_t run();

 private:
  using Cells = std::vector<delaunay::CellId>;

  /// What switching some cells would change; the smaller, the better.
  struct Effect {
    std::int64_t faults = 0;
    std::int64_t points_lost = 0;
    std::int64_t kept_lost = 0;
    double worst = 0;  // of the triangles that would come
  };

  /// Which cells may be switched.
  enum class Licence {
    Open,  // open ones that were not forced
    Fill   // from outside to inside
  };

  bool is_spent();
  bool improve(VertexId v);
  void force(VertexId v);
  bool open_ring(VertexId v);
  void apply(const Cells& cells);
  void refresh(std::span<const delaunay::CellId> cells);

  void propose(VertexId v, Licence licence);
  void propose_path(VertexId v, std::size_t part, Licence licence);
  bool is_allowed(delaunay::CellId c, Licence licence) const;
  Effect effect_of(const Cells& cells);
  void count_facets(delaunay::CellId c, int sign, Effect& effect) const;
  static bool is_better(const Effect& a, const Effect& b, bool is_forced);
  std::optional<std::size_t> best(bool is_forced);

  LabelFrame& frame_;
  Labelling& labels_;
  std::vector<std::uint32_t> faults_;    // by vertex
  std::vector<std::uint8_t> is_frozen_;  // by cell: forced once
  std::vector<std::uint8_t> ring_is_open_;
  std::priority_queue<VertexId, std::vector<VertexId>, std::greater<>> faulty_;
  std::priority_queue<VertexId, std::vector<VertexId>, std::greater<>> stuck_;
  std::uint64_t effort_ = 0;
  std::uint64_t effort_limit_ = 0;

  // Scratch.
  StarParts parts_, other_parts_;
  std::vector<Cells> proposals_;
  std::vector<std::uint32_t> slot_;  // of a cell: its place in the star
  std::vector<VertexId> corners_;
};

}  // namespace umbrella
