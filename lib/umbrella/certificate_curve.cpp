#include <algorithm>

#include "umbrella/certificate.h"
#include "umbrella/certificate_internal.h"

namespace umbrella {
namespace {

using certificate::Components;

std::vector<std::uint32_t> rows_without(const std::vector<bool>& is_used) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (!is_used[v]) rows.push_back(v);
  return rows;
}

}  // namespace

CurveReport check_curve(std::size_t n_vertices,
                        std::span<const IndexedEdge> edges) {
  certificate::require_rows(edges, n_vertices);
  CurveReport report;
  report.edges = edges.size();
  std::vector<std::size_t> degree(n_vertices);
  Components components(n_vertices);
  for (const auto& [a, b] : edges) {
    report.degenerate_edges += a == b ? 1 : 0;
    ++degree[a];
    ++degree[b];
    components.join(a, b);
  }
  std::vector<IndexedEdge> upward(edges.begin(), edges.end());
  for (IndexedEdge& e : upward) std::sort(e.begin(), e.end());
  report.duplicate_edges = certificate::count_repeated(upward);

  std::vector<bool> is_used(n_vertices), is_counted(n_vertices);
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    if (degree[v] == 0) continue;
    is_used[v] = true;
    report.ends += degree[v] == 1 ? 1 : 0;
    report.branchings += degree[v] > 2 ? 1 : 0;
    const std::uint32_t component = components.root(v);
    report.components += is_counted[component] ? 0 : 1;
    is_counted[component] = true;
  }
  report.unused_vertices = rows_without(is_used);
  report.vertices = n_vertices - report.unused_vertices.size();
  report.manifold = report.branchings == 0 && report.degenerate_edges == 0 &&
                    report.duplicate_edges == 0;
  report.closed = !edges.empty() && report.ends == 0 &&
                  report.branchings == 0 && report.degenerate_edges == 0;
  return report;
}

}  // namespace umbrella
