#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "delaunay/mesh3_internal.h"

namespace delaunay {
namespace {

/// The largest power of two that divides all coordinates; 0 if they are not
/// multiples of 2^-40 below 2^22.
double lattice_unit(std::span<const Point3> points) {
  constexpr double kFinest = 0x1p-40;
  std::uint64_t bits = 0;
  for (const Point3& p : points)
    for (const double x : p) {
      const double multiple = std::abs(x) / kFinest;
      if (!(multiple < 0x1p62)) return 0;
      const auto n = static_cast<std::uint64_t>(multiple);
      if (static_cast<double>(n) != multiple) return 0;
      bits |= n;
    }
  return std::ldexp(kFinest, std::countr_zero(bits));
}

}  // namespace

Mesh3::Mesh3(std::span<const Point3> points, unsigned n_inserters)
    : sites(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i)
    sites[i] = {.at = {points[i][0], points[i][1], points[i][2]}};
  lay_on_lattice(lattice_unit(points));
  // Uniform points make 6.8 cells each, scanned surfaces 6 to 9, regular ones
  // 12. Memory that is never touched costs nothing but, where there is much of
  // it, a refusal; and moving all cells doubles the peak.
  constexpr std::size_t kSpare = std::size_t{1} << 21U;
  const std::size_t n = points.size();
  make_room(std::min(
      10 * n + std::min(3 * n, kSpare) + n_inserters * FreshCells::kBlock,
      max_cells));
}

/// @param unit  of the lattice; 0 if there is none
void Mesh3::lay_on_lattice(double unit) {
  if (unit == 0) return;
  lattice = predicates::Lattice(unit);
  const double reach = predicates::LatticeTies::kReach * unit;
  tie_reach2 = static_cast<float>(reach * reach);
  lattice_points.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
    lattice_points[i] = predicates::lattice_point(sites[i].at.data(), unit);
}

void Mesh3::make_room(std::size_t n) {
  if (n <= cells.size()) return;
  if (n > max_cells)
    throw std::length_error("Delaunay triangulation has over " +
                            std::to_string(max_cells) + " cells");
  cells.resize(std::min(std::max(n, 2 * cells.size()), max_cells));
}

void Mesh3::link(Facet a, Facet b) {
  cells[index(a.cell())].neighbor[a.index()] = b;
  cells[index(b.cell())].neighbor[b.index()] = a;
}

void Mesh3::relocate(CellId from, CellId to) {
  cells[index(to)] = cells[index(from)];
  remove(cells[index(from)]);
  for (unsigned i = 0; i < 4; ++i)
    link(Facet(to, i), cells[index(to)].neighbor[i]);
}

/// Cells beyond the hull lie next to one another. A mark on each, the sign of
/// its infinite radius, is taken back.
/// @param any  one of them
std::vector<CellId> Mesh3::cells_beyond_hull(CellId any) {
  std::vector<CellId> found;
  const auto add = [&](CellId c) {
    float& mark = cells[index(c)].outside2;
    if (mark < 0) return;
    mark = -mark;
    found.push_back(c);
  };
  add(any);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (unsigned k = 0; k < 3; ++k)
      add(cells[index(found[i])].neighbor[k].cell());
  for (const CellId c : found)
    cells[index(c)].outside2 = -cells[index(c)].outside2;
  return found;
}

// Moves the last cells with `keep` to these places in front of them, ascending;
// what was there moves to theirs.
template <class Keep>
void Mesh3::fill(std::span<const CellId> places, Keep keep) {
  std::size_t last = cells.size();
  cells.emplace_back(Cell{});  // room to swap
  const CellId spare{static_cast<std::uint32_t>(last)};
  for (const CellId front : places) {
    do --last;
    while (!keep(cells[last]));
    const CellId back{static_cast<std::uint32_t>(last)};
    const bool is_gap = !is_cell(cells[index(front)]);
    if (!is_gap) relocate(front, spare);
    relocate(back, front);
    if (!is_gap) relocate(spare, back);
  }
  cells.pop_back();
}

std::size_t Mesh3::compact(std::size_t end, std::vector<CellId> gaps,
                           CellId beyond_hull) {
  cells.resize(end);
  const std::vector<CellId> beyond = cells_beyond_hull(beyond_hull);
  const std::size_t n_cells = end - gaps.size();
  const std::size_t n_finite = n_cells - beyond.size();
  gaps.insert(gaps.end(), beyond.begin(), beyond.end());
  std::erase_if(gaps, [&](CellId c) { return index(c) >= n_finite; });
  std::ranges::sort(gaps);
  fill(gaps, [](const Cell& c) { return is_cell(c) && !c.is_infinite(); });
  gaps.clear();
  for (std::size_t i = n_finite; i < n_cells; ++i)
    if (!is_cell(cells[i]))
      gaps.push_back(CellId{static_cast<std::uint32_t>(i)});
  fill(gaps, is_cell);
  cells.resize(n_cells);
  return n_finite;
}

}  // namespace delaunay
