/// @file
/// Whole numbers of any size, for the few ranks that doubles cannot tell
/// apart. Plain and slow: a product costs the product of the lengths.
#pragma once

#include <cstdint>
#include <vector>

namespace umbrella {

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
  using Limbs = std::vector<std::uint32_t>;  // low first, no zeros on top

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
