// Geomview OFF, text only: OFF, COFF, NOFF, STOFF and their mixtures. Colours,
// normals and texture coordinates behind the position are passed over.

#include <vector>

#include "io/readers_internal.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

struct Counts {
  std::int64_t vertices;
  std::int64_t faces;
};

// `OFF`, the counts behind it or on the next row; a file named .off may lack
// the keyword.
Counts read_header(Scanner& scan, const Source& source) {
  scan.next_row();
  if (is_off_keyword(source.bytes)) {
    scan.word();
    if (!scan.more()) scan.next_row();
  }
  const std::int64_t vertices =
      scan.integer(0, kMaxVertices, "the number of vertices");
  // A row is two bytes or longer: whatever the header says, no more than the
  // file can hold is ever reserved.
  const auto room = static_cast<std::int64_t>(scan.remaining() / 2);
  if (vertices > room)
    scan.fail_at_last("more vertices than the file can hold: " +
                      std::to_string(vertices));
  const std::int64_t faces = scan.integer(0, INT64_MAX, "the number of faces");
  if (faces > room)
    scan.fail_at_last("more faces than the file can hold: " +
                      std::to_string(faces));
  return {vertices, faces};
}

void require_row(Scanner& scan, std::int64_t done, std::int64_t due,
                 const std::string& what) {
  if (scan.next_row()) return;
  scan.fail_here("the file ends after " + std::to_string(done) + " of " +
                 std::to_string(due) + " " + what);
}

}  // namespace

bool is_off_keyword(std::string_view bytes) {
  Scanner scan("", bytes, {.hash_comments = true});
  scan.next_row();
  std::string_view word = scan.word();
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

Mesh parse_off(const Source& source) {
  Scanner scan(source.file, source.bytes, {.hash_comments = true});
  const Counts counts = read_header(scan, source);
  Mesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(counts.vertices));
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    require_row(scan, i, counts.vertices, "vertices");
    const double x = scan.number();
    const double y = scan.number();
    mesh.vertices.push_back({x, y, scan.number()});
  }
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    require_row(scan, i, counts.faces, "faces");
    if (!source.faces) continue;
    const std::int64_t n = scan.integer(1, kMaxVertices, "the corner count");
    if (n < 3) scan.fail_at_last("a face of " + std::to_string(n) + " corners");
    corners.clear();
    for (std::int64_t k = 0; k < n; ++k)
      corners.push_back(static_cast<std::uint32_t>(
          scan.integer(0, counts.vertices - 1, "the vertex index")));
    add_face(corners, mesh);
  }
  return mesh;
}

}  // namespace io
