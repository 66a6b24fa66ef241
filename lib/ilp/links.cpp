#include "ilp/links.h"

#include <algorithm>
#include <optional>

namespace ilp {
namespace {

constexpr std::uint32_t kNone = 0xffff'ffffU;

class Linker {
 public:
  explicit Linker(const Problem& problem)
      : problem_(problem), mark_(problem.n_variables(), 0) {
    const auto n_pairs = static_cast<std::uint32_t>(problem.n_pairs());
    links_.pairs = problem.pairs();
    links_.pair_origin.reserve(n_pairs);
    links_.sums.reserve(n_pairs);
    for (std::uint32_t p = 0; p < n_pairs; ++p)
      note_pair({ConstraintKind::Pair, p});
    links_.rings.reserve(problem.n_rings(), problem.rings().n_items());
    find_pairs_of();
  }

  Links run() {
    for (std::uint32_t r = 0; r < problem_.n_rings(); ++r) add_ring(r);
    if (links_.pairs.size() > problem_.n_pairs()) find_pairs_of();
    return std::move(links_);
  }

 private:
  struct Node {
    VarSum sum;
    VarId any{};  // one of its variables
    std::uint32_t pair = kNone;
    const VarId* next = nullptr;  // variable of the pair to compare
  };

  // The pair that was added last.
  void note_pair(ConstraintId origin) {
    VarSum sum;
    for (const VarId v : links_.pairs[links_.sums.size()]) sum.add(v);
    links_.sums.push_back(sum);
    links_.pair_origin.push_back(origin);
  }

  void find_pairs_of() {
    links_.pairs_of = Rows<std::uint32_t>::inverted(
        problem_.n_variables(), links_.pairs, [](VarId v) { return index(v); },
        [](std::uint32_t p, VarId) { return p; });
  }

  void add_ring(std::uint32_t r) {
    const std::span<const Spoke> spokes = problem_.ring(r);
    linked_.clear();
    if (problem_.is_of_pairs(r)) {
      for (const Spoke& s : spokes) linked_.push_back({s.var, s.a, s.b});
    } else {
      if (!guess_pairs(spokes) || !is_guess_right(spokes))
        find_pairs(spokes, r);
      for (const Spoke& s : spokes)
        linked_.push_back({s.var, nodes_[s.a].pair, nodes_[s.b].pair});
    }
    links_.rings.add(linked_);
  }

  // For each node the first pair with the same sum. @return false: one has none
  bool guess_pairs(std::span<const Spoke> spokes) {
    std::uint32_t n_nodes = 0;
    for (const Spoke& s : spokes)
      n_nodes = std::max({n_nodes, s.a + 1, s.b + 1});
    nodes_.assign(n_nodes, {});
    for (const Spoke& s : spokes) {
      nodes_[s.a].sum.add(s.var);
      nodes_[s.a].any = s.var;
      nodes_[s.b].sum.add(s.var);
      nodes_[s.b].any = s.var;
    }
    for (Node& node : nodes_) {
      if (node.sum.n == 0) continue;
      for (const std::uint32_t p : links_.pairs_of[index(node.any)])
        node.pair =
            node.pair == kNone && links_.sums[p] == node.sum ? p : node.pair;
      if (node.pair == kNone) return false;
      node.next = links_.pairs[node.pair].data();
    }
    return true;
  }

  // Whether each node's pair lists the node's variables, in the same order.
  bool is_guess_right(std::span<const Spoke> spokes) {
    return std::ranges::all_of(spokes, [this](const Spoke& s) {
      return *nodes_[s.a].next++ == s.var && *nodes_[s.b].next++ == s.var;
    });
  }

  void find_pairs(std::span<const Spoke> spokes, std::uint32_t r) {
    const auto vars = Rows<VarId>::grouped(
        nodes_.size(), 2 * spokes.size(),
        [&spokes](std::size_t i) {
          return i % 2 == 0 ? spokes[i / 2].a : spokes[i / 2].b;
        },
        [&spokes](std::size_t i) { return spokes[i / 2].var; });
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      if (!vars[node].empty()) nodes_[node].pair = pair_with(vars[node], r);
  }

  std::uint32_t pair_with(std::span<const VarId> vars, std::uint32_t ring) {
    if (const auto found = find_pair(vars)) return *found;
    links_.pairs.add(vars);
    note_pair({ConstraintKind::Ring, ring});
    return static_cast<std::uint32_t>(links_.pairs.size() - 1);
  }

  // A pair of the problem with these variables and no other.
  std::optional<std::uint32_t> find_pair(std::span<const VarId> vars) {
    ++n_searches_;
    for (const VarId v : vars) mark_[index(v)] = n_searches_;
    for (const std::uint32_t p : links_.pairs_of[index(vars.front())]) {
      const std::span<const VarId> pair = problem_.pair(p);
      if (pair.size() == vars.size() &&
          std::ranges::all_of(
              pair, [this](VarId v) { return mark_[index(v)] == n_searches_; }))
        return p;
    }
    return std::nullopt;
  }

  const Problem& problem_;
  Links links_;
  std::vector<std::uint32_t> mark_;  // last search whose node has the variable
  std::uint32_t n_searches_ = 0;
  std::vector<Node> nodes_;  // of a ring
  std::vector<LinkedSpoke> linked_;
};

}  // namespace

Links link(const Problem& problem) { return Linker(problem).run(); }

}  // namespace ilp
