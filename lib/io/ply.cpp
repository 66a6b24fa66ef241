// PLY, as text and binary in either byte order. The header declares elements
// with scalar and list properties in any order; what is not asked for is
// passed over. One walk serves all three encodings: TextBody and BinaryBody
// have the same members.

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/binary_internal.h"
#include "io/readers_internal.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr TypeName kTypeNames[] = {
    {"char", Type::Int8},     {"int8", Type::Int8},
    {"uchar", Type::Uint8},   {"uint8", Type::Uint8},
    {"short", Type::Int16},   {"int16", Type::Int16},
    {"ushort", Type::Uint16}, {"uint16", Type::Uint16},
    {"int", Type::Int32},     {"int32", Type::Int32},
    {"uint", Type::Uint32},   {"uint32", Type::Uint32},
    {"float", Type::Float},   {"float32", Type::Float},
    {"double", Type::Double}, {"float64", Type::Double}};

std::size_t size_of(Type type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

// As it may have stood in the file: '4', not '4.000000'.
std::string quoted_number(double value) {
  std::array<char, 32> buffer;
  const char* const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return quoted({buffer.data(), end});
}

// What a property is to us.
enum class Role { Skip, X, Y, Z, Corners, Vertex1, Vertex2 };

struct Property {
  std::string_view name;
  Type type;
  std::optional<Type> count_type;  // of a list
  Role role = Role::Skip;
};

// What an element is to us.
enum class Kind { Other, Vertices, Faces, Edges };

struct Element {
  std::string_view name;
  std::int64_t count;
  std::vector<Property> properties;
  Kind kind = Kind::Other;

  bool has(Role role) const {
    return std::ranges::count(properties, role, &Property::role) == 1;
  }
};

enum class Encoding { Text, Little, Big };

struct Header {
  Encoding encoding = Encoding::Text;
  std::vector<Element> elements;
  std::int64_t n_vertices = 0;
};

Role role_of(std::string_view element, std::string_view property, bool faces) {
  struct Known {
    std::string_view element, property;
    Role role;
  };
  static constexpr Known kKnown[] = {{"vertex", "x", Role::X},
                                     {"vertex", "y", Role::Y},
                                     {"vertex", "z", Role::Z},
                                     {"face", "vertex_indices", Role::Corners},
                                     {"face", "vertex_index", Role::Corners},
                                     {"edge", "vertex1", Role::Vertex1},
                                     {"edge", "vertex2", Role::Vertex2}};
  if (element != "vertex" && !faces) return Role::Skip;
  for (const Known& known : kKnown)
    if (known.element == element && known.property == property)
      return known.role;
  return Role::Skip;
}

class HeaderParser {
 public:
  HeaderParser(Scanner& scan, bool faces) : scan_(scan), faces_(faces) {}

  Header parse() {
    scan_.next_row();
    if (scan_.word() != "ply")
      scan_.fail_at_last("a PLY file starts with the line 'ply'");
    for (;;) {
      if (!scan_.next_row()) scan_.fail_here("the header has no 'end_header'");
      const std::string_view key = scan_.word();
      if (key == "end_header") break;
      parse_line(key);
    }
    if (!has_format_) scan_.fail_at_last("the header has no 'format'");
    finish();
    return std::move(header_);
  }

 private:
  void parse_line(std::string_view key) {
    if (key == "format") {
      parse_format();
    } else if (key == "element") {
      header_.elements.push_back(
          {scan_.word(),
           scan_.integer(0, std::numeric_limits<std::int64_t>::max(),
                         "the element count"),
           {}});
    } else if (key == "property") {
      parse_property();
    } else if (key != "comment" && key != "obj_info") {
      scan_.fail_at_last("unknown in a PLY header: " + quoted(key));
    }
  }

  void parse_format() {
    const std::string_view name = scan_.word();
    if (name == "ascii") {
      header_.encoding = Encoding::Text;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::Little;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::Big;
    } else {
      scan_.fail_at_last("unknown PLY format: " + quoted(name));
    }
    has_format_ = true;
  }

  void parse_property() {
    if (header_.elements.empty())
      scan_.fail_at_last("a property before the first element");
    Element& element = header_.elements.back();
    Property property;
    std::string_view type = scan_.word();
    if (type == "list") {
      property.count_type = type_called(scan_.word());
      type = scan_.word();
    }
    property.type = type_called(type);
    property.name = scan_.word();
    if (property.name.empty()) scan_.fail_at_last("a property without a name");
    property.role = role_of(element.name, property.name, faces_);
    const bool wants_list = property.role == Role::Corners;
    if (property.role != Role::Skip &&
        wants_list != property.count_type.has_value())
      scan_.fail_at_last(std::string(wants_list ? "not a list: " : "a list: ") +
                         quoted(property.name));
    element.properties.push_back(property);
  }

  Type type_called(std::string_view name) const {
    for (const TypeName& known : kTypeNames)
      if (known.name == name) return known.type;
    scan_.fail_at_last("unknown PLY type: " + quoted(name));
  }

  void finish() {
    const Element* vertices = nullptr;
    for (Element& element : header_.elements) {
      require_room(element);
      if (element.name == "vertex") {
        if (vertices != nullptr) scan_.fail_at_last("two vertex elements");
        if (!element.has(Role::X) || !element.has(Role::Y))
          scan_.fail_at_last("vertices need one property x and one y");
        element.kind = Kind::Vertices;
        vertices = &element;
      } else if (element.has(Role::Corners)) {
        element.kind = Kind::Faces;
      } else if (element.has(Role::Vertex1) && element.has(Role::Vertex2)) {
        element.kind = Kind::Edges;
      }
    }
    if (vertices == nullptr) scan_.fail_at_last("no vertex element");
    header_.n_vertices = vertices->count;
  }

  // A row has a least size, so the size of the file limits the counts: 10^12
  // announced vertices are found out here, before anything is reserved.
  void require_room(const Element& element) const {
    std::size_t row = 0;
    for (const Property& p : element.properties)
      row += header_.encoding == Encoding::Text
                 ? 2
                 : size_of(p.count_type.value_or(p.type));
    if (element.count > 0 && row == 0)
      scan_.fail_at_last("an element without properties: " +
                         quoted(element.name));
    const auto count = static_cast<std::uint64_t>(element.count);
    if (count > 0 && count > (scan_.remaining() + 1) / row)
      scan_.fail_at_last("the header announces more than the file can hold: " +
                         std::to_string(count) + " of element " +
                         quoted(element.name));
  }

  Scanner& scan_;
  bool faces_;
  bool has_format_ = false;
  Header header_;
};

class TextBody {
 public:
  explicit TextBody(Scanner& scan) : scan_(scan) {}

  void begin_row(std::int64_t row, const Element& element) {
    if (!scan_.next_row())
      scan_.fail_here("the file ends after " + std::to_string(row) + " of " +
                      std::to_string(element.count) + " of element " +
                      quoted(element.name));
  }
  void end_row() {
    if (scan_.more()) scan_.fail_here("more values than properties");
  }
  double number(Type /*type*/) { return scan_.number(); }
  void skip(Type /*type*/, std::int64_t n) {
    for (; n > 0; --n)
      if (scan_.word().empty()) scan_.fail_here("a value is missing");
  }
  [[noreturn]] void fail(const std::string& what) const {
    scan_.fail_at_last(what);
  }

 private:
  Scanner& scan_;
};

class BinaryBody {
 public:
  explicit BinaryBody(const BinaryReader& reader) : reader_(reader) {}

  void begin_row(std::int64_t /*row*/, const Element& /*element*/) {}
  void end_row() {}
  double number(Type type) {
    switch (type) {
      case Type::Int8:
        return reader_.read<std::int8_t>();
      case Type::Uint8:
        return reader_.read<std::uint8_t>();
      case Type::Int16:
        return reader_.read<std::int16_t>();
      case Type::Uint16:
        return reader_.read<std::uint16_t>();
      case Type::Int32:
        return reader_.read<std::int32_t>();
      case Type::Uint32:
        return reader_.read<std::uint32_t>();
      case Type::Float:
        return reader_.finite<float>();
      case Type::Double:
        break;
    }
    return reader_.finite<double>();
  }
  void skip(Type type, std::int64_t n) {
    reader_.skip(size_of(type) * static_cast<std::size_t>(n));
  }
  [[noreturn]] void fail(const std::string& what) const {
    reader_.fail_at_last(what);
  }

 private:
  BinaryReader reader_;
};

template <class Body>
class BodyParser {
 public:
  BodyParser(Body body, const Header& header)
      : body_(std::move(body)), header_(header) {}

  Mesh parse() {
    mesh_.dimension = 2;
    for (const Element& element : header_.elements) {
      if (element.kind == Kind::Vertices)
        mesh_.vertices.reserve(static_cast<std::size_t>(element.count));
      for (std::int64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row, element);
        for (const Property& property : element.properties) read(property);
        body_.end_row();
        finish_row(element);
      }
    }
    return std::move(mesh_);
  }

 private:
  void read(const Property& property) {
    const std::int64_t n =
        property.count_type ? whole(body_.number(*property.count_type)) : 1;
    switch (property.role) {
      case Role::Skip:
        return body_.skip(property.type, n);
      case Role::Z:
        mesh_.dimension = 3;
        [[fallthrough]];
      case Role::X:
      case Role::Y:
        point_[static_cast<int>(property.role) - static_cast<int>(Role::X)] =
            body_.number(property.type);
        return;
      case Role::Vertex1:
        ends_[0] = vertex(property.type);
        return;
      case Role::Vertex2:
        ends_[1] = vertex(property.type);
        return;
      case Role::Corners:
        if (n < 3) body_.fail("a face of " + std::to_string(n) + " corners");
        corners_.clear();
        for (std::int64_t i = 0; i < n; ++i)
          corners_.push_back(vertex(property.type));
    }
  }

  void finish_row(const Element& element) {
    if (element.kind == Kind::Vertices) mesh_.vertices.push_back(point_);
    if (element.kind == Kind::Faces) add_face(corners_, mesh_);
    if (element.kind == Kind::Edges) mesh_.edges.push_back(ends_);
  }

  std::int64_t whole(double value) const {
    if (!(value >= 0 && value <= kMaxVertices) || value != std::floor(value))
      body_.fail("not a list length: " + quoted_number(value));
    return static_cast<std::int64_t>(value);
  }

  std::uint32_t vertex(Type type) {
    const double value = body_.number(type);
    const auto limit = static_cast<double>(header_.n_vertices);
    if (!(value >= 0 && value < limit) || value != std::floor(value))
      body_.fail("no vertex index below " + std::to_string(header_.n_vertices) +
                 ": " + quoted_number(value));
    return static_cast<std::uint32_t>(value);
  }

  Body body_;
  const Header& header_;
  Mesh mesh_;
  Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> corners_;
  std::array<std::uint32_t, 2> ends_{};
};

// Behind the line of `end_header`. A line feed after a carriage return belongs
// to the body if the header's lines end with carriage returns alone.
std::size_t body_offset(std::string_view bytes, std::size_t header_end) {
  const auto is_pair = [&](std::size_t at) {
    return bytes.substr(at).starts_with("\r\n");
  };
  const std::size_t at = bytes.find_first_of("\r\n", header_end);
  if (at == bytes.npos) return bytes.size();
  return at + (is_pair(at) && is_pair(bytes.find_first_of("\r\n")) ? 2 : 1);
}

}  // namespace

Mesh parse_ply(const Source& source) {
  Scanner scan(source.file, source.bytes);
  const Header header = HeaderParser(scan, source.faces).parse();
  if (header.encoding == Encoding::Text)
    return BodyParser(TextBody(scan), header).parse();
  const BinaryReader reader(
      source.file, source.bytes,
      header.encoding == Encoding::Big ? std::endian::big : std::endian::little,
      body_offset(source.bytes, scan.offset()));
  return BodyParser(BinaryBody(reader), header).parse();
}

}  // namespace io
