/// @file
/// Small triangle meshes whose topology is known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tests {

struct IndexedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Outward.
inline IndexedMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// m x n quadrilaterals around a ring of radius 2, each cut in two; outward.
inline IndexedMesh torus(std::uint32_t m, std::uint32_t n) {
  IndexedMesh mesh;
  const auto row = [&](std::uint32_t i, std::uint32_t k) {
    return (i % m) * n + k % n;
  };
  for (std::uint32_t i = 0; i < m; ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const double a = 2 * M_PI * i / m, b = 2 * M_PI * k / n;
      const double r = 2 + std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
      mesh.triangles.push_back({row(i, k), row(i + 1, k), row(i + 1, k + 1)});
      mesh.triangles.push_back({row(i, k), row(i + 1, k + 1), row(i, k + 1)});
    }
  return mesh;
}

/// Both, the second moved; rows of the second follow those of the first.
inline IndexedMesh together(IndexedMesh a, const IndexedMesh& b,
                            const Eigen::Vector3d& move) {
  const auto n = static_cast<std::uint32_t>(a.vertices.size());
  for (const auto& p : b.vertices) a.vertices.push_back(p + move);
  for (const auto& [i, k, l] : b.triangles)
    a.triangles.push_back({i + n, k + n, l + n});
  return a;
}

/// A strip of 5 triangles with a half twist, on 5 vertices.
inline IndexedMesh moebius_strip() {
  IndexedMesh mesh;
  for (std::uint32_t i = 0; i < 5; ++i) {
    mesh.vertices.emplace_back(i, i * i, i * i * i);
    mesh.triangles.push_back({i, (i + 1) % 5, (i + 2) % 5});
  }
  return mesh;
}

/// The projective plane on 6 vertices: closed, but without an orientation.
inline IndexedMesh projective_plane() {
  IndexedMesh mesh;
  for (std::uint32_t i = 0; i < 6; ++i)
    mesh.vertices.emplace_back(i, i * i, i * i * i);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                    {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  return mesh;
}

}  // namespace tests
