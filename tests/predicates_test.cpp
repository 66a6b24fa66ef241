// The laws of the predicates, and their signs against big integers.

#include "predicates/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "predicates/lattice.h"
#include "predicates/lattice_ties.h"
#include "tests/support/exact_oracle.h"
#include "tests/support/predicate_inputs.h"

namespace {

using inputs::Family;
using inputs::kFamilies;
using inputs::Point;
using inputs::Rng;
using inputs::Simplex;
using predicates::incircle;
using predicates::incircle_perturbed;
using predicates::insphere;
using predicates::insphere_perturbed;
using predicates::orient2d;
using predicates::orient3d;

int orient2d(const Simplex& s) {
  return orient2d(s[0].data(), s[1].data(), s[2].data());
}
int orient3d(const Simplex& s) {
  return orient3d(s[0].data(), s[1].data(), s[2].data(), s[3].data());
}
int incircle(const Simplex& s) {
  return incircle(s[0].data(), s[1].data(), s[2].data(), s[3].data());
}
int insphere(const Simplex& s) {
  return insphere(s[0].data(), s[1].data(), s[2].data(), s[3].data(),
                  s[4].data());
}
int incircle_perturbed(const Simplex& s) {
  return incircle_perturbed(s[0].data(), s[1].data(), s[2].data(), s[3].data());
}
int insphere_perturbed(const Simplex& s) {
  return insphere_perturbed(s[0].data(), s[1].data(), s[2].data(), s[3].data(),
                            s[4].data());
}

/// Calls check(simplex) on `trials` draws of each family.
template <class Check>
void for_each_input(int trials, unsigned seed, const Check& check) {
  for (const Family& family : kFamilies) {
    Rng rng(seed);
    for (int trial = 0; trial < trials; ++trial) {
      SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
      check(family.draw(rng));
      if (testing::Test::HasFailure()) return;
    }
  }
}

void expect_exact(const Simplex& s) {
  const double* a = s[0].data();
  const double* b = s[1].data();
  const double* c = s[2].data();
  const double* d = s[3].data();
  const double* e = s[4].data();
  EXPECT_EQ(orient2d(a, b, c), oracle::orient<2>({a, b, c}));
  EXPECT_EQ(orient3d(a, b, c, d), oracle::orient<3>({a, b, c, d}));
  EXPECT_EQ(incircle(a, b, c, d), oracle::in_ball<2>({a, b, c, d}));
  EXPECT_EQ(insphere(a, b, c, d, e), oracle::in_ball<3>({a, b, c, d, e}));
}

/// The contracts' preconditions; s[0] and s[1] change places if that helps.
bool make_positive2d(Simplex& s) {
  if (orient2d(s) < 0) std::swap(s[0], s[1]);
  const auto same = [&s](std::size_t i) {
    return s[i][0] == s[3][0] && s[i][1] == s[3][1];
  };
  return orient2d(s) > 0 && !same(0) && !same(1) && !same(2);
}

bool make_positive3d(Simplex& s) {
  if (orient3d(s) < 0) std::swap(s[0], s[1]);
  return orient3d(s) > 0 && s[4] != s[0] && s[4] != s[1] && s[4] != s[2] &&
         s[4] != s[3];
}

// A raise of 2^-k units of the height's last place stands for an infinitesimal
// one: the families below have coordinates of up to 53 bits.
constexpr unsigned kRaiseBits = 600;

/// Counts the ties that the perturbation broke.
struct PerturbedCheck {
  int ties = 0;

  void operator()(Simplex s) {
    if (make_positive2d(s)) {
      ties += incircle(s) == 0 ? 1 : 0;
      EXPECT_EQ(incircle_perturbed(s),
                oracle::in_ball<2>(
                    {s[0].data(), s[1].data(), s[2].data(), s[3].data()},
                    kRaiseBits));
    }
    if (make_positive3d(s)) {
      ties += insphere(s) == 0 ? 1 : 0;
      EXPECT_EQ(insphere_perturbed(s),
                oracle::in_ball<3>({s[0].data(), s[1].data(), s[2].data(),
                                    s[3].data(), s[4].data()},
                                   kRaiseBits));
    }
  }
};

constexpr std::array<Family, 6> kTies = {{
    {"small_integers", inputs::small_integers},
    {"shifted_lattice", inputs::shifted_lattice},
    {"ulp_grid", inputs::ulp_grid},
    {"cospherical_integers", inputs::cospherical_integers},
    {"cocircular_integers", inputs::cocircular_integers},
    {"rounded_to_sphere", inputs::rounded_to_sphere},
}};

int broken_ties(int trials, unsigned seed) {
  PerturbedCheck check;
  for (const Family& family : kTies) {
    Rng rng(seed);
    for (int trial = 0; trial < trials; ++trial) {
      SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
      check(family.draw(rng));
    }
  }
  return check.ties;
}

TEST(Orientation, OfTheAxesIsPositive) {
  const Simplex axes = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}};
  EXPECT_EQ(orient2d(axes), 1);
  EXPECT_EQ(orient3d(axes), 1);
}

