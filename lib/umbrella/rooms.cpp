#include <cstdint>
#include <limits>

#include "umbrella/parity_sets_internal.h"
#include "umbrella/rooms_internal.h"

namespace umbrella {
namespace {

using delaunay::Cell;
using delaunay::Facet;
using delaunay::kFacetCorners;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Rooms {
 public:
  Rooms(const CellSet& cells, const RegionTriangles& triangles)
      : cells_(cells),
        triangles_(triangles),
        kind_(4 * cells.cells().size(), Kind::Absent),
        sides_(cells.cells().size() + 1) {
    if (triangles.vertices.empty()) return;
    first_ = index(triangles.vertices.front());
    is_vertex_.resize(index(triangles.vertices.back()) - first_ + 1);
    for (const VertexId v : triangles.vertices)
      is_vertex_[index(v) - first_] = true;
  }

  std::vector<ilp::Wall> walls();

 private:
  enum class Kind : std::uint8_t { Absent, Fixed, Candidate };

  void mark(std::span<const LocatedTriangle> triangles, Kind kind);
  void mark(Facet facet, Kind kind);
  bool join_known();
  bool is_known(const Cell& cell, unsigned i) const;
  /// The same from both sides, so that the program, and the way that a search
  /// takes, do not depend on how cells are numbered.
  Facet lower_side(Facet facet) const {
    const Facet other = cells_.opposite(facet);
    return cells_.apex(facet) < cells_.apex(other) ? facet : other;
  }
  bool is_program_vertex(VertexId v) const {
    const std::size_t i = index(v) - first_;  // wraps below the first
    return i < is_vertex_.size() && is_vertex_[i];
  }

  const CellSet& cells_;
  const RegionTriangles& triangles_;
  std::size_t first_ = 0;
  std::vector<bool> is_vertex_;  // of the program, from the first to the last
  std::vector<Kind> kind_;  // of facet i of the cell at position p: 4 p + i
  ParitySets sides_;        // of cells by position, and of what is beyond
};

void Rooms::mark(Facet facet, Kind kind) {
  const std::uint32_t p = cells_.position(facet.cell());
  if (p < cells_.cells().size()) kind_[4 * p + facet.index()] = kind;
}

void Rooms::mark(std::span<const LocatedTriangle> triangles, Kind kind) {
  for (const LocatedTriangle& t : triangles) {
    mark(t.facet, kind);
    mark(cells_.opposite(t.facet), kind);
  }
}

bool Rooms::is_known(const Cell& cell, unsigned i) const {
  bool has_vertex = false, all_open = true;
  for (const unsigned k : kFacetCorners[i]) {
    has_vertex = has_vertex || is_program_vertex(cell.vertex[k]);
    all_open = all_open && triangles_.is_open[index(cell.vertex[k])];
  }
  return has_vertex && !all_open;
}

/// @return false if what is known contradicts itself
bool Rooms::join_known() {
  for (std::uint32_t p = 0; p < cells_.cells().size(); ++p) {
    const Cell& cell = cells_.cell(p);
    for (unsigned i = 0; i < 4; ++i) {
      const std::uint32_t beyond = cells_.position(cell.neighbor[i].cell());
      const Kind kind = kind_[4 * p + i];
      if (beyond < p || beyond == kNone || kind == Kind::Candidate) continue;
      if (kind == Kind::Absent && !is_known(cell, i)) continue;
      if (!sides_.relate(p, beyond, kind == Kind::Fixed ? 1 : 0)) return false;
    }
  }
  return true;
}

std::vector<ilp::Wall> Rooms::walls() {
  mark(triangles_.fixed, Kind::Fixed);
  mark(triangles_.candidates, Kind::Candidate);
  if (!join_known()) return {};
  // The room of a set, and the parity in it of the cell that named it.
  struct Name {
    std::uint32_t room = kNone;
    std::uint32_t parity = 0;
  };
  std::vector<Name> names(cells_.cells().size() + 1);
  std::uint32_t n_rooms = 0;
  const auto named = [&](const ParitySets::Place& cell) {
    Name& name = names[cell.root];
    if (name.room == kNone) name = {n_rooms++, cell.parity};
    return Name{name.room, name.parity ^ cell.parity};
  };
  std::vector<ilp::Wall> walls;
  for (std::uint32_t i = 0; i < triangles_.candidates.size(); ++i) {
    const Facet facet = lower_side(triangles_.candidates[i].facet);
    const Name a = named(sides_.find(cells_.position(facet.cell())));
    const Name b =
        named(sides_.find(cells_.position(cells_.opposite(facet).cell())));
    walls.push_back({ilp::VarId{i}, a.room, b.room, a.parity != b.parity});
  }
  return walls;
}

}  // namespace

std::vector<ilp::Wall> walls_between_rooms(const CellSet& cells,
                                           const RegionTriangles& triangles) {
  return Rooms(cells, triangles).walls();
}

}  // namespace umbrella
