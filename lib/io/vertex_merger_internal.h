/// @file
/// Vertices for formats that repeat the coordinates of each corner.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace io {

/// Equal points become one vertex, -0 and 0 being equal.
class VertexMerger {
 public:
  std::uint32_t add(const Eigen::Vector3d& p) {
    const Key key = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 becomes 0
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [at, is_new] = vertex_.try_emplace(key, next);
    if (is_new) vertices_.push_back(p);
    return at->second;
  }

  std::vector<Eigen::Vector3d> take() { return std::move(vertices_); }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const double x : key) {
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E37'79B9'7F4A'7C15U;
        h ^= h >> 29U;
      }
      return h;
    }
  };

  std::vector<Eigen::Vector3d> vertices_;
  std::unordered_map<Key, std::uint32_t, Hash> vertex_;
};

}  // namespace io
