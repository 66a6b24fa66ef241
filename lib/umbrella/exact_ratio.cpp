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

/// Along the axes.
using Extent = std::array<double, 3>;

struct ExactRatio::Large {
  Enclosure enclosure;
  std::function<WholeFraction()> evaluate;
  std::optional<WholeFraction> whole;
  Origin origin;
  std::array<Extent, 6> extents;
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
Extent extent(const Point3& p, const Point3& q) {
  Extent result{};
  for (unsigned i = 0; i < 3; ++i) {
    const auto d = DoubleDouble::difference(p[i], q[i]);
    result[i] =
        d.lo == 0 ? std::abs(d.hi) : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

/// Of each edge between two points: those of the first three, then to the last.
std::array<Extent, 6> extents(const std::array<Point3, 4>& p) {
  return {extent(p[0], p[1]), extent(p[0], p[2]), extent(p[1], p[2]),
          extent(p[0], p[3]), extent(p[1], p[3]), extent(p[2], p[3])};
}

/// Whether b is a moved or mirrored copy of a along the axes, as quantised
/// scans have many. May miss some.
bool are_copies(const std::array<Extent, 6>& a, const std::array<Extent, 6>& b,
                bool circle_only) {
  // Edges of a copy whose first three points are taken in another order.
  static constexpr std::array<std::array<unsigned, 6>, 6> kOrders = {
      {{0, 1, 2, 3, 4, 5},
       {1, 0, 2, 3, 5, 4},
       {0, 2, 1, 4, 3, 5},
       {2, 0, 1, 4, 5, 3},
       {1, 2, 0, 5, 3, 4},
       {2, 1, 0, 5, 4, 3}}};
  const unsigned n = circle_only ? 3 : 6;
  return std::any_of(kOrders.begin(), kOrders.end(), [&](const auto& order) {
    for (unsigned i = 0; i < n; ++i)
      if (a[i] != b[order[i]]) return false;
    return true;
  });
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
      large_(std::make_shared<Large>(Large{enclosure, std::move(evaluate),
                                           std::nullopt, origin,
                                           extents(origin.points)})) {}

std::pair<double, double> ExactRatio::estimate() const {
  if (large_) return {large_->enclosure.hi, large_->enclosure.lo};
  return {
      std::ldexp(static_cast<double>(n_) / static_cast<double>(d_), exponent_),
      0};
}

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
    if (x.circle_only == y.circle_only &&
        (are_copies(a.large_->extents, b.large_->extents, x.circle_only) ||
         are_same(x, y)))
      return 0;
  }
  const WholeFraction x = a.whole(), y = b.whole();
  BigInteger left = x.numerator * y.denominator;
  BigInteger right = y.numerator * x.denominator;
  if (shift > 0) left = left * power_of_two(shift);
  if (shift < 0) right = right * power_of_two(-shift);
  return sign(left - right);
}

}  // namespace umbrella
