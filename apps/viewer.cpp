#include "apps/viewer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "viewer_page.h"

namespace command {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Least significant byte first, on every machine.
void append(Bytes& bytes, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

/// [RFC 4648, Section 4].
std::string base64(const Bytes& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < n ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= n ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// Into the cube [-1, 1]^3, the longest side of the mesh from -1 to 1.
std::string positions(const io::Mesh& mesh) {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  if (!mesh.vertices.empty()) low = high = mesh.vertices.front();
  for (const Eigen::Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Halves: the extent of the largest doubles is none of them.
  const Eigen::Vector3d middle = low / 2 + high / 2;
  const double half = (high / 2 - low / 2).maxCoeff();
  Bytes bytes;
  bytes.reserve(12 * mesh.vertices.size());
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) {
      const double x = half > 0 ? (p[axis] - middle[axis]) / half : 0;
      append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    }
  return base64(bytes);
}

template <std::size_t kSize>
std::string corners(
    const std::vector<std::array<std::uint32_t, kSize>>& cells) {
  Bytes bytes;
  bytes.reserve(4 * kSize * cells.size());
  for (const auto& cell : cells)
    for (const std::uint32_t v : cell) append(bytes, v);
  return base64(bytes);
}

std::string floats(std::span<const double> numbers) {
  Bytes bytes;
  bytes.reserve(4 * numbers.size());
  for (const double x : numbers)
    append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  return base64(bytes);
}

/// JSON that no end tag can hide in, and no byte that is not UTF-8.
std::string embedded(const nlohmann::json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  return result;
}

}  // namespace

std::string viewer_page(const std::string& title, const io::Mesh& mesh,
                        std::span<const double> lambda) {
  const std::string data = embedded({{"title", title},
                                     {"dimension", mesh.dimension},
                                     {"positions", positions(mesh)},
                                     {"triangles", corners(mesh.triangles)},
                                     {"edges", corners(mesh.edges)},
                                     {"lambda", floats(lambda)}});
  constexpr std::string_view kPlace = "@MESH@";
  const std::size_t at = kViewerPage.find(kPlace);
  std::string page(kViewerPage.substr(0, at));
  page += data;
  return page += kViewerPage.substr(at + kPlace.size());
}

}  // namespace command
