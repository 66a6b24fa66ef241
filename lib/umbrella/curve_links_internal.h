/// @file
/// A graph of at most two edges a vertex.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "delaunay/ids.h"

namespace umbrella {

class CurveLinks {
 public:
  using VertexId = delaunay::VertexId;
  static constexpr VertexId kNone = delaunay::kInfinite;

  explicit CurveLinks(std::size_t n_vertices)
      : links_(n_vertices, {kNone, kNone}) {}
  /// @param links  of each vertex; mutual
  explicit CurveLinks(std::vector<std::array<VertexId, 2>> links)
      : links_(std::move(links)) {}

  /// The links of each vertex.
  std::vector<std::array<VertexId, 2>> release() && {
    return std::move(links_);
  }

  std::size_t n_vertices() const { return links_.size(); }
  /// Linked vertices, kNone for a free place.
  const std::array<VertexId, 2>& operator[](VertexId v) const {
    return links_[index(v)];
  }
  bool is_full(VertexId v) const {
    return (*this)[v][0] != kNone && (*this)[v][1] != kNone;
  }
  bool has(VertexId v, VertexId w) const {
    return (*this)[v][0] == w || (*this)[v][1] == w;
  }
  /// The other linked vertex, maybe kNone.
  VertexId beyond(VertexId v, VertexId from) const {
    return (*this)[v][0] == from ? (*this)[v][1] : (*this)[v][0];
  }

  /// @pre both have a free place, and no link to each other
  void add(VertexId v, VertexId w) {
    assert(!has(v, w));
    replace(v, kNone, w);
    replace(w, kNone, v);
  }
  /// @pre has(v, w)
  void drop(VertexId v, VertexId w) {
    replace(v, w, kNone);
    replace(w, v, kNone);
  }

  /// The vertices of the closed curve through v, from v on; empty if the curve
  /// has ends.
  std::vector<VertexId> closed_curve_through(VertexId v) const {
    std::vector<VertexId> curve;
    VertexId previous = (*this)[v][1];
    VertexId at = v;
    do {
      curve.push_back(at);
      const VertexId next = beyond(at, previous);
      previous = at;
      at = next;
    } while (at != kNone && at != v);
    if (at == kNone) curve.clear();
    return curve;
  }

 private:
  void replace(VertexId v, VertexId from, VertexId to) {
    auto& [one, other] = links_[index(v)];
    assert(one == from || other == from);
    (one == from ? one : other) = to;
  }

  std::vector<std::array<VertexId, 2>> links_;
};

}  // namespace umbrella
