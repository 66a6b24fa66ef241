// Exact signs: all coordinates become integers in the unit of their finest
// bit, and the polynomial is evaluated in integers just wide enough.
// [-1074, 1024) takes 2100 bits for a difference: 33 limbs cover every input.

#include <cassert>
#include <initializer_list>

#include "predicates/determinant_internal.h"
#include "predicates/exact_internal.h"
#include "predicates/wide_integer_internal.h"

namespace predicates::internal {
namespace {

template <int kDim>
BitSpan bit_span(std::initializer_list<const double*> points) {
  BitSpan span;
  for (const double* p : points)
    for (int i = 0; i < kDim; ++i) span.add(p[i]);
  return span;
}

/// Makes integer difference vectors of points of kLimbs limbs.
template <std::size_t kLimbs>
struct Differences {
  int unit;

  WideInt<kLimbs> operator()(double a, double b) const {
    return to_integer<kLimbs>(a, unit) - to_integer<kLimbs>(b, unit);
  }
  Vector2<WideInt<kLimbs>> in_plane(const double* a, const double* b) const {
    return {(*this)(a[0], b[0]), (*this)(a[1], b[1])};
  }
  Vector3<WideInt<kLimbs>> in_space(const double* a, const double* b) const {
    return {(*this)(a[0], b[0]), (*this)(a[1], b[1]), (*this)(a[2], b[2])};
  }
};

/// polynomial(Differences<kLimbs>) for the first rung that holds the span.
template <class Polynomial>
int sign_on_ladder(BitSpan span, const Polynomial& polynomial) {
  if (span.low >= span.high) return 0;
  const int difference_bits = span.high - span.low + 1;
  const auto fits = [difference_bits]<std::size_t kLimbs>(WideInt<kLimbs>) {
    return difference_bits <= WideInt<kLimbs>::kDifferenceBits;
  };
  if (fits(WideInt<1>{})) return sign(polynomial(Differences<1>{span.low}));
  if (fits(WideInt<2>{})) return sign(polynomial(Differences<2>{span.low}));
  if (fits(WideInt<4>{})) return sign(polynomial(Differences<4>{span.low}));
  if (fits(WideInt<9>{})) return sign(polynomial(Differences<9>{span.low}));
  assert(fits(WideInt<33>{}));
  return sign(polynomial(Differences<33>{span.low}));
}

}  // namespace

int orient2d_integer(const double* a, const double* b, const double* c) {
  return sign_on_ladder(bit_span<2>({a, b, c}), [=](const auto& difference) {
    return orient2d_polynomial(difference.in_plane(b, a),
                               difference.in_plane(c, a));
  });
}

int orient3d_integer(const double* a, const double* b, const double* c,
                     const double* d) {
  return sign_on_ladder(bit_span<3>({a, b, c, d}), [=](const auto& difference) {
    return orient3d_polynomial(difference.in_space(b, a),
                               difference.in_space(c, a),
                               difference.in_space(d, a));
  });
}

int incircle_integer(const double* a, const double* b, const double* c,
                     const double* d) {
  return sign_on_ladder(bit_span<2>({a, b, c, d}), [=](const auto& difference) {
    return incircle_polynomial(difference.in_plane(a, d),
                               difference.in_plane(b, d),
                               difference.in_plane(c, d));
  });
}

int insphere_integer(const double* a, const double* b, const double* c,
                     const double* d, const double* e) {
  return sign_on_ladder(
      bit_span<3>({a, b, c, d, e}), [=](const auto& difference) {
        return insphere_polynomial(
            difference.in_space(a, e), difference.in_space(b, e),
            difference.in_space(c, e), difference.in_space(d, e));
      });
}

int gabriel_edge_integer(const double* a, const double* b, const double* p) {
  return sign_on_ladder(bit_span<2>({a, b, p}), [=](const auto& difference) {
    return gabriel_edge_polynomial(difference.in_plane(a, p),
                                   difference.in_plane(b, p));
  });
}

int gabriel_triangle_integer(const double* a, const double* b, const double* c,
                             const double* p) {
  return sign_on_ladder(bit_span<3>({a, b, c, p}), [=](const auto& difference) {
    return gabriel_triangle_polynomial(difference.in_space(a, c),
                                       difference.in_space(b, c),
                                       difference.in_space(p, c));
  });
}

}  // namespace predicates::internal
