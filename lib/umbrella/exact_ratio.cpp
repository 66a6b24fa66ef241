#include "umbrella/exact_ratio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "predicates/predicates.h"
#include "umbrella/big_integer_internal.h"
#include "umbrella/circumradius_internal.h"
#include "umbrella/double_double_internal.h"

namespace umbrella {

using delaunay::Point3;

/// Along the axes.
using Extent = std::array<double, 3>;

/// Evaluated when a comparison needs it.
struct ExactRatio::Large {
  Origin origin;
  std::optional<Enclosure> enclosure = std::nullopt;
  std::unique_ptr<WholeFraction> whole = nullptr;

  const Enclosure& enclosed() {
    if (!enclosure) enclosure = umbrella::enclosure(origin);
    return *enclosure;
  }
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

/// Of the edges between the first three points.
std::array<Extent, 3> extents(const std::array<Point3, 4>& p) {
  return {extent(p[0], p[1]), extent(p[0], p[2]), extent(p[1], p[2])};
}

/// Which corner of one triangle stands for which of another.
using CornerOrder = std::array<unsigned, 3>;

/// Whether the triangle of `b`, its corners taken in that order, is a moved
/// copy of that of `a`, perhaps mirrored along axes, as quantised scans have
/// many. True only where no edge is rounded.
bool are_copies(const std::array<Extent, 3>& a, const std::array<Extent, 3>& b,
                const CornerOrder& order) {
  const auto edge = [&](unsigned i, unsigned k) -> const Extent& {
    return b[order[i] + order[k] - 1];
  };
  return a[0] == edge(0, 1) && a[1] == edge(0, 2) && a[2] == edge(1, 2);
}

/// What copies the triangle of `b` onto that of `a`, done to the last point of
/// `b`: seen from the first corner of `a`. Where the triangles lie across an
/// axis, it goes to the side of a's last point.
/// @pre they are copies in that order
Point3 copied_apex(const std::array<Point3, 4>& a,
                   const std::array<Point3, 4>& b, const CornerOrder& order) {
  const Point3& origin = b[order[0]];
  Point3 apex = b[3] - origin;
  for (unsigned i = 0; i < 3; ++i) {
    const auto seen = [i](const Point3& p, const Point3& from) {
      return p[i] - from[i];
    };
    double here = seen(a[1], a[0]), there = seen(b[order[1]], origin);
    if (here == 0) here = seen(a[2], a[0]), there = seen(b[order[2]], origin);
    if (here == 0) here = seen(a[3], a[0]), there = apex[i];
    if (std::signbit(here) != std::signbit(there)) apex[i] = -apex[i];
  }
  return apex;
}

/// Whether that lies on the sphere of `a`: so the spheres are copies, too. True
/// only where no edge at the first corners is rounded.
bool are_spheres_copies(const Origin& a, const Origin& b,
                        const CornerOrder& order) {
  const auto& [p, q, r, s] = a.points;
  const auto is_rounded = [](const Point3& x, const Point3& y) {
    const Extent e = extent(x, y);
    return e != e;
  };
  if (is_rounded(s, p) || is_rounded(b.points[3], b.points[order[0]]))
    return false;
  const Point3 u = q - p, v = r - p, w = s - p;
  const Point3 x = copied_apex(a.points, b.points, order);
  if (x == w) return true;
  return predicates::insphere(Point3::Zero().eval().data(), u.data(), v.data(),
                              w.data(), x.data()) == 0;
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

/// Whether the points show that the fractions are equal.
bool are_plainly_equal(const Origin& a, const Origin& b) {
  static constexpr std::array<CornerOrder, 6> kOrders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  if (a.circle_only != b.circle_only) return false;
  const auto a_extents = extents(a.points), b_extents = extents(b.points);
  return std::any_of(
             kOrders.begin(), kOrders.end(),
             [&](const CornerOrder& order) {
               return are_copies(a_extents, b_extents, order) &&
                      (a.circle_only || are_spheres_copies(a, b, order));
             }) ||
         are_same(a, b);
}

}  // namespace

ExactRatio::ExactRatio(const Origin& origin, int exponent)
    : exponent_(exponent), large_(std::make_shared<Large>(Large{origin})) {}

WholeFraction ExactRatio::whole() const {
  if (!large_)
    return {BigInteger(static_cast<double>(n_), 0),
            BigInteger(static_cast<double>(d_), 0)};
  if (!large_->whole)
    large_->whole =
        std::make_unique<WholeFraction>(whole_fraction(large_->origin));
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
    // Most fractions that are compared are equal; to see that from the points
    // takes a tenth of the time.
    if (shift == 0 && are_plainly_equal(a.large_->origin, b.large_->origin))
      return 0;
    const int by_enclosure =
        compare(a.large_->enclosed(), b.large_->enclosed());
    if (by_enclosure != 0) return by_enclosure;
  }
  const WholeFraction x = a.whole(), y = b.whole();
  BigInteger left = x.numerator * y.denominator;
  BigInteger right = y.numerator * x.denominator;
  if (shift > 0) left = left * power_of_two(shift);
  if (shift < 0) right = right * power_of_two(-shift);
  return sign(left - right);
}

}  // namespace umbrella
