#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/readers_internal.h"
#include "io/writers_internal.h"

namespace io {
namespace {

// Least significant byte first, on every machine.
template <class Number>
void append_binary(std::string& out, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (std::endian::native == std::endian::big)
    std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

// The shortest text that reads back to the same number.
template <class Number>
void append_text(std::string& out, Number number) {
  std::array<char, 32> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
  out.append(buffer.data(), end);
}

void append_coordinates(std::string& out, const Eigen::Vector3d& p,
                        int dimension) {
  for (int axis = 0; axis < dimension; ++axis) {
    if (axis > 0) out += ' ';
    append_text(out, p[axis]);
  }
}

bool all_are_floats(const Mesh& mesh) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return std::ranges::all_of(mesh.vertices, [](const Eigen::Vector3d& p) {
    return std::ranges::all_of(std::array{p.x(), p.y(), p.z()}, [](double x) {
      return std::abs(x) <= kMax && static_cast<float>(x) == x;
    });
  });
}

// Points in the plane have two coordinates; curves have z = 0, for viewers.
int ply_dimension(const Mesh& mesh) {
  return mesh.edges.empty() ? mesh.dimension : 3;
}

std::string ply_header(const Mesh& mesh, bool floats, bool has_lambda) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  out += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  for (int axis = 0; axis < ply_dimension(mesh); ++axis) {
    out += floats ? "property float " : "property double ";
    out += "xyz"[axis];
    out += '\n';
  }
  const char* const lambda = has_lambda ? "property double lambda\n" : "";
  if (!mesh.triangles.empty())
    out += "element face " + std::to_string(mesh.triangles.size()) +
           "\nproperty list uchar int vertex_indices\n" + lambda;
  if (!mesh.edges.empty())
    out += "element edge " + std::to_string(mesh.edges.size()) +
           "\nproperty int vertex1\nproperty int vertex2\n" +
           (mesh.triangles.empty() ? lambda : "");
  return out + "end_header\n";
}

}  // namespace

std::optional<OutputFormat> output_format(std::string_view path) {
  if (has_extension(path, ".ply")) return OutputFormat::Ply;
  if (has_extension(path, ".off")) return OutputFormat::Off;
  if (has_extension(path, ".obj")) return OutputFormat::Obj;
  if (has_extension(path, ".stl")) return OutputFormat::Stl;
  if (has_extension(path, ".svg")) return OutputFormat::Svg;
  if (has_extension(path, ".txt")) return OutputFormat::Text;
  return std::nullopt;
}

std::string ply_bytes(const Mesh& mesh, std::span<const double> lambda) {
  const bool floats = all_are_floats(mesh);
  std::string out = ply_header(mesh, floats, !lambda.empty());
  out.reserve(out.size() + 24 * mesh.vertices.size() +
              21 * mesh.triangles.size() + 16 * mesh.edges.size());
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int axis = 0; axis < ply_dimension(mesh); ++axis) {
      if (floats)
        append_binary(out, static_cast<float>(p[axis]));
      else
        append_binary(out, p[axis]);
    }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    out += '\3';
    for (const std::uint32_t v : mesh.triangles[i]) append_binary(out, v);
    if (!lambda.empty()) append_binary(out, lambda[i]);
  }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    for (const std::uint32_t v : mesh.edges[i]) append_binary(out, v);
    if (!lambda.empty() && mesh.triangles.empty())
      append_binary(out, lambda[i]);
  }
  return out;
}

std::string off_text(const Mesh& mesh) {
  std::string out = "OFF\n" + std::to_string(mesh.vertices.size()) + " " +
                    std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Eigen::Vector3d& p : mesh.vertices) {
    append_coordinates(out, p, 3);
    out += '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    out += '3';
    for (const std::uint32_t v : triangle) append_text(out += ' ', v);
    out += '\n';
  }
  return out;
}

std::string obj_text(const Mesh& mesh) {
  std::string out;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    append_coordinates(out += "v ", p, ply_dimension(mesh));
    out += '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    out += 'f';
    for (const std::uint32_t v : triangle) append_text(out += ' ', v + 1);
    out += '\n';
  }
  for (const auto& edge : mesh.edges) {
    out += 'l';
    for (const std::uint32_t v : edge) append_text(out += ' ', v + 1);
    out += '\n';
  }
  return out;
}

std::string stl_bytes(const Mesh& mesh) {
  std::string out = "binary STL, coordinates as in the input but rounded";
  out.resize(80, ' ');
  append_binary(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = mesh.vertices[triangle[k]];
    const Eigen::Vector3d normal = (p[1] - p[0])
                                       .stableNormalized()
                                       .cross((p[2] - p[0]).stableNormalized());
    for (const Eigen::Vector3d& v :
         {Eigen::Vector3d(normal.stableNormalized()), p[0], p[1], p[2]})
      for (int axis = 0; axis < 3; ++axis)
        append_binary(out, static_cast<float>(v[axis]));
    append_binary(out, std::uint16_t{0});
  }
  return out;
}

std::string row_text(const Mesh& mesh) {
  std::string out;
  for (const auto& edge : mesh.edges) {
    append_coordinates(out, mesh.vertices[edge[0]], mesh.dimension);
    append_coordinates(out += ' ', mesh.vertices[edge[1]], mesh.dimension);
    out += '\n';
  }
  for (const Eigen::Vector3d& p : mesh.vertices) {
    if (!mesh.edges.empty()) break;
    append_coordinates(out, p, mesh.dimension);
    out += '\n';
  }
  return out;
}

}  // namespace io
