// Points as text: one a line, the first two or three columns. Edges as text:
// the two ends of one a line.

#include <algorithm>
#include <cctype>

#include "io/error.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"
#include "io/vertex_merger_internal.h"

namespace io {
namespace {

constexpr Syntax kSyntax = {
    .hash_comments = true, .slash_comments = true, .separators = true};

// A first row of names: each value starts like one, and none is a number.
bool is_header(const Source& source) {
  Scanner scan(source.file, source.bytes, kSyntax);
  if (!scan.next_row()) return false;
  do {
    const std::string_view name = scan.word();
    if (name.empty()) return false;
    const auto first = static_cast<unsigned char>(name.front());
    if (std::isalpha(first) == 0 && first != '"' && first != '_') return false;
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
      return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    if (lower == "nan" || lower == "inf" || lower == "infinity") return false;
  } while (scan.more());
  return true;
}

// A first row of one integer: the number of points, as in PTS files.
bool is_count(const Source& source) {
  Scanner scan(source.file, source.bytes, kSyntax);
  if (!scan.next_row()) return false;
  const std::string_view word = scan.word();
  const bool digits =
      !word.empty() && word.find_first_not_of("0123456789") == word.npos;
  return digits && !scan.more();
}

}  // namespace

Mesh parse_text(const Source& source) {
  Scanner scan(source.file, source.bytes, kSyntax);
  Mesh mesh;
  std::int64_t announced = -1;
  if (is_count(source)) {
    scan.next_row();
    announced = scan.integer(0, kMaxVertices, "the number of points");
  } else if (is_header(source)) {
    scan.next_row();
  }
  while (scan.next_row()) {
    Eigen::Vector3d p(scan.number(), 0, 0);
    if (!scan.more())
      scan.fail_at_last("one column where two or three are due");
    p.y() = scan.number();
    const int dimension = scan.more() ? 3 : 2;
    if (dimension == 3) p.z() = scan.number();
    if (mesh.vertices.empty()) mesh.dimension = dimension;
    if (dimension != mesh.dimension)
      scan.fail_at_last("a row of " + std::to_string(dimension) +
                        " columns after rows of " +
                        std::to_string(mesh.dimension));
    mesh.vertices.push_back(p);
  }
  const auto found = static_cast<std::int64_t>(mesh.vertices.size());
  if (announced >= 0 && announced != found)
    scan.fail_here(std::to_string(announced) + " points announced, " +
                   std::to_string(found) + " found");
  return mesh;
}

Mesh parse_text_edges(const Source& source) {
  Scanner scan(source.file, source.bytes, kSyntax);
  Mesh mesh;
  mesh.dimension = 2;
  VertexMerger vertices;
  while (scan.next_row()) {
    std::array<double, 4> row{};
    row[0] = scan.number();
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (!scan.more()) scan.fail_at_last("an edge is four columns: x y x y");
      row[i] = scan.number();
    }
    if (scan.more()) scan.fail_here("an edge is four columns: x y x y");
    const std::uint32_t from = vertices.add({row[0], row[1], 0});
    mesh.edges.push_back({from, vertices.add({row[2], row[3], 0})});
  }
  mesh.vertices = vertices.take();
  return mesh;
}

}  // namespace io
