#include <algorithm>
#include <bit>
#include <cassert>
#include <climits>
#include <cmath>
#include <utility>

#include "umbrella/big_integer_internal.h"

namespace umbrella {
namespace {

constexpr unsigned kLimbBits = 32;

void trim(std::vector<std::uint32_t>& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

}  // namespace

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
  limbs_ = {static_cast<std::uint32_t>(mantissa),
            static_cast<std::uint32_t>(mantissa >> kLimbBits)};
  trim(limbs_);
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
  product.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < b.limbs_.size(); ++k) {
      carry += std::uint64_t{a.limbs_[i]} * b.limbs_[k] + product.limbs_[i + k];
      product.limbs_[i + k] = static_cast<std::uint32_t>(carry);
      carry >>= kLimbBits;
    }
    product.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  trim(product.limbs_);
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
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(),
                                      b.rend());
}

BigInteger::Limbs BigInteger::sum(const Limbs& a, const Limbs& b) {
  if (a.size() < b.size()) return sum(b, a);
  Limbs result = a;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    carry += std::uint64_t{result[i]} + (i < b.size() ? b[i] : 0);
    result[i] = static_cast<std::uint32_t>(carry);
    carry >>= kLimbBits;
  }
  result.push_back(static_cast<std::uint32_t>(carry));
  trim(result);
  return result;
}

BigInteger::Limbs BigInteger::difference(const Limbs& a, const Limbs& b) {
  Limbs result = a;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::uint64_t taken = borrow + (i < b.size() ? b[i] : 0);
    borrow = result[i] < taken ? 1 : 0;
    result[i] = static_cast<std::uint32_t>(result[i] - taken);
  }
  trim(result);
  return result;
}

BigInteger::Limbs BigInteger::shifted(const Limbs& a, unsigned bits) {
  if (a.empty()) return a;
  const unsigned within = bits % kLimbBits;
  Limbs result(bits / kLimbBits, 0);
  std::uint64_t carry = 0;
  for (const std::uint32_t limb : a) {
    carry |= std::uint64_t{limb} << within;
    result.push_back(static_cast<std::uint32_t>(carry));
    carry >>= kLimbBits;
  }
  result.push_back(static_cast<std::uint32_t>(carry));
  trim(result);
  return result;
}

int BigInteger::bit_length(const Limbs& a) {
  if (a.empty()) return 0;
  const auto top = static_cast<int>(std::bit_width(a.back()));
  return static_cast<int>(kLimbBits) * (static_cast<int>(a.size()) - 1) + top;
}

}  // namespace umbrella
