/// @file
/// Shortcut for coordinates that are small multiples of one power of two, as
/// on integer grids and in quantised scans: exact in native integers.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "predicates/polynomial_internal.h"
#include "predicates/wide_integer_internal.h"

namespace predicates::internal {

/// Product of kDegree differences in a native integer.
template <int kDegree>
struct SmallInteger {
  using Value = std::conditional_t<kDegree <= 2, std::int64_t, Int128>;

  Value value;

  friend constexpr SmallInteger operator+(SmallInteger a, SmallInteger b) {
    return {a.value + b.value};
  }
  friend constexpr SmallInteger operator-(SmallInteger a, SmallInteger b) {
    return {a.value - b.value};
  }
  friend constexpr int sign(SmallInteger a) {
    return (a.value > 0) - (a.value < 0);
  }
};

template <int kDegreeA, int kDegreeB>
constexpr auto operator*(SmallInteger<kDegreeA> a, SmallInteger<kDegreeB> b) {
  using Product = SmallInteger<kDegreeA + kDegreeB>;
  return Product{typename Product::Value{a.value} * b.value};
}

/// The coordinates of a predicate's points as integers in a common unit.
template <class Predicate>
struct LatticePoints {
  std::array<std::array<std::int64_t, Predicate::kDimension>,
             Predicate::kPoints>
      n;
  /// Every difference from the origin is at most 2^bits multiples of 2^shift.
  int bits;
  int shift;
};

/// With S at least the sum of all |x| and a power of two, the unit is S / 2^51.
/// Adding 1.5 * 2^52 units to an x rounds it to a multiple of the unit, and
/// leaves that multiple in the low bits of the sum, whose exponent is fixed.
template <class Predicate>
std::optional<LatticePoints<Predicate>> lattice_points(
    const Points<Predicate::kPoints>& p) {
  constexpr std::size_t kDimension = Predicate::kDimension;
  std::array<double, kDimension> sum{};
  for (const double* q : p)
    for (std::size_t i = 0; i < kDimension; ++i) sum[i] += std::abs(q[i]);
  double total = sum[0];
  for (std::size_t i = 1; i < kDimension; ++i) total += sum[i];
  // total < 2^(field - 1022) = 2^51 units.
  const auto field = std::bit_cast<std::uint64_t>(total) >> 52U;
  if (field < 64 || field >= 2040) return std::nullopt;
  const auto shift_bits = ((field + 2) << 52U) | (std::uint64_t{1} << 51U);
  const auto shift = std::bit_cast<double>(shift_bits);

  LatticePoints<Predicate> result;
  std::uint64_t residual = 0;
  for (std::size_t k = 0; k < Predicate::kPoints; ++k) {
    for (std::size_t i = 0; i < kDimension; ++i) {
      const double x = p[k][i];
      const double y = x + shift;
      residual |= std::bit_cast<std::uint64_t>((y - shift) - x);
      result.n[k][i] = static_cast<std::int64_t>(
          std::bit_cast<std::uint64_t>(y) - shift_bits);
    }
  }
  if (residual != 0) return std::nullopt;

  std::int64_t magnitudes = 0;
  std::int64_t differences = 0;
  for (std::size_t k = 0; k < Predicate::kPoints; ++k) {
    for (std::size_t i = 0; i < kDimension; ++i) {
      const std::int64_t d = result.n[k][i] - result.n[Predicate::kOrigin][i];
      magnitudes |= d < 0 ? ~d : d;
      differences |= d;
    }
  }
  const auto unsigned_differences = static_cast<std::uint64_t>(differences);
  result.shift = differences == 0 ? 0 : std::countr_zero(unsigned_differences);
  result.bits =
      static_cast<int>(std::bit_width(static_cast<std::uint64_t>(magnitudes))) -
      result.shift;
  return result;
}

/// The sign, if the differences are integers of few enough bits in some unit.
template <class Predicate>
std::optional<int> small_integer_sign(const Points<Predicate::kPoints>& p) {
  const auto lattice = lattice_points<Predicate>(p);
  if (!lattice || lattice->bits > Predicate::kInt128Bits) return std::nullopt;
  std::array<const std::int64_t*, Predicate::kPoints> n;
  for (std::size_t k = 0; k < n.size(); ++k) n[k] = lattice->n[k].data();
  const auto shift = lattice->shift;
  if (lattice->bits <= Predicate::kInt64Bits) {
    const auto minus = [shift](std::int64_t a, std::int64_t b) {
      return (a - b) >> shift;
    };
    const std::int64_t value = Predicate::evaluate(minus, n);
    return (value > 0) - (value < 0);
  }
  const auto minus = [shift](std::int64_t a, std::int64_t b) {
    return SmallInteger<1>{(a - b) >> shift};
  };
  return sign(Predicate::evaluate(minus, n));
}

}  // namespace predicates::internal