TEST(InBall, IsPositiveInsideAPositiveSimplex) {
  Simplex s = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}}};
  EXPECT_EQ(insphere(s), 1);
  s[4] = {1, 1, 1};
  EXPECT_EQ(insphere(s), 0);
  s[4] = {1, 1, 1 + 0x1p-52};
  EXPECT_EQ(insphere(s), -1);
  s[3] = {1, 1, 0};
  EXPECT_EQ(incircle(s), 0);
  s[3] = {1, 1 - 0x1p-53, 0};
  EXPECT_EQ(incircle(s), 1);
  s[3] = {1, 1 + 0x1p-52, 0};
  EXPECT_EQ(incircle(s), -1);
}

TEST(Predicates, AgreeWithBigIntegers) {
  for_each_input(200, 1, expect_exact);  // 12000 signs
}

TEST(SlowPredicates, AgreeWithBigIntegers) {
  for_each_input(20000, 2, expect_exact);  // 1.2 million signs
}

TEST(Predicates, ChangeSignWhenTwoPointsAreExchanged) {
  for_each_input(60, 3, [](const Simplex& s) {
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        Simplex t = s;
        std::swap(t[i], t[j]);
        if (i < 3) {
          EXPECT_EQ(orient2d(t), -orient2d(s));
        }
        if (i < 4) {
          EXPECT_EQ(orient3d(t), -orient3d(s));
        }
        if (i < 4) {
          EXPECT_EQ(incircle(t), -incircle(s));
        }
        EXPECT_EQ(insphere(t), -insphere(s));
      }
    }
  });
}

TEST(Predicates, KeepTheirSignUnderScalingByPowersOfTwo) {
  for (const Family& family : kTies) {
    Rng rng(4);
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE(testing::Message() << family.name << ", trial " << trial);
      const Simplex s = family.draw(rng);
      // Coordinates are multiples of 2^-60 and below 2^40.
      for (const int exponent : {-1014, -400, -200, -100, 90, 200, 400, 983}) {
        Simplex t = s;
        for (Point& p : t)
          for (double& x : p) x = std::ldexp(x, exponent);
        EXPECT_EQ(orient2d(t), orient2d(s));
        EXPECT_EQ(orient3d(t), orient3d(s));
        EXPECT_EQ(incircle(t), incircle(s));
        EXPECT_EQ(insphere(t), insphere(s));
      }
    }
  }
}

TEST(Predicates, KeepTheirSignUnderExactTranslation) {
  Rng rng(5);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Simplex s = inputs::small_integers(rng);
    Simplex t = s;
    const Point offset = {std::ldexp(inputs::below(rng, 1024) - 512, 40),
                          0x1p51,
                          std::ldexp(inputs::below(rng, 1024) - 512, 10)};
    for (Point& p : t)
      for (std::size_t i = 0; i < 3; ++i) p[i] += offset[i];
    EXPECT_EQ(orient2d(t), orient2d(s));
    EXPECT_EQ(orient3d(t), orient3d(s));
    EXPECT_EQ(incircle(t), incircle(s));
    EXPECT_EQ(insphere(t), insphere(s));
  }
}

TEST(Perturbed, IsTheSignWithConcreteSmallRaises) {
  EXPECT_GT(broken_ties(300, 6), 500);
}

TEST(SlowPerturbed, IsTheSignWithConcreteSmallRaises) {
  EXPECT_GT(broken_ties(10000, 7), 15000);
}

TEST(Perturbed, KeepsTheSignOfADeterminantThatIsNotZero) {
  for_each_input(60, 8, [](Simplex s) {
    if (make_positive2d(s)) {
      EXPECT_NE(incircle_perturbed(s), 0);
      if (incircle(s) != 0) {
        EXPECT_EQ(incircle_perturbed(s), incircle(s));
      }
    }
    if (make_positive3d(s)) {
      EXPECT_NE(insphere_perturbed(s), 0);
      if (insphere(s) != 0) {
        EXPECT_EQ(insphere_perturbed(s), insphere(s));
      }
    }
  });
}

TEST(Perturbed, IsTheSameForEvenPermutationsOfTheSimplex) {
  for_each_input(60, 9, [](Simplex s) {
    if (make_positive2d(s)) {
      const Simplex t = {s[1], s[2], s[0], s[3], s[4]};
      EXPECT_EQ(incircle_perturbed(t), incircle_perturbed(s));
    }
    if (make_positive3d(s)) {
      const Simplex t = {s[1], s[0], s[3], s[2], s[4]};
      const Simplex u = {s[0], s[2], s[3], s[1], s[4]};
      EXPECT_EQ(insphere_perturbed(t), insphere_perturbed(s));
      EXPECT_EQ(insphere_perturbed(u), insphere_perturbed(s));
    }
  });
}

// e is inside the sphere of abcd when d is outside that of abce, if those two
// are on the same side of abc; both inside or both outside otherwise.
TEST(Perturbed, ChangesSignWhenTheQueryAndACornerAreExchanged) {
  for_each_input(100, 10, [](Simplex s) {
    if (!make_positive3d(s)) return;
    Simplex t = {s[0], s[1], s[2], s[4], s[3]};
    const int side = orient3d(t);
    if (side == 0) return;
    if (side < 0) std::swap(t[0], t[1]);
    EXPECT_EQ(insphere_perturbed(t), -side * insphere_perturbed(s));
  });
}

