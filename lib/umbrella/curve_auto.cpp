#include "umbrella/curve_auto.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "umbrella/curve_descent_internal.h"
#include "umbrella/curve_graph_internal.h"
#include "umbrella/curve_links_internal.h"
#include "umbrella/curve_picks_internal.h"
#include "umbrella/curve_pieces_internal.h"
#include "umbrella/curve_spacing_internal.h"

// Links that both ends pick are taken as they are [Adamy02, Sec. 3.1]. Near
// vertices that lack links, and near links that look like gaps, the links are
// exchanged until they are of low cost (curve_descent), small closed pieces are
// joined to what lies near them, and curves so changed are made shortest
// (curve_tour). docs/curve.md "Auto" has the constants and what chose them.

namespace umbrella {
namespace {

using delaunay::Triangulation2;
using delaunay::VertexId;

// Half a gap, in spacings, for even samples, and how it grows with the spread.
constexpr double kEndPrice = 2;
constexpr double kSpreadPower = 3;
// Spacings that joining a piece may cost, as a part of kEndPrice.
constexpr double kJoinPart = 0.75;

// Sums of a few prices are finite, so that what a trail gains is a number.
constexpr double kMostPrice = std::numeric_limits<double>::max() / 64;

double end_price(const CurveAutoOptions& options, const Triangulation2& t,
                 const CurveLinks& agreed) {
  if (options.gap) return *options.gap / 2;
  return kEndPrice * std::pow(spread(t, agreed), kSpreadPower);
}

/// Prices and spacings, by the links that both ends have picked; kept, for they
/// are asked for often.
class Spacings {
 public:
  Spacings(CurveGraph& graph, const CurveLinks& agreed)
      : graph_(graph), agreed_(agreed), known_(agreed.n_vertices()) {}

  double operator()(VertexId v) {
    double& known = known_[index(v)];
    if (known == 0) known = spacing(graph_, agreed_, v);
    return known;
  }

 private:
  CurveGraph& graph_;
  const CurveLinks& agreed_;
  std::vector<double> known_;  // 0: not yet
};

/// Vertices that lack links, or have one that may be a gap.
std::vector<VertexId> ambiguous(const Triangulation2& t,
                                const CurveLinks& agreed, double price) {
  std::vector<VertexId> found;
  for (std::uint32_t i = 0; i < agreed.n_vertices(); ++i) {
    const VertexId v{i};
    if (!agreed.is_full(v)) {
      found.push_back(v);
      continue;
    }
    // A gap is at least twice the price longer than the median of the links
    // about it, so also than the shorter one here, but where gaps follow gaps.
    const auto length2 = [&](VertexId w) {
      return (t.point(w) - t.point(v)).squaredNorm();
    };
    const auto& [one, other] = agreed[v];
    const std::array<double, 2> lengths = {length2(one), length2(other)};
    const auto [least, most] = std::ranges::minmax(lengths);
    if (most <= 4 * price * price * least) continue;
    const VertexId far = lengths[0] == most ? one : other;
    const double spacing =
        std::min(link_spacing(t, agreed, v), link_spacing(t, agreed, far));
    if (std::sqrt(most) > 2 * price * spacing) found.push_back(v);
  }
  return found;
}

class AutoCurves {
 public:
  AutoCurves(const Triangulation2& t, const CurveAutoOptions& options)
      : t_(t),
        options_(options),
        picked_(pick_edges(t)),
        links_(agreed_links(picked_)) {}

  CurveAutoResult run() {
    count_picks();
    const double price = end_price(options_, t_, links_);
    report_.gap = 2 * price;
    const std::vector<VertexId> doubtful = ambiguous(t_, links_, price);
    report_.ambiguous = doubtful.size();
    if (!doubtful.empty() || options_.join_all) mend(doubtful, price);
    return result();
  }

 private:
  void mend(const std::vector<VertexId>& doubtful, double price) {
    CurveGraph& graph = graph_.emplace(t_);
    const CurveLinks agreed = links_;
    Spacings spacings(graph, agreed);
    const auto spacing_at = [&](VertexId v) { return spacings(v); };
    CurveDescent descent(graph, links_, [&](VertexId v) {
      return std::min(price * spacings(v), kMostPrice);
    });
    descent.run(with_neighbors(graph, doubtful));
    report_.moves = descent.n_moves();

    std::vector<VertexId> changed = doubtful;
    changed.insert(changed.end(), descent.changed().begin(),
                   descent.changed().end());
    make_distinct(changed);
    join(graph, {spacing_at, kJoinPart * price, price}, changed);
    if (options_.join_all) return;
    const PieceChanges changes = shorten_pieces(graph, links_, changed);
    report_.tours = changes.tours;
    report_.turns = changes.turns;
    drop_scattered(2 * price * typical_spacing(t_, agreed));
  }

