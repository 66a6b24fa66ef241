/// @file
/// Fractions of whole numbers, for ranks that even the nearest doubles cannot
/// tell apart.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "delaunay/triangulation3.h"

namespace umbrella {

/// What a ratio depends on: the circle through the first three points, and the
/// sphere through all four unless `circle_only`.
struct Origin {
  std::array<delaunay::Point3, 4> points;
  bool circle_only;
};

struct WholeFraction;

/// 2^exponent n / d >= 0, compared without rounding. Small ones, as integer
/// grids have them, are quick; others are evaluated when a comparison needs
/// it.
class ExactRatio {
 public:
  ExactRatio() = default;  ///< 0
  /// @pre 0 <= n < 2^53 and 0 < d < 2^53
  ExactRatio(std::int64_t n, std::int64_t d, int exponent)
      : n_(n), d_(d), exponent_(exponent) {}
  /// whole_fraction(origin), times a power of two.
  ExactRatio(const Origin& origin, int exponent);

  /// Negative, zero or positive as a is less than, equal to or more than b.
  friend int compare(const ExactRatio& a, const ExactRatio& b);

 private:
  struct Large;
  WholeFraction whole() const;

  std::int64_t n_ = 0, d_ = 1;  // unless large_
  int exponent_ = 0;
  std::shared_ptr<Large> large_;
};

/// A rank before rounding: by `primary`, then by `secondary`.
struct ExactRank {
  ExactRatio primary, secondary;

  friend int compare(const ExactRank& a, const ExactRank& b) {
    const int by_primary = compare(a.primary, b.primary);
    return by_primary != 0 ? by_primary : compare(a.secondary, b.secondary);
  }
};

}  // namespace umbrella
