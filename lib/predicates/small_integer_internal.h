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

/// Points of a lattice: integers in some power of two as the unit, relative to
/// the predicate's origin.
template <class Predicate>
struct LatticePoints {
  std::array<std::array<std::int64_t, Predicate::kDimension>,
             Predicate::kPoints>
      n;
  int bits;  // no coordinate is more than 2^bits

  /// False if the coordinates have no common unit of at least 2^-51 times the
  /// sum of their magnitudes.
  bool assign(const Points<Predicate::kPoints>& p);

  std::array<const std::int64_t*, Predicate::kPoints> points() const {
    std::array<const std::int64_t*, Predicate::kPoints> pointers;
    for (std::size_t k = 0; k < pointers.size(); ++k) pointers[k] = n[k].data();
    return pointers;
  }
};

template <std::size_t kDimension, std::size_t kPoints>
double sum_of_magnitudes(const Points<kPoints>& p) {
  double sum = 0;
  for (const double* q : p) {
    double s = std::abs(q[0]);
    for (std::size_t i = 1; i < kDimension; ++i) s += std::abs(q[i]);
    sum += s;
  }
  return sum;
}

template <class Predicate>
bool LatticePoints<Predicate>::assign(const Points<Predicate::kPoints>& p) {
  constexpr std::size_t kDimension = Predicate::kDimension;
  const double sum = sum_of_magnitudes<kDimension>(p);
  // The sum is below 2^(field - 1022) = 2^51 units. Adding 1.5 * 2^52 units
  // rounds a coordinate to a multiple of the unit and leaves that multiple in
  // the low bits of the result, whose exponent is always the same.
  const auto field = std::bit_cast<std::uint64_t>(sum) >> 52U;
  if (field < 64 || field >= 2040) return false;
  const auto shift =
      std::bit_cast<double>(((field + 2) << 52U) | (std::uint64_t{1} << 51U));
  std::uint64_t residual = 0;
  for (std::size_t k = 0; k < Predicate::kPoints; ++k) {
    for (std::size_t i = 0; i < kDimension; ++i) {
      const double shifted = p[k][i] + shift;
      residual |= std::bit_cast<std::uint64_t>((shifted - shift) - p[k][i]);
      n[k][i] = std::bit_cast<std::int64_t>(shifted);
    }
  }
  if (residual != 0) return false;

  const auto origin = n[Predicate::kOrigin];
  std::int64_t magnitudes = 0;
  std::int64_t differences = 0;
  for (auto& q : n) {
    for (std::size_t i = 0; i < kDimension; ++i) {
      q[i] -= origin[i];
      magnitudes |= q[i] ^ (q[i] >> 63);
      differences |= q[i];
    }
  }
  const int zeros =
      std::countr_zero(static_cast<std::uint64_t>(differences)) % 64;
  for (auto& q : n)
    for (std::size_t i = 0; i < kDimension; ++i) q[i] >>= zeros;
  const auto width = std::bit_width(static_cast<std::uint64_t>(magnitudes));
  bits = static_cast<int>(width) - zeros;
  return true;
}

/// @pre the points' bits are at most kInt128Bits
template <class Predicate, class P>
int small_integer_sign(const P& p, int bits) {
  if (bits <= Predicate::kInt64Bits) {
    const auto minus = [](std::int64_t a, std::int64_t b) { return a - b; };
    const std::int64_t value = Predicate::evaluate(minus, p);
    return (value > 0) - (value < 0);
  }
  const auto minus = [](std::int64_t a, std::int64_t b) {
    return SmallInteger<1>{a - b};
  };
  return sign(Predicate::evaluate(minus, p));
}

/// The sign, if the differences are integers of few enough bits in some unit.
template <class Predicate>
std::optional<int> small_integer_sign(const Points<Predicate::kPoints>& p) {
  LatticePoints<Predicate> lattice;
  if (!lattice.assign(p) || lattice.bits > Predicate::kInt128Bits)
    return std::nullopt;
  return small_integer_sign<Predicate>(lattice.points(), lattice.bits);
}

}  // namespace predicates::internal
