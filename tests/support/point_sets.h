/// @file
/// Seeded families of point sets, from harmless to hostile, for the tests of
/// everything that takes points. All coordinates are finite.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tests {

template <int kDim>
using Points = std::vector<Eigen::Matrix<double, kDim, 1>>;

enum class Family {
  Uniform,         ///< in the unit cube
  Clustered,       ///< around few centres, radii over ten decades
  Grid,            ///< small integers: cospherical and coplanar in plenty
  Cospherical,     ///< integer points exactly on one circle or sphere
  Rounded,         ///< on the unit sphere, up to rounding
  Collinear,       ///< exactly, along a skew line
  AxisCollinear,   ///< exactly, along one axis
  Coplanar,        ///< exactly, in a skew plane; collinear in 2D
  UlpGrid,         ///< a grid one ulp wide around a point like (0.5, 0.5, 0.5)
  Huge,            ///< of magnitude 1e150 to 1e300
  Tiny,            ///< of magnitude 1e-150
  Subnormal,       ///< a few units of 2^-1074
  MixedExponents,  ///< each coordinate of its own magnitude, 1e-300 to 1e300
  Duplicates,      ///< a handful of points over and over, -0 and 0 among them
  NearlyFlat,      ///< a hyperplane, moved by an ulp here and there
};

inline constexpr Family kFamilies[] = {
    Family::Uniform,        Family::Clustered,  Family::Grid,
    Family::Cospherical,    Family::Rounded,    Family::Collinear,
    Family::AxisCollinear,  Family::Coplanar,   Family::UlpGrid,
    Family::Huge,           Family::Tiny,       Family::Subnormal,
    Family::MixedExponents, Family::Duplicates, Family::NearlyFlat};

std::string_view name(Family family);

/// n points of the family; may hold duplicates where the family is small.
template <int kDim>
Points<kDim> make_points(Family family, std::size_t n, std::uint64_t seed);

}  // namespace tests
