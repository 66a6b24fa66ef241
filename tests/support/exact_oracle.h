/// @file
/// Signs of the predicates by big integers, from the definitions and by other
/// formulas than the library's: homogeneous determinants of the points
/// themselves.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace oracle {

using Integer = boost::multiprecision::cpp_int;

/// Coordinates of all points in a common power-of-two unit.
template <std::size_t kDim>
std::vector<std::array<Integer, kDim>> to_integers(
    std::span<const double* const> points) {
  int unit = 1024;
  for (const double* p : points) {
    for (std::size_t i = 0; i < kDim; ++i) {
      int exponent = 0;
      if (std::frexp(p[i], &exponent) != 0)
        unit = std::min(unit, exponent - 53);
    }
  }
  std::vector<std::array<Integer, kDim>> result(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t i = 0; i < kDim; ++i) {
      int exponent = 0;
      const double fraction = std::frexp(points[k][i], &exponent);
      if (fraction == 0) continue;
      result[k][i] = static_cast<long long>(std::ldexp(fraction, 53));
      result[k][i] <<= static_cast<unsigned>(exponent - 53 - unit);
    }
  }
  return result;
}

/// Sign of a square matrix's determinant, by fraction-free elimination.
inline int determinant_sign(std::vector<std::vector<Integer>> m) {
  const std::size_t n = m.size();
  int sign = 1;
  Integer previous = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && m[pivot][k] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      sign = -sign;
    }
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j)
        m[i][j] = (m[i][j] * m[k][k] - m[i][k] * m[k][j]) / previous;
    previous = m[k][k];
  }
  return sign * previous.sign();
}

/// Sign of det(b - a, c - a, ...) as a determinant of rows (1, p).
template <std::size_t kDim>
int orient(const std::array<const double*, kDim + 1>& points) {
  std::vector<std::vector<Integer>> m;
  for (const auto& p : to_integers<kDim>(points)) {
    m.emplace_back(1, Integer(1));
    m.back().insert(m.back().end(), p.begin(), p.end());
  }
  return determinant_sign(std::move(m));
}

/// Rows (1, p, |p|^2): negative if the last point is inside the sphere through
/// the others, when those are positively oriented. The k-th smallest point's
/// height gains 2^(-bits (n - k)) when `bits` is not 0; the concrete value is
/// as good as an infinitesimal while |coordinates| in the common unit are
/// below 2^(bits / 8).
template <std::size_t kDim>
int in_ball(const std::array<const double*, kDim + 2>& points,
            unsigned bits = 0) {
  const auto integers = to_integers<kDim>(points);
  const unsigned n = kDim + 2;
  std::vector<std::vector<Integer>> m;
  for (const auto& p : integers) {
    m.emplace_back(1, Integer(1));
    m.back().insert(m.back().end(), p.begin(), p.end());
    Integer height = 0;
    for (const Integer& x : p) height += x * x;
    if (bits != 0) {
      unsigned rank = 0;
      for (const auto& q : integers) rank += q < p ? 1U : 0U;
      height = (height << (bits * n)) + (Integer(1) << (bits * rank));
    }
    m.back().push_back(height);
  }
  return -determinant_sign(std::move(m));
}

}  // namespace oracle
