#include "umbrella/exact_ratio.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "umbrella/big_integer_internal.h"

namespace umbrella {

struct ExactRatio::Large {
  BigInteger n, d;
};

namespace {

__extension__ using Int128 = __int128;

int sign(const BigInteger& x) {
  return x.is_zero() ? 0 : (x.is_negative() ? -1 : 1);
}

BigInteger power_of_two(int exponent) {
  constexpr int kLargest = 1000;  // of a double, with room
  BigInteger result(1, 0);
  for (; exponent > 0; exponent -= kLargest)
    result =
        result * BigInteger(std::ldexp(1, std::min(exponent, kLargest)), 0);
  return result;
}

}  // namespace

ExactRatio::ExactRatio(BigInteger n, BigInteger d, int exponent)
    : exponent_(exponent),
      large_(std::make_shared<const Large>(Large{std::move(n), std::move(d)})) {
}

ExactRatio::Large ExactRatio::large() const {
  if (large_) return *large_;
  return {BigInteger(static_cast<double>(n_), 0),
          BigInteger(static_cast<double>(d_), 0)};
}

int compare(const ExactRatio& a, const ExactRatio& b) {
  // Products of two numbers below 2^53 leave 20 bits of an Int128 for shifts.
  constexpr int kLargestShift = 20;
  const int shift = a.exponent_ - b.exponent_;
  if (!a.large_ && !b.large_ && std::abs(shift) <= kLargestShift) {
    const Int128 left = (Int128{a.n_} * b.d_) << std::max(shift, 0);
    const Int128 right = (Int128{b.n_} * a.d_) << std::max(-shift, 0);
    return (left > right) - (left < right);
  }
  const ExactRatio::Large x = a.large(), y = b.large();
  return sign(x.n * y.d * power_of_two(shift) -
              y.n * x.d * power_of_two(-shift));
}

}  // namespace umbrella
