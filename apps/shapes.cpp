#include "apps/shapes.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Generator = std::vector<Site> (*)(std::size_t, Random&);

template <Surface kSurface>
std::vector<Site> on_surface(std::size_t n, Random& random) {
  return scatter(kSurface, n, random);
}

template <auto kPoint, int kComponents = 1>
std::vector<Site> on_curve(std::size_t n, Random& random) {
  return scatter(Curve{kPoint, kComponents}, n, random);
}

std::vector<Site> on_lattice(std::size_t n, Random& /*random*/) {
  return lattice(n);
}

struct Entry {
  Shape shape;
  Generator generate;
  double noise = 0;
};

constexpr auto kEntries = std::to_array<Entry>({
    {{"knot", 3, "tube around a (2,3) torus knot, uneven, with noise; genus 1"},
     on_surface<knot>,
     0.05},
    {{"3holes", 3, "smooth surface with three holes in a row, uneven; genus 3"},
     on_surface<three_holes>},
    {{"sphere", 3, "unit sphere"}, on_surface<sphere>},
    {{"torus", 3, "torus with radii 1 and 0.4"}, on_surface<torus>},
    {{"ellipsoid", 3, "ellipsoid with half axes 1, 0.6 and 0.3"},
     on_surface<ellipsoid>},
    {{"bumpy", 3, "sphere with smooth bumps"}, on_surface<bumpy>},
    {{"cube", 3, "surface of the unit cube: sharp edges, coplanar points"},
     on_surface<cube>},
    {{"plate", 3, "surface of a box 1 x 1 x 0.05"}, on_surface<plate>},
    {{"two-spheres", 3, "two unit spheres, 0.1 apart"},
     on_surface<two_spheres>},
    {{"two-sheets", 3, "two wavy unit squares, 0.1 apart: not closed"},
     on_surface<two_sheets>},
    {{"uniform", 3, "random in the unit cube: no surface"}, uniform},
    {{"grid", 3, "cubic integer lattice: no surface"}, on_lattice},
    {{"cospherical", 3, "integer points exactly on one sphere"},
     lattice_sphere},
    {{"circle", 2, "unit circle"}, on_curve<circle>},
    {{"ellipse", 2, "ellipse with half axes 1 and 0.3"}, on_curve<ellipse>},
    {{"fourier", 2, "smooth closed curve with bays"}, on_curve<fourier>},
    {{"star", 2, "five-pointed star: sharp corners"}, on_curve<star>},
    {{"square", 2, "unit square"}, on_curve<square>},
    {{"two-circles", 2, "two unit circles, 0.4 apart"},
     on_curve<two_circles, 2>},
});

constexpr auto kShapes = [] {
  std::array<Shape, kEntries.size()> shapes;
  for (std::size_t i = 0; i < shapes.size(); ++i) shapes[i] = kEntries[i].shape;
  return shapes;
}();

const Entry& find(std::string_view name) {
  for (const Entry& entry : kEntries)
    if (entry.shape.name == name) return entry;
  throw std::invalid_argument("no shape is called '" + std::string(name) + "'");
}

}  // namespace

std::span<const Shape> all() { return kShapes; }

std::vector<Eigen::Vector3d> sample(std::string_view name, std::size_t n,
                                    const Options& options) {
  const Entry& entry = find(name);
  const double noise = options.noise.value_or(entry.noise);
  if (!(noise >= 0 && std::isfinite(noise)))
    throw std::invalid_argument("noise must be finite and not negative");
  Random random(options.seed);
  const std::vector<Site> sites = entry.generate(n, random);
  std::vector<Eigen::Vector3d> points;
  points.reserve(n);
  for (const Site& site : sites) {
    Eigen::Vector3d p = site.position;
    for (int axis = 0; axis < entry.shape.dimension && noise > 0; ++axis)
      p[axis] += noise * site.spacing * (2 * random.unit() - 1);
    points.push_back(p);
  }
  return points;
}

}  // namespace shapes
