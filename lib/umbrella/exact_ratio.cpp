#include "umbrella/exact_ratio.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "predicates/predicates.h"
#include "umbrella/big_integer_internal.h"

namespace umbrella {

struct ExactRatio::Large {
  Enclosure enclosure;
  std::function<WholeFraction()> evaluate;
  std::optional<WholeFraction> whole;
  std::array<delaunay::Point3, 4> circle;
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

/// 0 if the enclosures do not tell. The difference of the two is computed with
/// a few roundings of its own size, or of an ulp of a low part.
int compare(const Enclosure& a, const Enclosure& b) {
  constexpr double kLowRounding = 0x1p-50;
  const double difference = (a.hi - b.hi) + (a.lo - b.lo);
  const double error =
      a.error + b.error + kLowRounding * (std::abs(a.lo) + std::abs(b.lo));
  if (!(std::abs(difference) > 2 * error)) return 0;
  return difference < 0 ? -1 : 1;
}

/// Whether both circles and both spheres are the same, as at the rectangles of
/// a grid: far quicker than to compare two fractions that are equal.
bool are_same(const std::array<delaunay::Point3, 4>& a,
              const std::array<delaunay::Point3, 4>& b) {
  const auto& [p, q, r, s] = a;
  for (std::size_t k = 0; k < 4; ++k) {
    const double* x = b[k].data();
    if (predicates::insphere(p.data(), q.data(), r.data(), s.data(), x) != 0)
      return false;
    if (k < 3 && predicates::orient3d(p.data(), q.data(), r.data(), x) != 0)
      return false;
  }
  return true;
}

}  // namespace

ExactRatio::ExactRatio(const Enclosure& enclosure,
                       std::function<WholeFraction()> evaluate, int exponent,
                       const std::array<delaunay::Point3, 4>& circle)
    : exponent_(exponent),
      large_(std::make_shared<Large>(
          Large{enclosure, std::move(evaluate), std::nullopt, circle})) {}

WholeFraction ExactRatio::whole() const {
  if (!large_)
    return {BigInteger(static_cast<double>(n_), 0),
            BigInteger(static_cast<double>(d_), 0)};
  if (!large_->whole) large_->whole = large_->evaluate();
  return *large_->whole;
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
  if (a.large_ && b.large_) {
    const int by_enclosure = compare(a.large_->enclosure, b.large_->enclosure);
    if (by_enclosure != 0) return by_enclosure;
    if (are_same(a.large_->circle, b.large_->circle)) return 0;
  }
  const WholeFraction x = a.whole(), y = b.whole();
  // Congruent simplices have the same fraction.
  if (shift == 0 && x.numerator == y.numerator &&
      x.denominator == y.denominator)
    return 0;
  return sign(x.numerator * y.denominator * power_of_two(shift) -
              y.numerator * x.denominator * power_of_two(-shift));
}

}  // namespace umbrella
