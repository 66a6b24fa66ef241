#include <algorithm>
#include <bit>
#include <cassert>
#include <climits>
#include <cmath>
#include <utility>

#include "umbrella/big_integer_internal.h"

namespace umbrella {
namespace {

constexpr unsigned kLimbBits = 64;

/// A digit and what is carried.
__extension__ using Wide = unsigned __int128;

}  // namespace

void Limbs::trim() {
  const std::uint64_t* digits = data();
  std::size_t n = size_;
  while (n > 0 && digits[n - 1] == 0) --n;
  if (size_ > kFew && n <= kFew) std::copy_n(digits, n, few_.begin());
  size_ = n;
}

int lowest_bit(double x) {
  if (x == 0) return INT_MAX;
  constexpr int kMantissaBits = 52;
  constexpr int kLeast = -1074;  // exponent of the smallest double
  const auto bits = std::bit_cast<std::uint64_t>(std::abs(x));
  const auto exponent = static_cast<int>(bits >> kMantissaBits);
  const std::uint64_t fraction = bits & ((1ULL << kMantissaBits) - 1);
  if (exponent == 0) return kLeast + std::countr_zero(fraction);
  return kLeast - 1 + exponent +
         std::countr_zero(fraction | 1ULL << kMantissaBits);
}

BigInteger::BigInteger(double x, int exponent) : negative_(x < 0) {
  if (x == 0) return;
  assert(lowest_bit(x) >= exponent);
  const int low = lowest_bit(x);
  int high = 0;
  const double fraction = std::frexp(std::abs(x), &high);
  const auto mantissa =
      static_cast<std::uint64_t>(std::ldexp(fraction, high - low));
  limbs_ = Limbs::zeros(1);
  limbs_.data()[0] = mantissa;
  limbs_ = shifted(limbs_, static_cast<unsigned>(low - exponent));
}

BigInteger BigInteger::operator-() const {
  BigInteger opposite = *this;
  opposite.negative_ = !negative_ && !is_zero();
  return opposite;
}

BigInteger operator+(const BigInteger& a, const BigInteger& b) {
  BigInteger result;
  if (a.negative_ == b.negative_) {
    result.limbs_ = BigInteger::sum(a.limbs_, b.limbs_);
    result.negative_ = a.negative_;
  } else if (BigInteger::less(a.limbs_, b.limbs_)) {
    result.limbs_ = BigInteger::difference(b.limbs_, a.limbs_);
    result.negative_ = b.negative_;
  } else {
    result.limbs_ = BigInteger::difference(a.limbs_, b.limbs_);
    result.negative_ = a.negative_ && !result.is_zero();
  }
  return result;
}

BigInteger operator-(const BigInteger& a, const BigInteger& b) {
  return a + -b;
}

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
  BigInteger product;
  product.limbs_ = Limbs::zeros(a.limbs_.size() + b.limbs_.size());
  std::uint64_t* const digits = product.limbs_.data();
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    Wide carry = 0;
    for (std::size_t k = 0; k < b.limbs_.size(); ++k) {
      carry += Wide{a.limbs_[i]} * b.limbs_[k] + digits[i + k];
      digits[i + k] = static_cast<std::uint64_t>(carry);
      carry >>= kLimbBits;
    }
    digits[i + b.limbs_.size()] = static_cast<std::uint64_t>(carry);
  }
  product.limbs_.trim();
  product.negative_ = a.negative_ != b.negative_ && !product.is_zero();
  return product;
}

// Long division, bit by bit: 55 bits of the quotient, the last of them sticky,
// are rounded once by the conversion to double.
double nearest_quotient(const BigInteger& a, const BigInteger& b,
                        int exponent) {
  assert(!a.negative_ && !b.negative_ && !b.is_zero());
  if (a.is_zero()) return 0;
  const int gap =
      BigInteger::bit_length(a.limbs_) - BigInteger::bit_length(b.limbs_);
  // Now 1/2 < rest / divisor < 2.
  auto rest = BigInteger::shifted(a.limbs_, gap < 0 ? -gap : 0);
  const auto divisor = BigInteger::shifted(b.limbs_, gap > 0 ? gap : 0);

  constexpr int kBits = 55;
  std::uint64_t quotient = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    quotient <<= 1U;
    if (!BigInteger::less(rest, divisor)) {
      quotient |= 1U;
      rest = BigInteger::difference(rest, divisor);
    }
    rest = BigInteger::shifted(rest, 1);
  }
  quotient = quotient << 1U | (rest.empty() ? 0U : 1U);
  return std::ldexp(static_cast<double>(quotient), gap - kBits + exponent);
}

bool BigInteger::less(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size();
  for (std::size_t i = a.size(); i-- > 0;)
    if (a[i] != b[i]) return a[i] < b[i];
  return false;
}

Limbs BigInteger::sum(const Limbs& a, const Limbs& b) {
  if (a.size() < b.size()) return sum(b, a);
  Limbs result = Limbs::zeros(a.size() + 1);
  std::uint64_t* const digits = result.data();
  Wide carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    carry += Wide{a[i]} + (i < b.size() ? b[i] : 0);
    digits[i] = static_cast<std::uint64_t>(carry);
    carry >>= kLimbBits;
  }
  digits[a.size()] = static_cast<std::uint64_t>(carry);
  result.trim();
  return result;
}

Limbs BigInteger::difference(const Limbs& a, const Limbs& b) {
  Limbs result = Limbs::zeros(a.size());
  std::uint64_t* const digits = result.data();
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Wide taken = Wide{borrow} + (i < b.size() ? b[i] : 0);
    borrow = a[i] < taken ? 1 : 0;
    digits[i] = a[i] - static_cast<std::uint64_t>(taken);
  }
  result.trim();
  return result;
}

Limbs BigInteger::shifted(const Limbs& a, unsigned bits) {
  if (a.empty()) return a;
  const unsigned within = bits % kLimbBits, whole = bits / kLimbBits;
  Limbs result = Limbs::zeros(whole + a.size() + 1);
  std::uint64_t* const digits = result.data();
  Wide carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    carry |= Wide{a[i]} << within;
    digits[whole + i] = static_cast<std::uint64_t>(carry);
    carry >>= kLimbBits;
  }
  digits[whole + a.size()] = static_cast<std::uint64_t>(carry);
  result.trim();
  return result;
}

int BigInteger::bit_length(const Limbs& a) {
  if (a.empty()) return 0;
  const auto top = static_cast<int>(std::bit_width(a[a.size() - 1]));
  return static_cast<int>(kLimbBits) * (static_cast<int>(a.size()) - 1) + top;
}

}  // namespace umbrella
