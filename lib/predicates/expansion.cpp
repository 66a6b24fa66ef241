// The adaptive stages [Shewchuk97, Sec. 4], for any of the polynomials P.
// With x the rounded differences and t their rounding errors, |t| <= 2^-53 |x|:
// stage B is P(x), exact; stage C adds the derivative of P along t, rounded;
// stage D is P(x + t), exact. The bounds are derived in docs/math.md,
// "Expansions".

#include <cmath>

#include "predicates/decode_internal.h"
#include "predicates/exact_internal.h"
#include "predicates/expansion_internal.h"
#include "predicates/filter_internal.h"

namespace predicates::internal {
namespace {

/// Value and derivative along the rounding errors of the differences.
struct Dual {
  double value, slope;

  friend constexpr Dual operator+(Dual a, Dual b) {
    return {a.value + b.value, a.slope + b.slope};
  }
  friend constexpr Dual operator-(Dual a, Dual b) {
    return {a.value - b.value, a.slope - b.slope};
  }
  friend constexpr Dual operator*(Dual a, Dual b) {
    return {a.value * b.value, a.value * b.slope + a.slope * b.value};
  }
};

/// Every product of kDegree differences is a multiple of 2^-1074, so no
/// rounding goes below the subnormals, and every sum stays below 2^1024.
template <class Predicate>
bool in_range(const Points<Predicate::kPoints>& points) {
  BitSpan span;
  for (const double* p : points)
    for (std::size_t i = 0; i < Predicate::kDimension; ++i) span.add(p[i]);
  return Predicate::kDegree * span.low >= -1074 &&
         Predicate::kDegree * (span.high + 1) + 8 <= 1023;
}

template <class Predicate>
int full_sign(const Points<Predicate::kPoints>& p) {
  const auto minus = [](double a, double b) {
    const TwoDoubles d = two_sum(a, -b);
    Expansion<2> result{};
    result.push(d.error);
    result.push(d.value);
    return result;
  };
  return sign(Predicate::evaluate(minus, p));
}

/// Sum of the components, and twice a bound on its rounding error.
template <std::size_t kE>
TwoDoubles estimate(const Expansion<kE>& e) {
  double value = 0;
  double magnitude = 0;
  for (std::size_t i = 0; i < e.size; ++i) {
    value += e.component[i];
    magnitude += std::abs(e.component[i]);
  }
  return {value, 2 * static_cast<double>(e.size) * kRoundoff * magnitude};
}

}  // namespace

template <class Predicate>
std::optional<int> adaptive_expansion_sign(
    const Points<Predicate::kPoints>& p) {
  if (!in_range<Predicate>(p)) return std::nullopt;
  bool has_tails = false;
  const auto leading = [&has_tails](double a, double b) {
    const TwoDoubles d = two_sum(a, -b);
    has_tails |= d.error != 0;
    Expansion<1> result{};
    result.push(d.value);
    return result;
  };
  const auto b = Predicate::evaluate(leading, p);
  if (!has_tails) return sign(b);

  constexpr double k = Predicate::kDegree;
  const double magnitude = Predicate::evaluate(kRoundedMinus, p).magnitude;
  const TwoDoubles det = estimate(b);
  const int from_b =
      certain_sign(det.value, det.error + (k + 1) * kRoundoff * magnitude);
  if (from_b != 0) return from_b;

  const auto dual_minus = [](double x, double y) {
    const TwoDoubles d = two_sum(x, -y);
    return Dual{d.value, d.error};
  };
  const double corrected = det.value + Predicate::evaluate(dual_minus, p).slope;
  const int from_c = certain_sign(
      corrected, det.error + 2 * kRoundoff * std::abs(corrected) +
                     k * (k + 50) * kRoundoff * kRoundoff * magnitude);
  return from_c != 0 ? from_c : full_sign<Predicate>(p);
}

template <class Predicate>
std::optional<int> expansion_sign(const Points<Predicate::kPoints>& p) {
  if (!in_range<Predicate>(p)) return std::nullopt;
  return full_sign<Predicate>(p);
}

template std::optional<int> adaptive_expansion_sign<Orient2d>(const Points<3>&);
template std::optional<int> adaptive_expansion_sign<Orient3d>(const Points<4>&);
template std::optional<int> adaptive_expansion_sign<Incircle>(const Points<4>&);
template std::optional<int> adaptive_expansion_sign<Insphere>(const Points<5>&);
template std::optional<int> adaptive_expansion_sign<GabrielEdge>(
    const Points<3>&);
template std::optional<int> adaptive_expansion_sign<GabrielTriangle>(
    const Points<4>&);
template std::optional<int> expansion_sign<Orient2d>(const Points<3>&);
template std::optional<int> expansion_sign<Orient3d>(const Points<4>&);
template std::optional<int> expansion_sign<Incircle>(const Points<4>&);
template std::optional<int> expansion_sign<Insphere>(const Points<5>&);
template std::optional<int> expansion_sign<GabrielEdge>(const Points<3>&);
template std::optional<int> expansion_sign<GabrielTriangle>(const Points<4>&);

}  // namespace predicates::internal
