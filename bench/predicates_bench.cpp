// One call of each predicate, and of each stage of the largest ones, on inputs
// from easy to degenerate. `undecided` is the share of inputs that the filter
// leaves to the exact stages.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "predicates/exact_internal.h"
#include "predicates/expansion_internal.h"
#include "predicates/filter_internal.h"
#include "predicates/gabriel.h"
#include "predicates/predicates.h"

namespace {

using predicates::internal::GabrielTriangle;
using predicates::internal::Insphere;
using predicates::internal::Orient3d;

using Point = std::array<double, 3>;
using Simplex = std::array<Point, 5>;
using Rng = std::mt19937_64;
using Family = Point (*)(Rng&, std::size_t simplex);

Point in_cube(Rng& rng, std::size_t) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(rng), unit(rng), unit(rng)};
}

/// On the unit sphere up to rounding: the in-sphere filter always fails.
Point near_sphere(Rng& rng, std::size_t) {
  const Point p = in_cube(rng, 0);
  const double norm = std::hypot(p[0], p[1], p[2]);
  return {p[0] / norm, p[1] / norm, p[2] / norm};
}

/// Corners of one cell of a 100^3 integer grid.
Point grid_cell(Rng& rng, std::size_t simplex) {
  Point p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = static_cast<double>(simplex * (7 * i + 1) % 100 + rng() % 2);
  return p;
}

/// On the sphere of radius 441 * scale.
Point on_integer_sphere(Rng& rng, double scale) {
  static constexpr std::array<Point, 5> kSolutions = {{{441, 0, 0},
                                                       {147, 294, 294},
                                                       {126, 189, 378},
                                                       {49, 196, 392},
                                                       {0, 441, 0}}};
  Point p = kSolutions[rng() % kSolutions.size()];
  std::shuffle(p.begin(), p.end(), rng);
  for (double& x : p) x *= rng() % 2 == 0 ? scale : -scale;
  return p;
}

/// Differences of 24 bits.
Point cospherical_24(Rng& rng, std::size_t) {
  return on_integer_sphere(rng, 18713);
}

/// Differences of 50 bits.
Point cospherical_50(Rng& rng, std::size_t) {
  return on_integer_sphere(rng, 0x1.fffffffffp+39);
}

Point any_exponent(Rng& rng, std::size_t) {
  Point p = in_cube(rng, 0);
  for (double& x : p) x = std::ldexp(x, static_cast<int>(rng() % 2000) - 1000);
  return p;
}

struct NamedFamily {
  const char* name;
  Family draw;
};

constexpr std::array<NamedFamily, 6> kFamilies = {
    {{"cube", in_cube},
     {"near_sphere", near_sphere},
     {"grid_cell", grid_cell},
     {"cospherical_24", cospherical_24},
     {"cospherical_50", cospherical_50},
     {"any_exponent", any_exponent}}};

/// Positive simplices and distinct queries.
std::vector<Simplex> simplices(Family draw) {
  Rng rng(20261122);
  std::vector<Simplex> result(512);
  for (std::size_t i = 0; i < result.size(); ++i) {
    Simplex& s = result[i];
    do {
      for (Point& p : s) p = draw(rng, i);
    } while (predicates::orient3d(s[0].data(), s[1].data(), s[2].data(),
                                  s[3].data()) <= 0 ||
             std::count(s.begin(), s.end(), s[4]) > 1);
  }
  return result;
}

using Corner = const double*;

template <class Test>
void run(benchmark::State& state, Family draw, const Test& test) {
  const auto input = simplices(draw);
  const auto call = [&test](const Simplex& s) {
    return test(s[0].data(), s[1].data(), s[2].data(), s[3].data(),
                s[4].data());
  };
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(call(input[i++ % input.size()]));
  state.SetItemsProcessed(state.iterations());
}

void count_undecided(benchmark::State& state, Family draw) {
  double orient3d = 0, insphere = 0;
  const auto input = simplices(draw);
  for (const Simplex& s : input) {
    const Corner a = s[0].data(), b = s[1].data(), c = s[2].data(),
                 d = s[3].data(), e = s[4].data();
    using namespace predicates::internal;
    orient3d += orient3d_filter(a, b, c, e) == 0 ? 1 : 0;
    insphere += insphere_filter(a, b, c, d, e) == 0 ? 1 : 0;
  }
  state.counters["orient3d_undecided"] =
      orient3d / static_cast<double>(input.size());
  state.counters["insphere_undecided"] =
      insphere / static_cast<double>(input.size());
}

template <class Test>
void add(const std::string& name, const Test& test) {
  for (const NamedFamily& f : kFamilies) {
    benchmark::RegisterBenchmark(
        (name + "/" + f.name).c_str(),
        [draw = f.draw, test](benchmark::State& state) {
          run(state, draw, test);
          count_undecided(state, draw);
        });
  }
}

void add_predicates() {
  add("orient2d", [](Corner a, Corner b, Corner c, Corner, Corner) {
    return predicates::orient2d(a, b, c);
  });
  add("orient3d", [](Corner a, Corner b, Corner c, Corner, Corner e) {
    return predicates::orient3d(a, b, c, e);
  });
  add("incircle", [](Corner a, Corner b, Corner c, Corner d, Corner) {
    return predicates::incircle(a, b, c, d);
  });
  add("insphere", [](Corner a, Corner b, Corner c, Corner d, Corner e) {
    return predicates::insphere(a, b, c, d, e);
  });
  add("insphere_perturbed",
      [](Corner a, Corner b, Corner c, Corner d, Corner e) {
        return predicates::insphere_perturbed(a, b, c, d, e);
      });
  add("gabriel_triangle", [](Corner a, Corner b, Corner c, Corner, Corner e) {
    return predicates::gabriel_triangle(a, b, c, e);
  });
}

/// Exact stages, after the filter. The expansions do nothing on any_exponent.
void add_stages() {
  using namespace predicates::internal;
  add("insphere/exact", [](Corner a, Corner b, Corner c, Corner d, Corner e) {
    return exact_sign<Insphere>({a, b, c, d, e});
  });
  add("insphere/wide_integer",
      [](Corner a, Corner b, Corner c, Corner d, Corner e) {
        return wide_integer_sign<Insphere>({a, b, c, d, e});
      });
  add("insphere/expansion",
      [](Corner a, Corner b, Corner c, Corner d, Corner e) {
        return adaptive_expansion_sign<Insphere>({a, b, c, d, e});
      });
  add("orient3d/wide_integer",
      [](Corner a, Corner b, Corner c, Corner, Corner e) {
        return wide_integer_sign<Orient3d>({a, b, c, e});
      });
  add("orient3d/expansion", [](Corner a, Corner b, Corner c, Corner, Corner e) {
    return adaptive_expansion_sign<Orient3d>({a, b, c, e});
  });
  add("gabriel_triangle/expansion",
      [](Corner a, Corner b, Corner c, Corner, Corner e) {
        return adaptive_expansion_sign<GabrielTriangle>({a, b, c, e});
      });
}

const bool kAdded = (add_predicates(), add_stages(), true);

}  // namespace
