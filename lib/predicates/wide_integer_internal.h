/// @file
/// Two's-complement integers of a fixed number of 64-bit limbs, on the stack.
///
/// Finite doubles are integers times a common power of two, so their
/// differences are exact integers. A product has as many limbs as its factors
/// together, so nothing overflows by multiplying; sums keep the width, and the
/// spare bits that difference_bits() leaves make room for them
/// (docs/math.md, "Integer stage").
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace predicates::internal {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

/// Differences of at most 2^difference_bits(L), in L limbs, leave room for
/// every sum in polynomial_internal.h.
constexpr int difference_bits(int limbs) { return 64 * limbs - 2; }

template <std::size_t kLimbs>
struct WideInt {
  std::array<std::uint64_t, kLimbs> limb;  // least significant first

  constexpr bool is_negative() const { return limb[kLimbs - 1] >> 63U != 0; }

  friend constexpr int sign(const WideInt& a) {
    if (a.is_negative()) return -1;
    for (const std::uint64_t x : a.limb)
      if (x != 0) return 1;
    return 0;
  }

  friend constexpr WideInt operator+(const WideInt& a, const WideInt& b) {
    WideInt sum;
    Uint128 carry = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      carry += Uint128{a.limb[i]} + b.limb[i];
      sum.limb[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64U;
    }
    return sum;
  }

  friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) {
    WideInt difference;
    Uint128 borrow = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Uint128 d = Uint128{a.limb[i]} - b.limb[i] - borrow;
      difference.limb[i] = static_cast<std::uint64_t>(d);
      borrow = (d >> 64U) & 1U;
    }
    return difference;
  }
};

/// Exact. The unsigned product, less 2^(64 K) b for a negative a and
/// 2^(64 L) a for a negative b.
template <std::size_t K, std::size_t L>
constexpr WideInt<K + L> operator*(const WideInt<K>& a, const WideInt<L>& b) {
  WideInt<K + L> product{};
  for (std::size_t i = 0; i < K; ++i) {
    Uint128 t = 0;
    for (std::size_t j = 0; j < L; ++j) {
      t += Uint128{a.limb[i]} * b.limb[j] + product.limb[i + j];
      product.limb[i + j] = static_cast<std::uint64_t>(t);
      t >>= 64U;
    }
    product.limb[i + L] = static_cast<std::uint64_t>(t);
  }
  const auto subtract_above = [&product](std::size_t low, const auto& x) {
    Uint128 borrow = 0;
    for (std::size_t i = 0; i < x.limb.size(); ++i) {
      const Uint128 d = Uint128{product.limb[low + i]} - x.limb[i] - borrow;
      product.limb[low + i] = static_cast<std::uint64_t>(d);
      borrow = (d >> 64U) & 1U;
    }
  };
  if (a.is_negative()) subtract_above(K, b);
  if (b.is_negative()) subtract_above(L, a);
  return product;
}

/// |x| = mantissa * 2^exponent for a finite double x.
struct Decoded {
  std::uint64_t mantissa;
  int exponent;
};

constexpr Decoded decode(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto fraction = bits & 0xf'ffff'ffff'ffffU;
  const auto field = static_cast<int>((bits >> 52U) & 0x7ffU);
  if (field == 0) return {fraction, -1074};
  return {fraction | (std::uint64_t{1} << 52U), field - 1075};
}

/// x * 2^-unit as an integer.
/// @pre x is a multiple of 2^unit and |x| < 2^(unit + 64 kLimbs - 1)
template <std::size_t kLimbs>
constexpr WideInt<kLimbs> to_integer(double x, int unit) {
  const auto [mantissa, exponent] = decode(x);
  WideInt<kLimbs> magnitude{};
  const int shift = exponent - unit;
  if (shift <= 0) {
    if (shift > -64) magnitude.limb[0] = mantissa >> -shift;
  } else if (mantissa != 0) {
    const auto low = static_cast<std::size_t>(shift) / 64;
    const auto bits = static_cast<unsigned>(shift) % 64;
    magnitude.limb[low] = mantissa << bits;
    if (bits > 11 && low + 1 < kLimbs)
      magnitude.limb[low + 1] = mantissa >> (64 - bits);
  }
  return x < 0 ? WideInt<kLimbs>{} - magnitude : magnitude;
}

/// The finest and coarsest bit of a set of doubles: each is a multiple of
/// 2^low and less than 2^high in magnitude. All zeros: low >= high.
struct BitSpan {
  int low = 1024;
  int high = -1074;

  constexpr void add(double x) {
    const auto [mantissa, exponent] = decode(x);
    if (mantissa == 0) return;
    const int lowest = exponent + std::countr_zero(mantissa);
    const int highest = exponent + 64 - std::countl_zero(mantissa);
    if (lowest < low) low = lowest;
    if (highest > high) high = highest;
  }
};

}  // namespace predicates::internal
