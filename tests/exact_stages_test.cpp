// Each stage of the predicates against the others, and the arithmetic below
// them against big integers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

#include "predicates/exact_internal.h"
#include "predicates/expansion_internal.h"
#include "predicates/filter_internal.h"
#include "predicates/small_integer_internal.h"
#include "predicates/wide_integer_internal.h"
#include "tests/support/predicate_inputs.h"

namespace predicates::internal {
namespace {

using boost::multiprecision::cpp_int;
using inputs::Family;
using inputs::kFamilies;
using inputs::Rng;
using inputs::Simplex;

template <class Predicate>
Points<Predicate::kPoints> points_of(const Simplex& s) {
  Points<Predicate::kPoints> p;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = s[k].data();
  return p;
}

template <class Predicate>
int filter_sign(const Points<Predicate::kPoints>& p);
template <>
int filter_sign<Orient2d>(const Points<3>& p) {
  return orient2d_filter(p[0], p[1], p[2]);
}
template <>
int filter_sign<Orient3d>(const Points<4>& p) {
  return orient3d_filter(p[0], p[1], p[2], p[3]);
}
template <>
int filter_sign<Incircle>(const Points<4>& p) {
  return incircle_filter(p[0], p[1], p[2], p[3]);
}
template <>
int filter_sign<Insphere>(const Points<5>& p) {
  return insphere_filter(p[0], p[1], p[2], p[3], p[4]);
}
template <>
int filter_sign<GabrielEdge>(const Points<3>& p) {
  return gabriel_edge_filter(p[0], p[1], p[2]);
}
template <>
int filter_sign<GabrielTriangle>(const Points<4>& p) {
  return gabriel_triangle_filter(p[0], p[1], p[2], p[3]);
}

template <class Predicate>
class Stages : public testing::Test {};
using AllPredicates = testing::Types<Orient2d, Orient3d, Incircle, Insphere,
                                     GabrielEdge, GabrielTriangle>;
TYPED_TEST_SUITE(Stages, AllPredicates);

template <class Predicate>
class SlowStages : public testing::Test {};
TYPED_TEST_SUITE(SlowStages, AllPredicates);

/// How many inputs each stage took.
struct Taken {
  int filter = 0, small = 0, expansion = 0, all = 0;
};

template <class Predicate>
Taken expect_agreement(const Family& family, int trials) {
  Taken taken;
  Rng rng(1);
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
    const Simplex s = family.draw(rng);
    const auto p = points_of<Predicate>(s);
    const int exact = wide_integer_sign<Predicate>(p);
    EXPECT_EQ(exact_sign<Predicate>(p), exact);
    ++taken.all;
    if (const int certain = filter_sign<Predicate>(p)) {
      EXPECT_EQ(certain, exact);
      ++taken.filter;
    }
    if (const auto small = small_integer_sign<Predicate>(p)) {
      EXPECT_EQ(*small, exact);
      ++taken.small;
    }
    const auto adaptive = adaptive_expansion_sign<Predicate>(p);
    EXPECT_EQ(adaptive.value_or(exact), exact);
    EXPECT_EQ(expansion_sign<Predicate>(p), adaptive);
    taken.expansion += adaptive.has_value() ? 1 : 0;
  }
  return taken;
}

TYPED_TEST(Stages, Agree) {
  for (const Family& family : kFamilies)
    expect_agreement<TypeParam>(family, 100);
}

TYPED_TEST(SlowStages, Agree) {
  for (const Family& family : kFamilies)
    expect_agreement<TypeParam>(family, 5000);
}

// The stages meet the inputs they are for: agreement is not by abstention.
TYPED_TEST(Stages, TakeTheInputsTheyAreFor) {
  const Taken cube = expect_agreement<TypeParam>({"", inputs::in_cube}, 1000);
  EXPECT_GT(cube.filter, 990);
  EXPECT_EQ(cube.expansion, cube.all);
  EXPECT_EQ(cube.small, 0);
  for (const auto draw : {inputs::small_integers, inputs::shifted_lattice}) {
    const Taken lattice = expect_agreement<TypeParam>({"", draw}, 100);
    EXPECT_GE(lattice.small, 99);  // all but points at the origin
    EXPECT_EQ(lattice.expansion, lattice.all);
  }
  const Taken far =
      expect_agreement<TypeParam>({"", inputs::any_exponent}, 100);
  EXPECT_LT(far.expansion, 50);
}

// Products of the extreme values overflow and underflow on purpose here.
TYPED_TEST(Stages, FiltersAreNeverWrongAtTheEndsOfTheRange) {
  static constexpr double kMax = std::numeric_limits<double>::max();
  static constexpr std::array<double, 14> kValues = {
      0,         1,        1 + 0x1p-52, 0x1p-1074, 0x1p-1073,
      0x1p-1022, 0x1p-537, 0x1p512,     0x1p-1000, 0x1p1023,
      kMax,      0x1p341,  0x1p256,     0x1p-215};
  Rng rng(2);
  for (int trial = 0; trial < 5000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Simplex s = inputs::each_coordinate([&rng] {
      const double x = kValues[rng() % kValues.size()];
      return rng() % 2 == 0 ? x : -x;
    });
    const auto p = points_of<TypeParam>(s);
    const int certain = filter_sign<TypeParam>(p);
    if (certain == 0) continue;
    EXPECT_EQ(certain, wide_integer_sign<TypeParam>(p));
  }
}

template <std::size_t kLimbs>
cpp_int to_big(const WideInt<kLimbs>& a) {
  cpp_int value = a.is_negative() ? -1 : 0;
  for (std::size_t i = kLimbs; i-- > 0;) value = (value << 64) + a.limb[i];
  return value;
}

/// Long runs of zeros and ones carry furthest.
template <std::size_t kLimbs>
WideInt<kLimbs> random_wide(Rng& rng) {
  static constexpr std::array<std::uint64_t, 4> kLimbValues = {
      0, ~std::uint64_t{0}, 1, std::uint64_t{1} << 63U};
  WideInt<kLimbs> a;
  for (std::uint64_t& limb : a.limb)
    limb = rng() % 2 == 0 ? rng() : kLimbValues[rng() % 4];
  return a;
}

template <std::size_t K, std::size_t L>
void expect_wide_arithmetic(Rng& rng) {
  const auto a = random_wide<K>(rng);
  const auto b = random_wide<L>(rng);
  EXPECT_EQ(to_big(a * b), to_big(a) * to_big(b));
  EXPECT_EQ(sign(a), to_big(a).sign());
  const auto c = random_wide<K>(rng);
  const cpp_int modulus = cpp_int(1) << (64 * K);
  EXPECT_EQ((to_big(a + c) - to_big(a) - to_big(c)) % modulus, 0);
  EXPECT_EQ((to_big(a - c) - to_big(a) + to_big(c)) % modulus, 0);
}

TEST(WideInt, IsTwosComplementArithmetic) {
  Rng rng(3);
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_wide_arithmetic<1, 1>(rng);
    expect_wide_arithmetic<2, 1>(rng);
    expect_wide_arithmetic<2, 2>(rng);
    expect_wide_arithmetic<3, 4>(rng);
    expect_wide_arithmetic<9, 2>(rng);
  }
}

