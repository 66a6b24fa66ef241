// Wavefront OBJ: v, f and l rows; all others are passed over.

#include <algorithm>
#include <charconv>
#include <vector>

#include "io/readers_internal.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

class ObjParser {
 public:
  explicit ObjParser(const Source& source)
      : scan_(source.file, source.bytes, {.hash_comments = true}),
        faces_(source.faces) {}

  Mesh parse() {
    while (scan_.next_row()) {
      const std::string_view key = scan_.word();
      if (key == "v") {
        read_vertex();
      } else if (faces_ && key == "f") {
        read_face();
      } else if (faces_ && key == "l") {
        read_line();
      }
    }
    return std::move(mesh_);
  }

 private:
  void read_vertex() {
    Eigen::Vector3d p(scan_.number(), 0, 0);
    p.y() = scan_.number();
    const int dimension = scan_.more() ? 3 : 2;
    if (dimension == 3) p.z() = scan_.number();
    if (mesh_.vertices.empty()) mesh_.dimension = dimension;
    if (dimension != mesh_.dimension)
      scan_.fail_at_last("a vertex of " + std::to_string(dimension) +
                         " coordinates after vertices of " +
                         std::to_string(mesh_.dimension));
    mesh_.vertices.push_back(p);
  }

  // `i`, `i/t`, `i//n` or `i/t/n`: i counts from 1, or back from -1. A face
  // may not name a vertex that comes later in the file.
  std::uint32_t read_corner() {
    const std::string_view word = scan_.word();
    const std::string_view text = word.substr(0, word.find('/'));
    const auto n = static_cast<std::int64_t>(mesh_.vertices.size());
    std::int64_t i = 0;
    const char* const text_end = text.data() + text.size();
    const auto [ptr, error] = std::from_chars(text.data(), text_end, i);
    if (error == std::errc::invalid_argument || ptr != text_end)
      scan_.fail_at_last("the vertex index is no integer: " + quoted(word));
    if (error != std::errc{} || i == 0 || i > n || i < -n)
      scan_.fail_at_last("the vertex index is out of range (" +
                         std::to_string(n) +
                         " vertices so far): " + quoted(word));
    return static_cast<std::uint32_t>(i > 0 ? i - 1 : n + i);
  }

  void read_corners(std::size_t least) {
    corners_.clear();
    while (scan_.more()) corners_.push_back(read_corner());
    if (corners_.size() < least)
      scan_.fail_here(std::to_string(corners_.size()) + " corners where " +
                      std::to_string(least) + " are due");
  }

  void read_face() {
    read_corners(3);
    add_face(corners_, mesh_);
  }

  void read_line() {
    read_corners(2);
    for (std::size_t i = 1; i < corners_.size(); ++i)
      mesh_.edges.push_back({corners_[i - 1], corners_[i]});
  }

  Scanner scan_;
  bool faces_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh parse_obj(const Source& source) { return ObjParser(source).parse(); }

}  // namespace io
