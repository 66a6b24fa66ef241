// What the closing says of its programs, against the rows that it wrote.

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/shapes.h"
#include "ilp/linear_form.h"
#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"
#include "tests/support/ilp_proofs.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

using ilp::LinearForm;
using ilp::Status;

struct Told {
  LinearForm form;
  Status status;
};

/// The programs of one reconstruction with at most so many variables.
std::vector<Told> programs(std::span<const Point3> points,
                           std::size_t max_variables) {
  std::vector<Told> all;
  ReconstructOptions options;
  options.closing.conflicts = 4000;
  options.closing.on_program = [&](const LinearForm& form, Status status) {
    if (form.n_variables <= max_variables) all.push_back({form, status});
  };
  reconstruct(points, options);
  return all;
}

/// Solves the rows alone; their infeasibility is proven.
void expect_same(const Told& told) {
  const ilp::Problem rows = support::rows_alone(told.form);
  ilp::Solver solver(rows);
  support::CheckedLog checked(rows);
  solver.set_log(checked.log());
  const Status status = solver.solve({}, {.conflicts = 20'000});
  ASSERT_NE(status, Status::Limit);
  EXPECT_EQ(status, told.status);
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_EQ(checked.checker().is_refuted(), status == Status::Infeasible);
}

/// A sphere and points off it, some near each other; two that touch.
std::vector<std::vector<Point3>> inputs() {
  std::vector<std::vector<Point3>> all;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto sphere = shapes::sample("sphere", 60, {.seed = seed});
    all.push_back(sphere);
    for (const auto& p : shapes::sample("sphere", 6, {.seed = seed + 10}))
      all.back().push_back(1.3 * p);
    all.push_back(sphere);
    for (const auto& p : sphere) all.back().push_back(2 * sphere[0] - p);
    all.push_back(shapes::sample("sphere", 150, {.seed = seed, .noise = 0.5}));
    all.push_back(shapes::sample("uniform", 25, {.seed = seed}));
  }
  return all;
}

TEST(ClosingPrograms, HaveASolutionOrAProofAsTold) {
  std::size_t n_feasible = 0, n_infeasible = 0;
  const auto all = inputs();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Told& told : programs(all[i], 500)) {
      SCOPED_TRACE(testing::Message() << "input " << i);
      if (told.status == Status::Limit) continue;
      expect_same(told);
      ++(told.status == Status::Infeasible ? n_infeasible : n_feasible);
    }
  EXPECT_GT(n_feasible, 10U);
  EXPECT_GT(n_infeasible, 5U);
}

/// The short search and the long one, which knows inside from outside, find
/// the same least solutions.
TEST(ClosingPrograms, GiveTheSameSurfaceWithoutTheShortSearch) {
  struct Sample {
    std::string_view name;
    std::size_t n_points;
    double noise;
  };
  for (const auto& [name, n_points, noise] :
       {Sample{"torus", 500, 1}, Sample{"sphere", 400, 1},
        Sample{"two-sheets", 600, 0.5}, Sample{"uniform", 100, 0},
        Sample{"sphere", 2000, 0.7}, Sample{"bumpy", 2500, 0.7}}) {
    SCOPED_TRACE(name);
    const auto points = shapes::sample(name, n_points, {.noise = noise});
    ReconstructOptions options;
    const Reconstruction expected = reconstruct(points, options);
    for (const std::uint64_t conflicts : {0, 100'000}) {
      options.closing.short_search = conflicts;
      const Reconstruction found = reconstruct(points, options);
      EXPECT_EQ(found.triangles, expected.triangles);
      EXPECT_NE(found.closing.conflicts, 0U);
    }
  }
}

}  // namespace
}  // namespace umbrella
