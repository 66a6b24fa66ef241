// Diametral balls: laws, and signs against explicit centres in big integers.

#include "predicates/gabriel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "tests/support/ball_oracle.h"
#include "tests/support/predicate_inputs.h"

namespace {

using inputs::Family;
using inputs::kFamilies;
using inputs::Rng;
using inputs::Simplex;
using predicates::gabriel_edge;
using predicates::gabriel_triangle;

void expect_exact(int trials, unsigned seed) {
  for (const Family& family : kFamilies) {
    Rng rng(seed);
    for (int trial = 0; trial < trials; ++trial) {
      SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
      const Simplex s = family.draw(rng);
      const double* a = s[0].data();
      const double* b = s[1].data();
      const double* c = s[2].data();
      const double* p = s[3].data();
      EXPECT_EQ(gabriel_edge(a, b, p),
                oracle::diametral_ball_of_edge<2>({a, b, p}));
      EXPECT_EQ(gabriel_triangle(a, b, c, p),
                oracle::diametral_ball_of_triangle({a, b, c, p}));
    }
  }
}

TEST(Gabriel, AgreesWithExplicitCentres) { expect_exact(200, 1); }

TEST(SlowGabriel, AgreesWithExplicitCentres) { expect_exact(10000, 2); }

TEST(Gabriel, BallOfAnEdgeIsOpen) {
  const std::array<double, 2> a = {-1, 0}, b = {1, 0};
  const std::array<double, 2> on = {0, 1}, in = {0, 1 - 0x1p-53},
                              out = {0, 1 + 0x1p-52};
  EXPECT_EQ(gabriel_edge(a.data(), b.data(), on.data()), 0);
  EXPECT_EQ(gabriel_edge(a.data(), b.data(), in.data()), -1);
  EXPECT_EQ(gabriel_edge(a.data(), b.data(), out.data()), 1);
}

TEST(Gabriel, BallOfATriangleHasItsCircumcircleAsEquator) {
  const std::array<double, 3> a = {5, 0, 0}, b = {-3, 4, 0}, c = {0, -5, 0};
  const std::array<double, 3> pole = {0, 0, 5}, in = {0, 0, 5 - 0x1p-50},
                              out = {0, 0, 5 + 0x1p-50};
  EXPECT_EQ(gabriel_triangle(a.data(), b.data(), c.data(), pole.data()), 0);
  EXPECT_EQ(gabriel_triangle(a.data(), b.data(), c.data(), in.data()), -1);
  EXPECT_EQ(gabriel_triangle(a.data(), b.data(), c.data(), out.data()), 1);
}

TEST(Gabriel, CollinearTrianglesGiveZero) {
  const std::array<double, 3> a = {0.1, 0.2, 0.3}, b = {0.2, 0.4, 0.6},
                              c = {0.4, 0.8, 1.2}, p = {1, 2, 4};
  EXPECT_EQ(gabriel_triangle(a.data(), b.data(), c.data(), p.data()), 0);
}

TEST(Gabriel, DoesNotDependOnTheOrderOfTheCorners) {
  for (const Family& family : kFamilies) {
    Rng rng(3);
    for (int trial = 0; trial < 60; ++trial) {
      SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
      const Simplex s = family.draw(rng);
      const double* a = s[0].data();
      const double* b = s[1].data();
      const double* c = s[2].data();
      const double* p = s[3].data();
      EXPECT_EQ(gabriel_edge(a, b, p), gabriel_edge(b, a, p));
      const int abc = gabriel_triangle(a, b, c, p);
      EXPECT_EQ(gabriel_triangle(b, c, a, p), abc);
      EXPECT_EQ(gabriel_triangle(c, a, b, p), abc);
      EXPECT_EQ(gabriel_triangle(b, a, c, p), abc);
    }
  }
}

}  // namespace
