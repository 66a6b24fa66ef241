#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "umbrella/curve_spacing_internal.h"

namespace umbrella {
namespace {

using delaunay::Triangulation2;
using delaunay::VertexId;

constexpr std::size_t kEnough = 10'000;

double length(const Triangulation2& t, VertexId v, VertexId w) {
  return std::min((t.point(v) - t.point(w)).stableNorm(), 0x1p1000);
}

}  // namespace

double link_spacing(const Triangulation2& t, const CurveLinks& links,
                    VertexId v) {
  constexpr unsigned kSteps = 3;
  std::array<double, 2 * kSteps> lengths{};
  std::size_t n = 0;
  for (const VertexId first : links[v]) {
    VertexId from = v;
    VertexId to = first;
    for (unsigned step = 0; step < kSteps && to != CurveLinks::kNone; ++step) {
      lengths[n++] = length(t, from, to);
      const VertexId next = links.beyond(to, from);
      from = to;
      to = next;
    }
  }
  if (n < 2) return 0;
  const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(n - 1) / 2;
  std::nth_element(lengths.begin(), median,
                   lengths.begin() + static_cast<std::ptrdiff_t>(n));
  return *median;
}

double spacing(CurveGraph& graph, const CurveLinks& links, VertexId v) {
  const Triangulation2& t = graph.triangulation();
  const double own = link_spacing(t, links, v);
  if (own > 0) return own;
  double nearest = std::numeric_limits<double>::infinity();
  double nearest_known = nearest;
  double found = 0;
  for (const CurveGraph::Arc& arc : graph.arcs(v)) {
    nearest = std::min(nearest, arc.length);
    if (arc.length >= nearest_known) continue;
    const double theirs = link_spacing(t, links, arc.to);
    if (theirs == 0) continue;
    nearest_known = arc.length;
    found = theirs;
  }
  return found > 0 ? found : nearest;
}

double typical_spacing(const Triangulation2& t, const CurveLinks& links) {
  const std::size_t stride = 1 + links.n_vertices() / kEnough;
  std::vector<double> known;
  for (std::size_t i = 0; i < links.n_vertices(); i += stride) {
    const double s =
        link_spacing(t, links, VertexId{static_cast<std::uint32_t>(i)});
    if (s > 0) known.push_back(s);
  }
  if (known.empty()) return 0;
  const auto median =
      known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::ranges::nth_element(known, median);
  return *median;
}

double spread(const Triangulation2& t, const CurveLinks& links) {
  constexpr double kMost = 100;
  const std::size_t stride = 1 + links.n_vertices() / kEnough;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < links.n_vertices(); i += stride) {
    const VertexId v{static_cast<std::uint32_t>(i)};
    for (const VertexId w : links[v]) {
      if (w == CurveLinks::kNone) continue;
      const double least =
          std::min(link_spacing(t, links, v), link_spacing(t, links, w));
      if (least > 0) ratios.push_back(length(t, v, w) / least);
    }
  }
  if (ratios.empty()) return 1;
  const auto tenth =
      ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() * 9 / 10);
  std::ranges::nth_element(ratios, tenth);
  return std::clamp(*tenth, 1.0, kMost);
}

}  // namespace umbrella
