// Exact signs: all coordinates become integers in the unit of their finest
// bit, and the polynomial is evaluated in integers just wide enough. Doubles
// span 2^-1074 to 2^1024, so a difference has 2100 bits at most: 33 limbs.

#include <cassert>
#include <cstddef>
#include <optional>

#include "predicates/decode_internal.h"
#include "predicates/exact_internal.h"
#include "predicates/small_integer_internal.h"
#include "predicates/wide_integer_internal.h"

namespace predicates::internal {
namespace {

template <class Predicate>
BitSpan bit_span(const Points<Predicate::kPoints>& points) {
  BitSpan span;
  for (const double* p : points)
    for (std::size_t i = 0; i < Predicate::kDimension; ++i) span.add(p[i]);
  return span;
}

template <class Predicate, std::size_t kLimbs>
int sign_with_limbs(const Points<Predicate::kPoints>& p, int unit) {
  const auto minus = [unit](double a, double b) {
    return to_integer<kLimbs>(a, unit) - to_integer<kLimbs>(b, unit);
  };
  return sign(Predicate::evaluate(minus, p));
}

}  // namespace

template <class Predicate>
int wide_integer_sign(const Points<Predicate::kPoints>& p) {
  const BitSpan span = bit_span<Predicate>(p);
  if (span.low >= span.high) return 0;
  const int bits = span.high - span.low + 1;
  if (bits <= difference_bits(1))
    return sign_with_limbs<Predicate, 1>(p, span.low);
  if (bits <= difference_bits(2))
    return sign_with_limbs<Predicate, 2>(p, span.low);
  if (bits <= difference_bits(4))
    return sign_with_limbs<Predicate, 4>(p, span.low);
  if (bits <= difference_bits(9))
    return sign_with_limbs<Predicate, 9>(p, span.low);
  assert(bits <= difference_bits(33));
  return sign_with_limbs<Predicate, 33>(p, span.low);
}

template <class Predicate>
int exact_sign(const Points<Predicate::kPoints>& p) {
  if (const std::optional<int> sign = small_integer_sign<Predicate>(p))
    return *sign;
  return wide_integer_sign<Predicate>(p);
}

template int wide_integer_sign<Orient2d>(const Points<3>&);
template int wide_integer_sign<Orient3d>(const Points<4>&);
template int wide_integer_sign<Incircle>(const Points<4>&);
template int wide_integer_sign<Insphere>(const Points<5>&);
template int wide_integer_sign<GabrielEdge>(const Points<3>&);
template int wide_integer_sign<GabrielTriangle>(const Points<4>&);
template int exact_sign<Orient2d>(const Points<3>&);
template int exact_sign<Orient3d>(const Points<4>&);
template int exact_sign<Incircle>(const Points<4>&);
template int exact_sign<Insphere>(const Points<5>&);
template int exact_sign<GabrielEdge>(const Points<3>&);
template int exact_sign<GabrielTriangle>(const Points<4>&);

}  // namespace predicates::internal