TEST(WideInt, HoldsEveryFiniteDoubleInItsSpan) {
  Rng rng(4);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double x =
        std::ldexp(inputs::uniform(rng), inputs::below(rng, 2099) - 1074);
    BitSpan span;
    span.add(x);
    if (x == 0) continue;
    // x = integer * 2^low with an odd integer below 2^(high - low).
    const double odd = std::ldexp(x, -span.low);
    EXPECT_EQ(std::fmod(odd, 2), x > 0 ? 1 : -1);
    EXPECT_LT(std::abs(odd), std::exp2(span.high - span.low));
    EXPECT_EQ(to_big(to_integer<1>(x, span.low)), cpp_int(odd));
    const cpp_int wide = to_big(to_integer<33>(x, -1074));
    EXPECT_EQ(wide, cpp_int(odd) << static_cast<unsigned>(span.low + 1074));
  }
}

TEST(Expansion, ProductsAndSumsAreExact) {
  Rng rng(5);
  const auto random_double = [&rng] {
    return std::ldexp(inputs::uniform(rng), inputs::below(rng, 60));
  };
  // All terms are multiples of 2^-400.
  const auto big = [](const auto& e) {
    cpp_int value = 0;
    for (std::size_t i = 0; i < e.size; ++i)
      value += cpp_int(std::ldexp(e.component[i], 400));
    return value;
  };
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::array<Expansion<1>, 4> x;
    for (auto& e : x) e.push(random_double());
    const auto u = x[0] * x[1] + x[2];
    const auto v = x[1] * x[2] - x[3];
    const cpp_int unit = cpp_int(1) << 400;
    EXPECT_EQ(big(u) * unit, big(x[0]) * big(x[1]) + big(x[2]) * unit);
    EXPECT_EQ(big(v) * unit, big(x[1]) * big(x[2]) - big(x[3]) * unit);
    EXPECT_EQ(big(u * v) * unit, big(u) * big(v));
    EXPECT_EQ(sign(u * v), cpp_int(big(u) * big(v)).sign());
    EXPECT_EQ((u * v - v * u).size, 0U);
  }
}

}  // namespace
}  // namespace predicates::internal
