/// @file
/// Exact sums of doubles without overlap [Shewchuk97, Sec. 2].
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace predicates::internal {

/// A rounded result and its rounding error: value + error is exact.
struct TwoDoubles {
  double value, error;
};

constexpr TwoDoubles two_sum(double a, double b) {
  const double x = a + b;
  const double b_virtual = x - a;
  const double a_virtual = x - b_virtual;
  return {x, (a - a_virtual) + (b - b_virtual)};
}

/// @pre |a| >= |b| or a == 0
constexpr TwoDoubles fast_two_sum(double a, double b) {
  const double x = a + b;
  return {x, b - (x - a)};
}

/// The upper 26 bits and the rest [Dekker71].
constexpr TwoDoubles split(double a) {
  const double c = 0x1.0000002p27 * a;
  const double high = c - (c - a);
  return {high, a - high};
}

/// Written without std::fma, which is a slow call on plain x86-64.
constexpr TwoDoubles two_product(double a, double b) {
  const double x = a * b;
  const auto [a_high, a_low] = split(a);
  const auto [b_high, b_low] = split(b);
  const double rest = ((x - a_high * b_high) - a_low * b_high) - a_high * b_low;
  return {x, a_low * b_low - rest};
}

/// Non-overlapping components have different bits of the exponent range.
constexpr std::size_t expansion_capacity(std::size_t n) {
  return std::min<std::size_t>(n, 2098);
}

/// The exact sum of `size` non-zero doubles, of increasing magnitude.
template <std::size_t kCapacity>
struct Expansion {
  std::array<double, kCapacity> component;
  std::size_t size = 0;

  constexpr void push(double x) {
    if (x != 0) component[size++] = x;
  }
};

/// Fast-Expansion-Sum with zero elimination [Shewchuk97, Sec. 2.4]; f is
/// taken times `sign`.
template <std::size_t kE, std::size_t kF, std::size_t kH>
constexpr void sum(const Expansion<kE>& e, const Expansion<kF>& f, double sign,
                   Expansion<kH>& h) {
  h.size = 0;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto next = [&] {
    const bool from_e =
        j == f.size || (i < e.size && (f.component[j] > e.component[i]) ==
                                          (f.component[j] > -e.component[i]));
    return from_e ? e.component[i++] : sign * f.component[j++];
  };
  if (e.size + f.size == 0) return;
  double q = next();
  while (i + j < e.size + f.size) {
    const auto [value, error] = two_sum(q, next());
    h.push(error);
    q = value;
  }
  h.push(q);
}

/// Scale-Expansion with zero elimination [Shewchuk97, Sec. 2.5].
template <std::size_t kE, std::size_t kH>
constexpr void scale(const Expansion<kE>& e, double b, Expansion<kH>& h) {
  h.size = 0;
  if (e.size == 0) return;
  auto [q, first_error] = two_product(e.component[0], b);
  h.push(first_error);
  for (std::size_t i = 1; i < e.size; ++i) {
    const TwoDoubles product = two_product(e.component[i], b);
    const TwoDoubles low = two_sum(q, product.error);
    h.push(low.error);
    const TwoDoubles high = fast_two_sum(product.value, low.value);
    h.push(high.error);
    q = high.value;
  }
  h.push(q);
}

template <std::size_t kE, std::size_t kF>
constexpr auto operator+(const Expansion<kE>& e, const Expansion<kF>& f) {
  Expansion<expansion_capacity(kE + kF)> h;
  sum(e, f, 1, h);
  return h;
}

template <std::size_t kE, std::size_t kF>
constexpr auto operator-(const Expansion<kE>& e, const Expansion<kF>& f) {
  Expansion<expansion_capacity(kE + kF)> h;
  sum(e, f, -1, h);
  return h;
}

/// The shorter factor's components each scale the longer one.
template <std::size_t kE, std::size_t kF>
constexpr auto operator*(const Expansion<kE>& e, const Expansion<kF>& f) {
  if constexpr (kE < kF) {
    return f * e;
  } else {
    Expansion<expansion_capacity(2 * kE * kF)> product;
    auto next = product;
    Expansion<expansion_capacity(2 * kE)> scaled;
    for (std::size_t j = 0; j < f.size; ++j) {
      scale(e, f.component[j], scaled);
      sum(product, scaled, 1, next);
      std::swap(product, next);
    }
    return product;
  }
}

template <std::size_t kE>
constexpr int sign(const Expansion<kE>& e) {
  if (e.size == 0) return 0;
  return e.component[e.size - 1] > 0 ? 1 : -1;
}

}  // namespace predicates::internal
