// Kruskal at every vertex: union-find over the link graph tells the first edge
// that closes a cycle, and peeling leaves off what was taken so far leaves the
// cycle alone. The paper searches the graph anew after each triangle; this is
// near linear in all.
#include "umbrella/filter.h"

#include <algorithm>
#include <cstdint>

#include "umbrella/incidence_internal.h"
#include "umbrella/link_graph_internal.h"

namespace umbrella {
namespace {

/// The umbrella of one vertex after another.
class UmbrellaPicker {
 public:
  UmbrellaPicker(std::size_t n_vertices,
                 std::span<const RankedTriangle> triangles)
      : triangles_(triangles), graph_(n_vertices) {}

  /// @param at_v  the triangles at v
  /// @return the umbrella at v, empty if there is none; valid until the next
  ///   call
  std::span<const TriangleIndex> pick(VertexId v,
                                      std::span<const TriangleIndex> at_v) {
    order_.clear();
    for (const TriangleIndex t : at_v)
      order_.push_back({triangles_[t].rank.primary, t});
    std::sort(
        order_.begin(), order_.end(), [this](const Ranked& a, const Ranked& b) {
          return a.primary != b.primary
                     ? a.primary < b.primary
                     : ranks_before(triangles_[a.index], triangles_[b.index]);
        });
    graph_.clear();
    const auto closing =
        std::find_if(order_.begin(), order_.end(), [&](const Ranked& t) {
          return graph_.add(opposite_edge(triangles_[t.index].corners, v));
        });
    if (closing == order_.end()) return {};

    const std::vector<bool>& stays = graph_.peel();
    umbrella_.clear();
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k]) umbrella_.push_back(order_[k].index);
    return umbrella_;
  }

 private:
  struct Ranked {
    double primary;  // of the rank: decides most comparisons
    TriangleIndex index;
  };

  std::span<const RankedTriangle> triangles_;
  LinkGraph graph_;
  std::vector<Ranked> order_;
  std::vector<TriangleIndex> umbrella_;
};

}  // namespace

FilterResult umbrella_filter(std::size_t n_vertices,
                             std::span<const RankedTriangle> triangles) {
  const Incidence incidence(
      n_vertices, triangles.size(),
      [&](TriangleIndex t) -> const Triangle& { return triangles[t].corners; });

  FilterResult result;
  UmbrellaPicker picker(n_vertices, triangles);
  std::vector<bool> chosen(triangles.size());
  for (std::size_t i = 0; i < n_vertices; ++i) {
    const VertexId v{static_cast<std::uint32_t>(i)};
    const auto umbrella = picker.pick(v, incidence.at(v));
    if (umbrella.empty()) result.without_umbrella.push_back(v);
    for (const TriangleIndex t : umbrella) chosen[t] = true;
  }

  for (TriangleIndex t = 0; t < triangles.size(); ++t)
    if (chosen[t]) result.triangles.push_back(triangles[t]);
  return result;
}

}  // namespace umbrella
