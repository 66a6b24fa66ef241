#include <array>
#include <cstdint>

#include "io/error.h"
#include "io/file.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

enum class Format { Ply, Off, Obj, StlText, StlBinary, Text };

struct Magic {
  std::string_view bytes, name;
};
constexpr Magic kCompressed[] = {{"\x1f\x8b", "gzip"},
                                 {"BZh", "bzip2"},
                                 {"\3757zXZ", "xz"},
                                 {"\x28\xb5\x2f\xfd", "zstd"},
                                 {"PK\x03\x04", "zip"}};

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint64_t n = 0;
  for (unsigned i = 0; i < 4; ++i)
    n |= std::uint64_t{static_cast<unsigned char>(bytes[80 + i])} << 8U * i;
  return bytes.size() == 84 + 50 * n;
}

std::string_view first_word(std::string_view bytes) {
  Scanner scan("", bytes, {.hash_comments = true});
  scan.next_row();
  return scan.word();
}

bool is_obj_key(std::string_view word) {
  for (const std::string_view key :
       {"v", "vn", "vt", "vp", "f", "l", "o", "g", "s", "mtllib", "usemtl"})
    if (word == key) return true;
  return false;
}

// By content, then by the extension.
Format format_of(const std::string& path, const Source& source) {
  for (const Magic& magic : kCompressed)
    if (source.bytes.starts_with(magic.bytes))
      throw ParseError(std::string(source.file) + ": compressed (" +
                       std::string(magic.name) + "): unpack it first");
  const std::string_view word = first_word(source.bytes);
  if (word == "ply") return Format::Ply;
  if (is_off_keyword(source.bytes)) return Format::Off;
  if (is_binary_stl(source.bytes)) return Format::StlBinary;
  if (word == "solid") return Format::StlText;
  if (is_obj_key(word)) return Format::Obj;
  if (has_extension(path, ".ply")) return Format::Ply;
  if (has_extension(path, ".off")) return Format::Off;
  if (has_extension(path, ".obj")) return Format::Obj;
  if (has_extension(path, ".stl")) return Format::StlBinary;
  return Format::Text;
}

Mesh parse(const Source& source, Format format) {
  switch (format) {
    case Format::Ply:
      return parse_ply(source);
    case Format::Off:
      return parse_off(source);
    case Format::Obj:
      return parse_obj(source);
    case Format::StlText:
      return parse_stl_text(source);
    case Format::StlBinary:
      return parse_stl_binary(source);
    case Format::Text:
      break;
  }
  return parse_text(source);
}

}  // namespace

bool has_extension(std::string_view path, std::string_view end) {
  if (path.size() < end.size()) return false;
  path.remove_prefix(path.size() - end.size());
  for (std::size_t i = 0; i < end.size(); ++i)
    if ((static_cast<unsigned char>(path[i]) | 0x20U) !=
        (static_cast<unsigned char>(end[i]) | 0x20U))
      return false;
  return true;
}

Mesh read(const std::string& path, bool faces) {
  const std::string bytes = read_file(path);
  const std::string file = display_name(path);
  if (bytes.empty()) throw ParseError(file + ": the file is empty");
  Source source{file, bytes, faces};
  if (source.bytes.starts_with("\xef\xbb\xbf"))  // byte order mark
    source.bytes.remove_prefix(3);
  const Format format = format_of(path, source);
  if (faces && format == Format::Text) {
    if (has_extension(path, ".txt")) return parse_text_edges(source);
    throw ParseError(
        file + ": no PLY, OFF, OBJ or STL file, nor edges in a .txt file");
  }
  return parse(source, format);
}

}  // namespace io