  /// Pieces of a few vertices that are all far apart are no curves.
  void drop_scattered(double far) {
    const auto is_near_to = [&](VertexId v) {
      return [this, v, far](VertexId w) {
        return w != CurveLinks::kNone &&
               (t_.point(w) - t_.point(v)).stableNorm() <= far;
      };
    };
    for (std::uint32_t i = 0; i < links_.n_vertices(); ++i) {
      if (std::ranges::any_of(links_[VertexId{i}], is_near_to(VertexId{i})))
        continue;
      const std::vector<VertexId> piece = piece_at(VertexId{i});
      if (piece.size() > kTinyPiece ||
          std::ranges::any_of(piece, [&](VertexId v) {
            return std::ranges::any_of(links_[v], is_near_to(v));
          }))
        continue;
      for (const VertexId v : piece) drop_links(v);
    }
  }

  void drop_links(VertexId v) {
    const std::array<VertexId, 2> old = links_[v];
    for (const VertexId w : old)
      if (w != CurveLinks::kNone) links_.drop(v, w);
  }

  /// All vertices of the piece, or more than kTinyPiece of them.
  std::vector<VertexId> piece_at(VertexId v) const {
    std::vector<VertexId> piece = {v};
    for (std::size_t k = 0; k < piece.size() && piece.size() <= kTinyPiece; ++k)
      for (const VertexId w : links_[piece[k]])
        if (w != CurveLinks::kNone && std::ranges::count(piece, w) == 0)
          piece.push_back(w);
    return piece;
  }

  void join(CurveGraph& graph, PieceRules rules,
            std::vector<VertexId>& changed) {
    std::vector<VertexId> seeds = changed;
    if (options_.join_all) {
      rules.most = std::numeric_limits<double>::infinity();
      for (std::uint32_t v = 0; v < links_.n_vertices(); ++v)
        seeds.push_back(VertexId{v});
    }
    std::size_t n_joined = 0;
    do {
      n_joined = join_pieces(graph, links_, seeds, rules, changed);
      report_.joined += n_joined;
    } while (options_.join_all && n_joined > 0);
    make_distinct(changed);
  }

  static void make_distinct(std::vector<VertexId>& vertices) {
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()),
                   vertices.end());
  }

  static std::vector<VertexId> with_neighbors(
      CurveGraph& graph, const std::vector<VertexId>& vertices) {
    std::vector<VertexId> all = vertices;
    for (const VertexId v : vertices)
      for (const CurveGraph::Arc& arc : graph.arcs(v)) all.push_back(arc.to);
    make_distinct(all);
    return all;
  }

  void count_picks() {
    std::size_t n_agreed = 0;
    for (std::uint32_t v = 0; v < links_.n_vertices(); ++v) {
      if (picked_.others[v][1] == CurveLinks::kNone)
        ++report_.without_umbrella;
      else
        report_.filter_edges += 2;
      for (const VertexId w : links_[VertexId{v}])
        n_agreed += w != CurveLinks::kNone && VertexId{v} < w ? 1 : 0;
    }
    report_.filter_edges -= n_agreed;
    report_.gabriel_edges = picked_.n_gabriel;
  }

  double lambda_of(VertexId v, VertexId w) {
    if (w == CurveLinks::kNone) return 0;
    for (const unsigned i : {0, 1})
      if (picked_.others[index(v)][i] == w)
        return std::sqrt(picked_.lambda2[index(v)][i]);
    return graph_->arc(v, w)->lambda;
  }

  CurveAutoResult result() {
    CurveAutoResult result;
    result.report = report_;
    for (std::uint32_t i = 0; i < links_.n_vertices(); ++i) {
      const auto& [w, x] = links_[VertexId{i}];
      picked_.lambda2[i] = {lambda_of(VertexId{i}, w),
                            lambda_of(VertexId{i}, x)};
    }
    result.lambda = std::move(picked_.lambda2);
    result.links = std::move(links_).release();
    return result;
  }

  const Triangulation2& t_;
  CurveAutoOptions options_;
  PickedEdges picked_;
  CurveLinks links_;
  std::optional<CurveGraph> graph_;  // where there was something to mend
  CurveAutoReport report_;
};

}  // namespace

CurveAutoResult auto_curves(const Triangulation2& triangulation,
                            const CurveAutoOptions& options) {
  return AutoCurves(triangulation, options).run();
}

}  // namespace umbrella
