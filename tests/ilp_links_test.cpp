#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "ilp/links.h"
#include "ilp/solver.h"
#include "tests/support/ilp_programs.h"

namespace {

using ilp::Links;
using ilp::Problem;
using ilp::VarId;

using Vars = std::vector<VarId>;

Vars ascending(std::span<const VarId> vars) {
  Vars result(vars.begin(), vars.end());
  std::ranges::sort(result);
  return result;
}

Vars spokes_at(const Problem& problem, std::size_t ring, std::uint32_t node) {
  Vars result;
  for (const ilp::Spoke& s : problem.ring(ring))
    if (s.a == node || s.b == node) result.push_back(s.var);
  std::ranges::sort(result);
  return result;
}

bool has_pair(const Problem& problem, const Vars& vars) {
  for (std::size_t p = 0; p < problem.n_pairs(); ++p)
    if (ascending(problem.pair(p)) == vars) return true;
  return false;
}

// Each end of each spoke has the variables of its node, and a pair of the
// problem's own where there is one.
void expect_linked(const Problem& problem) {
  const Links links = link(problem);
  ASSERT_EQ(links.rings.size(), problem.n_rings());
  for (std::size_t r = 0; r < problem.n_rings(); ++r)
    for (std::size_t i = 0; i < problem.ring(r).size(); ++i) {
      const ilp::Spoke& spoke = problem.ring(r)[i];
      const ilp::Spoke& linked = links.rings[r][i];
      EXPECT_EQ(linked.var, spoke.var);
      for (const auto& [node, pair] :
           {std::pair{spoke.a, linked.a}, std::pair{spoke.b, linked.b}}) {
        const Vars vars = spokes_at(problem, r, node);
        EXPECT_EQ(ascending(links.pairs[pair]), vars);
        EXPECT_EQ(pair < problem.n_pairs(), has_pair(problem, vars));
      }
    }
}

void expect_listed(const Problem& problem) {
  const Links links = link(problem);
  ASSERT_EQ(links.implied_by.size(), links.pairs.size() - problem.n_pairs());
  for (std::uint32_t p = 0; p < links.pairs.size(); ++p) {
    const auto [kind, i] = links.origin(p);
    const bool is_own = p < problem.n_pairs();
    EXPECT_EQ(kind,
              is_own ? ilp::ConstraintKind::Pair : ilp::ConstraintKind::Ring);
    EXPECT_EQ(i, is_own ? p : links.implied_by[p - problem.n_pairs()]);
  }
  std::vector<std::vector<std::uint32_t>> pairs_of(problem.n_variables());
  for (std::uint32_t p = 0; p < links.pairs.size(); ++p)
    for (const VarId v : links.pairs[p]) pairs_of[index(v)].push_back(p);
  for (std::size_t v = 0; v < problem.n_variables(); ++v)
    EXPECT_THAT(links.pairs_of[v], testing::ElementsAreArray(pairs_of[v]));
}

// The same constraints, with the variables of each in a random order.
Problem shuffled(const Problem& problem, std::mt19937_64& rng) {
  Problem result;
  result.add_variables(problem.n_variables());
  for (std::size_t p = 0; p < problem.n_pairs(); ++p) {
    Vars vars(problem.pair(p).begin(), problem.pair(p).end());
    std::shuffle(vars.begin(), vars.end(), rng);
    result.add_pair(vars);
  }
  for (std::size_t r = 0; r < problem.n_rings(); ++r) {
    std::vector<ilp::Spoke> spokes(problem.ring(r).begin(),
                                   problem.ring(r).end());
    std::shuffle(spokes.begin(), spokes.end(), rng);
    result.add_ring(spokes, problem.is_optional(r));
  }
  return result;
}

TEST(Links, NameEveryNodeByThePairWithItsVariables) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = support::torus_hole(4, 3, rng());
    expect_linked(problem);
    expect_listed(problem);
    EXPECT_EQ(link(problem).pairs.size(), problem.n_pairs());
    expect_linked(shuffled(problem, rng));
  }
}

// The same constraints, with the nodes of rings named by pairs.
Problem with_rings_of_pairs(const Problem& problem) {
  Problem result;
  result.add_variables(problem.n_variables());
  for (std::size_t p = 0; p < problem.n_pairs(); ++p)
    result.add_pair(problem.pair(p));
  for (std::size_t r = 0; r < problem.n_rings(); ++r) {
    const auto ring = problem.ring(r);
    std::vector<ilp::Spoke> spokes(ring.begin(), ring.end());
    std::map<std::uint32_t, std::uint32_t> pair_of_node;
    std::set<std::uint32_t> used;  // two nodes may have the same variables
    for (ilp::Spoke& s : spokes)
      for (std::uint32_t* node : {&s.a, &s.b}) {
        const auto [at, is_new] = pair_of_node.emplace(*node, 0);
        for (std::uint32_t p = 0; is_new && p < problem.n_pairs(); ++p)
          if (ascending(problem.pair(p)) == spokes_at(problem, r, *node) &&
              used.insert(p).second) {
            at->second = p;
            break;
          }
        *node = at->second;
      }
    result.add_ring_of_pairs(spokes, problem.is_optional(r));
  }
  return support::with_fixed(result, problem.fixed());
}

TEST(Links, AreTheSameForRingsOfPairs) {
  std::mt19937_64 rng(20261123);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Problem problem = support::torus_hole(4, 3, rng());
    const Problem of_pairs = with_rings_of_pairs(problem);
    expect_listed(of_pairs);
    expect_linked(of_pairs);
    ilp::Solver solver(problem), other(of_pairs);
    for (int look = 0; look < 20; ++look) {
      const ilp::Literal some(
          VarId{static_cast<std::uint32_t>(rng() % problem.n_variables())},
          rng() % 2 == 0);
      ASSERT_EQ(other.solve(std::array{some}), solver.solve(std::array{some}));
      ASSERT_EQ(other.model(), solver.model());
      ASSERT_EQ(first_violation(of_pairs, solver.model()),
                first_violation(problem, solver.model()));
    }
  }
}

// Without a pair for some nodes, and with pairs that share size and XOR with a
// node: variables 0, 3 and 1, 2.
TEST(Links, MakePairsForNodesThatHaveNone) {
  Problem problem;
  const VarId v = problem.add_variables(6);
  ASSERT_EQ(index(v), 0U);
  const auto var = [](std::uint32_t i) { return VarId{i}; };
  problem.add_pair(Vars{var(0), var(1)});
  problem.add_pair(Vars{var(0), var(3), var(4), var(5)});
  problem.add_pair(Vars{var(2), var(1), var(4), var(5)});
  problem.add_ring(std::vector<ilp::Spoke>{
      {var(0), 0, 1}, {var(3), 0, 2}, {var(1), 1, 2}, {var(2), 2, 3}});
  problem.add_ring(std::vector<ilp::Spoke>{
      {var(1), 0, 1}, {var(2), 0, 2}, {var(4), 0, 3}, {var(5), 0, 4}});
  expect_linked(problem);
  expect_listed(problem);
}

}  // namespace
