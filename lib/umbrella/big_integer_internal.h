/// @file
/// Whole numbers of any size, for the few ranks that doubles cannot tell
/// apart. Plain: a product costs the product of the lengths.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace umbrella {

/// Digits of a magnitude to the base 2^64, low first, no zero on top. Up to
/// kFew need no allocation: a fraction of lambda^2 from coordinates of 53 bits
/// has 12, and a product of two such 24.
class Limbs {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::uint64_t* data() const {
    return size_ <= kFew ? few_.data() : many_.data();
  }
  std::uint64_t* data() { return size_ <= kFew ? few_.data() : many_.data(); }
  std::uint64_t operator[](std::size_t i) const { return data()[i]; }

  /// n digits of 0, in place of what was there.
  static Limbs zeros(std::size_t n) {
    Limbs result;
    result.size_ = n;
    if (n > kFew) result.many_.resize(n);
    return result;
  }
  /// Takes zeros off the top.
  void trim();

 private:
  static constexpr std::size_t kFew = 28;

  std::size_t size_ = 0;
  std::array<std::uint64_t, kFew> few_ = {};  // unless size_ is more
  std::vector<std::uint64_t> many_;           // if it is
};

/// Sign and magnitude; value semantics.
class BigInteger {
 public:
  BigInteger() = default;
  /// x / 2^exponent.
  /// @pre x is finite and that quotient is a whole number
  BigInteger(double x, int exponent);

  bool is_zero() const { return limbs_.empty(); }
  bool is_negative() const { return negative_; }
  BigInteger operator-() const;

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator*(const BigInteger& a, const BigInteger& b);

  /// The double nearest to 2^exponent a / b, ties to even; one rounding more
  /// where the result is subnormal.
  /// @pre a >= 0 and b > 0
  friend double nearest_quotient(const BigInteger& a, const BigInteger& b,
                                 int exponent);

 private:
  static bool less(const Limbs& a, const Limbs& b);
  static Limbs sum(const Limbs& a, const Limbs& b);
  static Limbs difference(const Limbs& a, const Limbs& b);  // a >= b
  static Limbs shifted(const Limbs& a, unsigned bits);
  static int bit_length(const Limbs& a);

  bool negative_ = false;
  Limbs limbs_;
};

struct WholeFraction {
  BigInteger numerator, denominator;
};

/// The largest e for which x / 2^e is whole; INT_MAX for 0.
int lowest_bit(double x);

}  // namespace umbrella
