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
    order_.assign(at_v.begin(), at_v.end());
    std::sort(order_.begin(), order_.end(),
              [this](TriangleIndex a, TriangleIndex b) {
                return ranks_before(triangles_[a], triangles_[b]);
              });
    graph_.clear();
    const auto closing =
        std::find_if(order_.begin(), order_.end(), [&](TriangleIndex t) {
          return graph_.add(opposite_edge(triangles_[t].corners, v));
        });
    if (closing == order_.end()) return {};

    const std::vector<bool>& stays = graph_.peel();
    std::size_t n = 0;
    for (std::size_t k = 0; k < stays.size(); ++k)
      if (stays[k]) order_[n++] = order_[k];
    return std::span(order_).first(n);
  }

 private:
  std::span<const RankedTriangle> triangles_;
  LinkGraph graph_;
  std::vector<TriangleIndex> order_;
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
