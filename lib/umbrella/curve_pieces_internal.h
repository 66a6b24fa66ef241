/// @file
/// Closed curves that are parts of others: joined to them, and made shortest.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "umbrella/curve_graph_internal.h"
#include "umbrella/curve_links_internal.h"

namespace umbrella {

struct PieceRules {
  std::function<double(delaunay::VertexId)> spacing;
  /// A piece is joined if the exchange costs at most so many spacings, one of
  /// at most kTinyPiece vertices if it costs twice as many.
  double most = 0;
  double end_price = 0;  ///< spacings that a missing link costs
};

inline constexpr std::size_t kTinyPiece = 6;

/// Opens each closed curve through one of the seeds into a neighbour: one link
/// of each is exchanged for two between them, or with an end of an open curve.
/// @param changed  the vertices of these links are added
/// @return how many pieces were joined
std::size_t join_pieces(CurveGraph& graph, CurveLinks& links,
                        std::span<const delaunay::VertexId> seeds,
                        const PieceRules& rules,
                        std::vector<delaunay::VertexId>& changed);

struct PieceChanges {
  std::size_t tours = 0;  ///< curves proven to be the cheapest by their edges
  std::size_t turns = 0;  ///< exchanges for the sake of corners
};

/// Makes each closed curve through one of the seeds the cheapest one on its
/// vertices, then exchanges links where that makes corners cheaper; links more
/// than a few steps from all seeds stay.
PieceChanges shorten_pieces(CurveGraph& graph, CurveLinks& links,
                            std::span<const delaunay::VertexId> seeds);

}  // namespace umbrella
