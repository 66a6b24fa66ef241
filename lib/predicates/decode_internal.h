/// @file
/// Doubles taken apart.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace predicates::internal {

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

/// The finest and coarsest bit of a set of doubles: each is a multiple of
/// 2^low and less than 2^high in magnitude. All zeros: low >= high.
struct BitSpan {
  int low = 1024;
  int high = -1074;

  constexpr void add(double x) {
    const auto [mantissa, exponent] = decode(x);
    if (mantissa == 0) return;
    low = std::min(low, exponent + std::countr_zero(mantissa));
    high = std::max(high, exponent + 64 - std::countl_zero(mantissa));
  }
};

}  // namespace predicates::internal
