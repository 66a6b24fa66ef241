#include "umbrella/methods.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "umbrella/complexes.h"
#include "umbrella/criteria.h"
#include "umbrella/incidence_internal.h"
#include "umbrella/link_graph_internal.h"
#include "umbrella/solids.h"
#include "umbrella/voronoi_filters.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;
using Parameters = std::array<double, 2>;
using Triangles = std::vector<LocatedTriangle>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Entry {
  MethodInfo info;
  std::size_t n_parameters;
  Parameters usual;
  double least, most;  // of a parameter; of two the first is not larger
  Triangles (*triangles)(const Triangulation3&, const Circumspheres&,
                         const Parameters&);
};

/// An alpha below zero asks for the smallest that touches every vertex.
Triangles by_alpha(const Triangulation3& t, const Circumspheres& spheres,
                   const Parameters& p) {
  const double alpha =
      p[0] >= 0 ? p[0] : smallest_alpha(t, spheres).value_or(0);
  return alpha_shape(t, spheres, alpha);
}

constexpr auto kEntries = std::to_array<Entry>({
    {{"umbrella", "", "the paper's filter"}, 0, {}, 0, 0, nullptr},
    {{"gabriel", "", "Gabriel complex"},
     0,
     {},
     0,
     0,
     [](const auto& t, const auto& s, const auto&) {
       return gabriel_complex(t, s);
     }},
    {{"lambda", "lower:upper", "lambda-complex; 0.5:1 if not given"},
     2,
     {0.5, 1},
     0,
     1,
     [](const auto& t, const auto& s, const auto& p) {
       return lambda_complex(t, s, p[0], p[1]);
     }},
    {{"alpha", "radius", "alpha-shape; the smallest with all points on it"},
     1,
     {-1},
     0,
     kInfinity,
     by_alpha},
    {{"beta", "beta", "beta-skeleton; 1.1"},
     1,
     {1.1},
     1,
     kInfinity,
     [](const auto& t, const auto& s, const auto& p) {
       return beta_skeleton(t, s, p[0]);
     }},
    {{"gamma", "c0:c1", "gamma-graph; 0:0.5"},
     2,
     {0, 0.5},
     -1,
     1,
     [](const auto& t, const auto& s, const auto& p) {
       return gamma_graph(t, s, p[0], p[1]);
     }},
    {{"crust", "", "Crust: no pole in the circumball"},
     0,
     {},
     0,
     0,
     [](const auto& t, const auto& s, const auto&) { return crust(t, s); }},
    {{"cocone", "degrees", "Cocone: dual edges across the normal; 22.5"},
     1,
     {22.5},
     0,
     90,
     [](const auto& t, const auto& s, const auto& p) {
       return cocone(t, s, p[0] * std::numbers::pi / 180);
     }},
    {{"sculpture", "", "carved from the hull, large bulges first"},
     0,
     {},
     0,
     0,
     [](const auto& t, const auto& s, const auto&) {
       return sculpture(t, s, CarveOrder::Bulge);
     }},
    {{"constriction", "", "carved from the hull, large gammas first"},
     0,
     {},
     0,
     0,
     [](const auto& t, const auto& s, const auto&) {
       return sculpture(t, s, CarveOrder::Gamma);
     }},
    {{"ballmerge", "delta", "BallMerge: cells with like balls merge; 1.8"},
     1,
     {1.8},
     0,
     2,
     [](const auto& t, const auto& s, const auto& p) {
       return ball_merge(t, s, p[0]);
     }},
});

constexpr auto kInfos = [] {
  std::array<MethodInfo, kEntries.size()> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kEntries[i].info;
  return infos;
}();

const Entry& find(std::string_view name) {
  const auto entry =
      std::find_if(kEntries.begin(), kEntries.end(),
                   [&](const Entry& e) { return e.info.name == name; });
  if (entry == kEntries.end())
    throw std::invalid_argument("there is no method '" + std::string(name) +
                                "'");
  return *entry;
}

[[noreturn]] void refuse(const Entry& entry) {
  std::string usage(entry.info.name);
  if (entry.n_parameters > 0) usage += "=" + std::string(entry.info.parameters);
  throw std::invalid_argument("method " + usage +
                              ": wrong number, kind or range of parameters");
}

Parameters numbers(const Entry& entry, std::string_view text) {
  Parameters result = {};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < entry.n_parameters; ++i) {
    if (i > 0 && (at == end || *at++ != ':')) refuse(entry);
    const auto [next, error] = std::from_chars(at, end, result[i]);
    if (error != std::errc() ||
        !(result[i] >= entry.least && result[i] <= entry.most))
      refuse(entry);
    at = next;
  }
  const bool is_ordered = entry.n_parameters < 2 || result[0] <= result[1];
  if (at != end || entry.n_parameters == 0 || !is_ordered) refuse(entry);
  return result;
}

std::vector<VertexId> vertices_without_umbrella(
    std::size_t n_vertices, std::span<const RankedTriangle> triangles) {
  const Incidence incidence(
      n_vertices, triangles.size(),
      [&](TriangleIndex t) -> const Triangle& { return triangles[t].corners; });
  std::vector<VertexId> result;
  LinkGraph graph(n_vertices);
  for (std::uint32_t i = 0; i < n_vertices; ++i) {
    graph.clear();
    for (const TriangleIndex t : incidence.at(VertexId{i}))
      graph.add(opposite_edge(triangles[t].corners, VertexId{i}));
    if (!graph.has_cycle()) result.push_back(VertexId{i});
  }
  return result;
}

}  // namespace

std::span<const MethodInfo> all_methods() { return kInfos; }

Method parse_method(std::string_view text) {
  const std::size_t sign = text.find('=');
  const Entry& entry = find(text.substr(0, sign));
  if (sign == std::string_view::npos) return {entry.info.name, entry.usual};
  return {entry.info.name, numbers(entry, text.substr(sign + 1))};
}

std::vector<LocatedTriangle> method_triangles(
    const Method& method, const Triangulation3& triangulation,
    const Circumspheres& spheres) {
  return find(method.name).triangles(triangulation, spheres, method.parameters);
}

FilterResult method_filter(const Method& method,
                           const Triangulation3& triangulation,
                           const Circumspheres& spheres) {
  const auto chosen = method_triangles(method, triangulation, spheres);
  const RankedTriangles all =
      ranked_triangles(triangulation, spheres, LambdaCriterion{});
  std::vector<RankedTriangle> ranked;
  std::ranges::copy_if(all, std::back_inserter(ranked), [&](const auto& t) {
    return std::binary_search(chosen.begin(), chosen.end(),
                              LocatedTriangle{t.corners, t.facet}, by_corners);
  });
  FilterResult result;
  result.triangles = RankedTriangles(std::move(ranked), all.order());
  result.without_umbrella = vertices_without_umbrella(
      triangulation.points().size(), result.triangles);
  return result;
}

}  // namespace umbrella