// Points on a lattice of some unit, up to `bits` bits of units apart.
Simplex lattice_points(Rng& rng, int bits, double unit) {
  const Point shift = {1000.0 * inputs::below(rng, 9), -77, 3};
  Simplex s = inputs::each_coordinate(
      [&] { return std::ldexp(inputs::uniform(rng), bits); });
  for (Point& p : s)
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = (std::floor(p[i]) + shift[i]) * unit;
  return s;
}

// Reaches below and above those within which doubles are exact, and so few
// different coordinates at first that most determinants vanish.
TEST(Lattice, AgreesWithThePredicatesOfAnyPoints) {
  Rng rng(20);
  for (const int exponent : {-150, -40, 0, 150}) {
    const double unit = std::ldexp(1, exponent);
    const predicates::Lattice lattice(unit);
    for (int trial = 0; trial < 20000; ++trial) {
      SCOPED_TRACE(testing::Message()
                   << "unit 2^" << exponent << ", trial " << trial);
      const Simplex s = lattice_points(rng, trial % 21, unit);
      ASSERT_EQ(
          lattice.orient3d(s[0].data(), s[1].data(), s[2].data(), s[3].data()),
          orient3d(s));
      if (orient3d(s) <= 0 || std::count(s.begin(), s.end(), s[4]) > 1)
        continue;
      ASSERT_EQ(
          lattice.insphere_perturbed(s[0].data(), s[1].data(), s[2].data(),
                                     s[3].data(), s[4].data()),
          insphere_perturbed(s));
    }
  }
}

TEST(Lattice, AgreesOnCosphericalPoints) {
  Rng rng(21);
  const predicates::Lattice none;
  const predicates::Lattice lattice(0x1p-13);
  for (int trial = 0; trial < 50000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Simplex s = inputs::cospherical_integers(rng);
    if (orient3d(s) <= 0 || std::count(s.begin(), s.end(), s[4]) > 1) continue;
    const int expected = insphere_perturbed(s);
    for (const auto& l : {none, lattice})
      ASSERT_EQ(l.insphere_perturbed(s[0].data(), s[1].data(), s[2].data(),
                                     s[3].data(), s[4].data()),
                expected);
  }
}

/// All points of the lattice whose distance from center / 2 is that of 0, if it
/// is at most `reach`.
std::vector<Point> sphere_through_origin(const std::array<int, 3>& center,
                                         int reach) {
  const auto [x, y, z] = center;
  const int r2 = x * x + y * y + z * z;  // of doubled coordinates
  std::vector<Point> points;
  if (r2 > 4 * reach * reach) return points;
  for (int i = -2 * reach; i <= 2 * reach; ++i)
    for (int j = -2 * reach; j <= 2 * reach; ++j)
      for (int k = -2 * reach; k <= 2 * reach; ++k) {
        const int u = 2 * i - x, v = 2 * j - y, w = 2 * k - z;
        if (u * u + v * v + w * w == r2)
          points.push_back({1. * i, 1. * j, 1. * k});
      }
  return points;
}

bool is_inside_tied(const Simplex& s, double unit) {
  using predicates::lattice_point;
  const predicates::LatticeTies ties(lattice_point(s[4].data(), unit));
  return ties.is_inside(
      lattice_point(s[0].data(), unit), lattice_point(s[1].data(), unit),
      lattice_point(s[2].data(), unit), lattice_point(s[3].data(), unit));
}

// Spheres of all radii that are allowed, the largest with points 16 apart; far
// from the origin, where the numbers leave 16 bits.
TEST(LatticeTies, AgreesWithThePredicateOnCosphericalPoints) {
  constexpr int kReach = static_cast<int>(predicates::LatticeTies::kReach);
  Rng rng(22);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const bool is_largest = trial % 4 == 0;
    std::array<int, 3> center = {2 * kReach, 0, 0};
    if (!is_largest)
      for (int& x : center) x = inputs::below(rng, 4 * kReach + 1) - 2 * kReach;
    const auto sphere = sphere_through_origin(center, kReach);
    const double unit = std::ldexp(1, trial % 80 - 60);
    const Point shift = {std::floor(inputs::uniform(rng) * 0x1p40),
                         std::floor(inputs::uniform(rng) * 0x1p17), -3};
    for (int draw = 0; draw < 50 && sphere.size() > 4; ++draw) {
      Simplex s;
      for (Point& p : s) {
        p = sphere[inputs::below(rng, static_cast<int>(sphere.size()))];
        for (std::size_t i = 0; i < 3; ++i) p[i] = (p[i] + shift[i]) * unit;
      }
      if (orient3d(s) <= 0 || std::count(s.begin(), s.end(), s[4]) > 1)
        continue;
      ASSERT_EQ(insphere(s), 0);
      ASSERT_EQ(is_inside_tied(s, unit), insphere_perturbed(s) > 0);
    }
  }
}

}  // namespace
