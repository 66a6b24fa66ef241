#include "umbrella/given_faces.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "umbrella/criterion.h"

namespace umbrella {
namespace {

/// Distinct triangles, found by their corners.
class TriangleSet {
 public:
  /// @param n_vertices  all ids are below it
  TriangleSet(std::size_t n_vertices, std::vector<Triangle> triangles)
      : triangles_(std::move(triangles)), first_(n_vertices + 1) {
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()),
                     triangles_.end());
    std::uint32_t t = 0;
    for (std::size_t v = 0; v <= n_vertices; ++v) {
      while (t < triangles_.size() && index(triangles_[t][0]) < v) ++t;
      first_[v] = t;
    }
  }

  std::size_t size() const { return triangles_.size(); }
  bool contains(const Triangle& t) const {
    const std::size_t lowest = index(t[0]);
    return std::binary_search(triangles_.begin() + first_[lowest],
                              triangles_.begin() + first_[lowest + 1], t);
  }

 private:
  std::vector<Triangle> triangles_;   // sorted
  std::vector<std::uint32_t> first_;  // of those with this lowest corner
};

/// The paper's ranks, of the triangles of a set. Says none exactly, for the
/// order would outlive the set.
struct GivenCriterion {
  const TriangleSet* faces = nullptr;
  bool admissible(const DelaunayTriangle& t) const {
    return faces->contains(t.corners());
  }
  Rank rank(const DelaunayTriangle& t) const {
    return PaperCriterion{}.rank(t);
  }
};

}  // namespace

GivenFaces locate_faces(const delaunay::Triangulation3& triangulation,
                        const Circumspheres& spheres,
                        std::span<const IndexedTriangle> faces) {
  const auto vertex_of_row = triangulation.vertex_of_row();
  GivenFaces result;
  std::vector<Triangle> proper;
  for (const IndexedTriangle& face : faces) {
    Triangle t;
    for (unsigned i = 0; i < 3; ++i) {
      if (face[i] >= vertex_of_row.size())
        throw std::invalid_argument("a face has corner " +
                                    std::to_string(face[i]) + " of " +
                                    std::to_string(vertex_of_row.size()));
      t[i] = vertex_of_row[face[i]];
    }
    std::sort(t.begin(), t.end());
    if (t[0] != t[1] && t[1] != t[2]) proper.push_back(t);
  }
  FaceCounts& counts = result.counts;
  counts.faces = faces.size();
  counts.degenerate = faces.size() - proper.size();
  const TriangleSet set(triangulation.points().size(), std::move(proper));
  counts.duplicates = faces.size() - counts.degenerate - set.size();

  result.triangles = RankedTriangles(
      ranked_triangles(triangulation, spheres, GivenCriterion{&set}).list(),
      rank_order(triangulation, spheres, PaperCriterion{}));
  counts.kept = result.triangles.size();
  counts.not_delaunay = set.size() - counts.kept;
  return result;
}

}  // namespace umbrella
