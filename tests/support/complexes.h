/// @file
/// Triangle sets without geometry, and the paper's definitions on them taken
/// word by word.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "umbrella/rank_order.h"
#include "umbrella/triangle.h"

namespace tests {

using umbrella::RankedTriangle;
using umbrella::Triangle;
using umbrella::VertexId;

using LinkEdges = std::vector<std::pair<VertexId, VertexId>>;

inline VertexId vertex(std::size_t v) {
  return VertexId{static_cast<std::uint32_t>(v)};
}

inline RankedTriangle ranked(std::size_t a, std::size_t b, std::size_t c,
                             double primary, double secondary = 0) {
  Triangle corners = {vertex(a), vertex(b), vertex(c)};
  std::sort(corners.begin(), corners.end());
  return {corners, {}, {primary, secondary}};
}

/// Each triangle on n vertices with the given probability, with few distinct
/// ranks; by corners.
inline std::vector<RankedTriangle> random_complex(std::size_t n,
                                                  double probability,
                                                  std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::vector<RankedTriangle> triangles;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c)
        if (static_cast<double>(rng() % 1000) < 1000 * probability)
          triangles.push_back(ranked(a, b, c, static_cast<double>(rng() % 20),
                                     static_cast<double>(rng() % 3)));
  return triangles;
}

inline std::vector<RankedTriangle> in_order(
    const umbrella::RankedTriangles& triangles) {
  std::vector<RankedTriangle> sorted(triangles.begin(), triangles.end());
  std::sort(sorted.begin(), sorted.end(),
            [&](const RankedTriangle& a, const RankedTriangle& b) {
              return triangles.order().before(a, b);
            });
  return sorted;
}

/// G_v.
inline LinkEdges link(std::span<const RankedTriangle> triangles, VertexId v) {
  LinkEdges edges;
  for (const auto& t : triangles) {
    const auto& [a, b, c] = t.corners;
    if (v == a) edges.emplace_back(b, c);
    if (v == b) edges.emplace_back(a, c);
    if (v == c) edges.emplace_back(a, b);
  }
  return edges;
}

inline bool are_connected(const LinkEdges& edges, VertexId from, VertexId to) {
  std::set<VertexId> reached = {from};
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [p, q] : edges)
      if (reached.count(p) != reached.count(q)) {
        reached.insert(p);
        reached.insert(q);
        grows = true;
      }
  }
  return reached.count(to) > 0;
}

/// Whether each edge lies on a cycle: its ends hang together without it.
inline std::vector<bool> on_cycle(const LinkEdges& edges) {
  std::vector<bool> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    LinkEdges others = edges;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    result.push_back(are_connected(others, edges[i].first, edges[i].second));
  }
  return result;
}

inline bool has_cycle(const LinkEdges& edges) {
  const auto cyclic = on_cycle(edges);
  return std::find(cyclic.begin(), cyclic.end(), true) != cyclic.end();
}

/// Whether the edges are one simple cycle, all of them.
inline bool is_simple_cycle(const LinkEdges& edges) {
  std::map<VertexId, int> degree;
  for (const auto& [p, q] : edges) {
    ++degree[p];
    ++degree[q];
    if (!are_connected(edges, p, edges.front().first)) return false;
  }
  return !edges.empty() &&
         std::all_of(degree.begin(), degree.end(),
                     [](const auto& entry) { return entry.second == 2; });
}

}  // namespace tests
