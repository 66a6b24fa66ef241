#include "umbrella/exact_ratio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "predicates/predicates.h"
#include "umbrella/big_integer_internal.h"
#include "umbrella/double_double_internal.h"

namespace umbrella {

using delaunay::Point3;

struct ExactRatio::Large {
  Enclosure enclosure;
  std::function<WholeFraction()> evaluate;
  std::optional<WholeFraction> whole;
  Origin origin;
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

/// The absolute coordinates of p - q; NaN, which equals nothing, where they
/// are rounded.
std::array<double, 3> extent(const Point3& p, const Point3& q) {
  std::array<double, 3> result{};
  for (unsigned i = 0; i < 3; ++i) {
    const auto d = DoubleDouble::difference(p[i], q[i]);
    result[i] =
        d.lo == 0 ? std::abs(d.hi) : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

/// Whether b is a moved or mirrored copy of a along the axes, as quantised
/// scans have many. May miss some.
bool are_copies(const Origin& a, const Origin& b) {
  std::array<unsigned, 4> order = {0, 1, 2, 3};
  const unsigned n = a.circle_only ? 3 : 4;
  do {
    bool match = true;
    for (unsigned i = 1; i < n && match; ++i)
      for (unsigned k = 0; k < i && match; ++k)
        match = extent(a.points[i], a.points[k]) ==
                extent(b.points[order[i]], b.points[order[k]]);
    if (match) return true;
  } while (std::next_permutation(order.begin(), order.begin() + 3));
  return false;
}

/// Whether both circles and both spheres are the same, as at the rectangles of
/// a grid.
bool are_same(const Origin& a, const Origin& b) {
  const auto& [p, q, r, s] = a.points;
  for (std::size_t k = 0; k < 4; ++k) {
    const double* x = b.points[k].data();
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
                       const Origin& origin)
    : exponent_(exponent),
      large_(std::make_shared<Large>(
          Large{enclosure, std::move(evaluate), std::nullopt, origin})) {}

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
    // Most fractions that come this far are equal; to see that from the
    // points is far quicker than to compare them.
    const Origin& x = a.large_->origin;
    const Origin& y = b.large_->origin;
    if (x.circle_only == y.circle_only && (are_copies(x, y) || are_same(x, y)))
      return 0;
  }
  const WholeFraction x = a.whole(), y = b.whole();
  return sign(x.numerator * y.denominator * power_of_two(shift) -
              y.numerator * x.denominator * power_of_two(-shift));
}

}  // namespace umbrella
