#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <vector>

#include "ilp/clauses.h"

namespace {

using ilp::Antecedent;
using ilp::Assignment;
using ilp::Clauses;
using ilp::Conflict;
using ilp::ConstraintKind;
using ilp::Literal;
using ilp::Reason;
using ilp::VarId;

Literal yes(std::uint32_t v) { return Literal(VarId{v}, true); }

Antecedent named(std::uint32_t i) {
  return Antecedent({ConstraintKind::Clause, i});
}

// Clauses "0 or i", of glue i; the second of the worse half is a reason.
TEST(Clauses, ForgetTheWorseHalfButNoReason) {
  constexpr std::uint32_t kVariables = 10;
  Assignment assignment(kVariables);
  Clauses clauses(kVariables);
  Conflict conflict;
  for (std::uint32_t i = 1; i < kVariables; ++i) {
    std::array clause = {yes(0), yes(i)};
    ASSERT_TRUE(clauses.add(clause, named(i), i, assignment, conflict));
  }
  assignment.open_level();
  assignment.assign(!yes(8), {});
  ASSERT_TRUE(clauses.propagate(!yes(8), assignment, conflict));
  ASSERT_TRUE(assignment.holds(yes(0)));

  // Of 3 to 9 but 8, the worse half.
  std::vector<std::vector<Literal>> forgotten;
  clauses.forget(assignment, [&](std::span<const Literal> clause) {
    forgotten.emplace_back(clause.begin(), clause.end());
  });
  EXPECT_THAT(forgotten, testing::UnorderedElementsAre(
                             testing::UnorderedElementsAre(yes(0), yes(9)),
                             testing::UnorderedElementsAre(yes(0), yes(7)),
                             testing::UnorderedElementsAre(yes(0), yes(6))));

  const Reason& reason = assignment.reason(VarId{0});
  EXPECT_EQ(clauses.origin(reason), named(8));
  std::vector<Literal> behind;
  clauses.explain(yes(0), assignment, behind);
  EXPECT_THAT(behind, testing::ElementsAre(!yes(8)));

  // Those that are left still force.
  assignment.backtrack(0);
  assignment.open_level();
  assignment.assign(!yes(0), {});
  ASSERT_TRUE(clauses.propagate(!yes(0), assignment, conflict));
  for (std::uint32_t i = 1; i < kVariables; ++i)
    EXPECT_EQ(assignment.holds(yes(i)), i < 6 || i == 8) << i;
}

}  // namespace
