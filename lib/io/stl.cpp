// STL, text and binary. It holds triangles as triples of points: equal points
// become one vertex.

#include <bit>
#include <cmath>
#include <cstring>

#include "io/binary_internal.h"
#include "io/error.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"
#include "io/vertex_merger_internal.h"

namespace io {
namespace {

class CornerMerger {
 public:
  void add(const Eigen::Vector3d& p) {
    triangle_[n_corners_++ % 3] = vertices_.add(p);
    if (n_corners_ % 3 == 0) mesh_.triangles.push_back(triangle_);
  }

  Mesh take() {
    mesh_.vertices = vertices_.take();
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
  VertexMerger vertices_;
  std::array<std::uint32_t, 3> triangle_{};
  std::size_t n_corners_ = 0;
};

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

Mesh parse_stl_text(const Source& source) {
  Scanner scan(source.file, source.bytes);
  CornerMerger merger;
  int corners = -1;  // of the open facet, or -1 outside
  while (scan.next_row()) {
    const std::string key = lower(scan.word());
    if (key == "vertex" && corners >= 0 && corners < 3) {
      const double x = scan.number();
      const double y = scan.number();
      merger.add({x, y, scan.number()});
      ++corners;
    } else if (key == "facet" && corners < 0) {
      corners = 0;
    } else if (key == "endfacet" && corners == 3) {
      corners = -1;
    } else if (key != "outer" && key != "endloop" && key != "solid" &&
               key != "endsolid") {
      scan.fail_at_last("out of place in an STL file: " + quoted(key));
    }
  }
  if (corners >= 0) scan.fail_here("the file ends within a facet");
  return merger.take();
}

// 80 bytes of anything, a count, and 50 bytes a triangle: a normal, three
// corners, two bytes of attributes.
Mesh parse_stl_binary(const Source& source) {
  BinaryReader reader(source.file, source.bytes, std::endian::little);
  reader.skip(80);
  const auto n = reader.read<std::uint32_t>();
  CornerMerger merger;
  for (std::uint32_t i = 0; i < n; ++i) {
    reader.skip(12);
    for (int k = 0; k < 3; ++k) {
      const double x = reader.finite<float>();
      const double y = reader.finite<float>();
      merger.add({x, y, reader.finite<float>()});
    }
    reader.skip(2);
  }
  return merger.take();
}

}  // namespace io
