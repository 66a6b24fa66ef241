/// @file
/// Families of five points that are hard on predicates; 2D tests use x and y.
#pragma once

#include <array>
#include <cmath>

#include "tests/support/degenerate_inputs.h"

namespace inputs {

/// Every exponent from -1074 to 1023, each coordinate its own.
inline Simplex any_exponent(Rng& rng) {
  return each_coordinate(
      [&] { return std::ldexp(uniform(rng), below(rng, 2099) - 1074); });
}

/// Nearly equal exponents, of any size: overflow and underflow of products.
inline Simplex one_exponent(Rng& rng) {
  const int exponent = below(rng, 2090) - 1074;
  return each_coordinate(
      [&] { return std::ldexp(uniform(rng), exponent + below(rng, 8)); });
}

/// A few of the smallest subnormals, and zeros.
inline Simplex subnormals(Rng& rng) {
  return each_coordinate([&] { return below(rng, 5) * 0x1p-1074; });
}

/// Close to the largest double: differences overflow.
inline Simplex largest(Rng& rng) {
  return each_coordinate(
      [&] { return std::ldexp(uniform(rng), 1024 - below(rng, 3)); });
}

/// Degenerate integers with one coordinate axis scaled far from the others.
inline Simplex anisotropic(Rng& rng) {
  Simplex s = small_integers(rng);
  const int exponent = below(rng, 1900) - 1000;
  for (Point& p : s) p[2] = std::ldexp(p[2], exponent);
  return s;
}

struct Family {
  const char* name;
  Simplex (*draw)(Rng&);
};

inline constexpr std::array<Family, 15> kFamilies = {{
    {"in_cube", in_cube},
    {"small_integers", small_integers},
    {"shifted_lattice", shifted_lattice},
    {"ulp_grid", ulp_grid},
    {"kettner", kettner},
    {"cospherical_integers", cospherical_integers},
    {"cocircular_integers", cocircular_integers},
    {"rounded_to_sphere", rounded_to_sphere},
    {"nearly_flat", nearly_flat},
    {"single_precision", single_precision},
    {"any_exponent", any_exponent},
    {"one_exponent", one_exponent},
    {"subnormals", subnormals},
    {"largest", largest},
    {"anisotropic", anisotropic},
}};

}  // namespace inputs
