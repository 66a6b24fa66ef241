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

#include "predicates/decode_internal.h"

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
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Uint128 s = Uint128{a.limb[i]} + b.limb[i] + carry;
      sum.limb[i] = static_cast<std::uint64_t>(s);
      carry = static_cast<std::uint64_t>(s >> 64U);
    }
    return sum;
  }

  friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) {
    WideInt difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Uint128 d = Uint128{a.limb[i]} - b.limb[i] - borrow;
      difference.limb[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64U) & 1U;
    }
    return difference;
  }
};

/// product -= 2^(64 kLow) (x & mask)
template <std::size_t kLow, std::size_t kLimbs, std::size_t L>
constexpr void subtract_masked(WideInt<kLimbs>& product, const WideInt<L>& x,
                               std::uint64_t mask) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < L; ++i) {
    const Uint128 d =
        Uint128{product.limb[kLow + i]} - (x.limb[i] & mask) - borrow;
    product.limb[kLow + i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64U) & 1U;
  }
}

/// Exact. The top limb of each factor counts as a signed digit: the unsigned
/// product, less 2^(64 K) b for a negative a and 2^(64 L) a for a negative b.
template <std::size_t K, std::size_t L>
constexpr WideInt<K + L> operator*(const WideInt<K>& a, const WideInt<L>& b) {
  WideInt<K + L> product{};
  if constexpr (K == 1 && L == 1) {
    const auto p = Int128{static_cast<std::int64_t>(a.limb[0])} *
                   static_cast<std::int64_t>(b.limb[0]);
    product.limb = {static_cast<std::uint64_t>(p),
                    static_cast<std::uint64_t>(p >> 64)};
    return product;
  }
  for (std::size_t i = 0; i < K; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < L; ++j) {
      const Uint128 t =
          Uint128{a.limb[i]} * b.limb[j] + product.limb[i + j] + carry;
      product.limb[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64U);
    }
    product.limb[i + L] = carry;
  }
  const std::uint64_t a_mask = a.is_negative() ? ~std::uint64_t{0} : 0;
  const std::uint64_t b_mask = b.is_negative() ? ~std::uint64_t{0} : 0;
  subtract_masked<K>(product, b, a_mask);
  subtract_masked<L>(product, a, b_mask);
  return product;
}

/// x * 2^-unit as an integer.
/// @pre x is a multiple of 2^unit and |x| < 2^(unit + 64 kLimbs - 1)
template <std::size_t kLimbs>
constexpr WideInt<kLimbs> to_integer(double x, int unit) {
  const auto [mantissa, exponent] = decode(x);
  WideInt<kLimbs> magnitude{};
  const int shift = exponent - unit;
  if constexpr (kLimbs == 1) {
    // No branch on what is random in the data. -53 < shift < 12, or x is 0.
    const auto sign = std::bit_cast<std::uint64_t>(x) >> 63U;
    const auto right = static_cast<unsigned>(11 - shift) % 64;
    return {{(((mantissa << 11U) >> right) ^ -sign) + sign}};
  }
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

}  // namespace predicates::internal
