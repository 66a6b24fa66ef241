#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/writers_internal.h"

namespace io {
namespace {

// Enough digits for a picture, and the same on every machine.
std::string number(double x) {
  std::array<char, 32> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                    std::chars_format::general, 7);
  return std::string(buffer.data(), end);
}

/// From the points to a picture 1000 wide or high; y points down there.
class Frame {
 public:
  explicit Frame(const Mesh& mesh) {
    if (mesh.vertices.empty()) return;
    low_ = high_ = mesh.vertices.front();
    for (const Eigen::Vector3d& p : mesh.vertices) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    // Halves: the extent of the largest doubles is none of them.
    half_ = 0.5 * high_ - 0.5 * low_;
    const double most = std::max(half_.x(), half_.y());
    scale_ = most > 0 ? 0.5 * kSide / most : 1;
    if (!std::isfinite(scale_)) scale_ = 1;
  }

  std::string at(const Eigen::Vector3d& p) const {
    const double x = scale_ * (p.x() - low_.x() / 2 - low_.x() / 2);
    const double y = scale_ * (high_.y() / 2 - p.y() + high_.y() / 2);
    return number(x) + " " + number(y);
  }
  std::string box() const {
    return number(-kMargin) + " " + number(-kMargin) + " " +
           number(2 * scale_ * half_.x() + 2 * kMargin) + " " +
           number(2 * scale_ * half_.y() + 2 * kMargin);
  }

 private:
  static constexpr double kSide = 1000;
  static constexpr double kMargin = 20;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_ = Eigen::Vector3d::Zero();
  double scale_ = 1;
};

/// Edges that follow each other become one polyline, closed where it meets its
/// start.
std::string path(const Mesh& mesh, const Frame& frame) {
  std::string out;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const auto& [a, b] = mesh.edges[i];
    if (i == 0 || mesh.edges[i - 1][1] != a) {
      first = a;
      out += 'M';
      out += frame.at(mesh.vertices[a]);
    }
    out += b == first ? 'Z' : 'L';
    out += b == first ? "\n" : frame.at(mesh.vertices[b]);
  }
  return out;
}

}  // namespace

std::string svg_text(const Mesh& mesh) {
  const Frame frame(mesh);
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + frame.box() +
      "\">\n<path fill=\"none\" stroke=\"#1f4e79\" stroke-width=\"2\" "
      "stroke-linejoin=\"round\" d=\"" +
      path(mesh, frame) + "\"/>\n<path fill=\"none\" stroke=\"#c0392b\" " +
      "stroke-width=\"5\" stroke-linecap=\"round\" d=\"";
  // A line of no length with round ends is a dot.
  for (const Eigen::Vector3d& p : mesh.vertices)
    out.append("M").append(frame.at(p)).append("h0");
  return out + "\"/>\n</svg>\n";
}

}  // namespace io
