#include "ilp/links.h"

#include <algorithm>
#include <optional>

namespace ilp {
namespace {

constexpr std::uint32_t kNone = 0xffff'ffffU;

// What is known of a set of variables by adding them up.
struct Fingerprint {
  std::uint32_t n = 0;
  std::uint32_t bits = 0;  // the XOR of their numbers
  void add(VarId v) {
    ++n;
    bits ^= static_cast<std::uint32_t>(v);
  }
  friend bool operator==(Fingerprint, Fingerprint) = default;
};

Rows<std::uint32_t> pairs_of_variables(const Problem& problem,
                                       const Rows<VarId>& pairs) {
  return Rows<std::uint32_t>::inverted(
      problem.n_variables(), pairs, [](VarId v) { return index(v); },
      [](std::uint32_t p, VarId) { return p; });
}

// Rings whose nodes bear numbers of their own.
class Linker {
 public:
  explicit Linker(const Problem& problem)
      : problem_(problem), mark_(problem.n_variables(), 0) {
    links_.pairs = problem.pairs();
    links_.pairs_of = pairs_of_variables(problem, links_.pairs);
    links_.rings.reserve(problem.n_rings(), problem.rings().n_items());
    sums_.reserve(problem.n_pairs());
    for (std::size_t p = 0; p < problem.n_pairs(); ++p) add_up(p);
  }

  Links run() {
    for (std::uint32_t r = 0; r < problem_.n_rings(); ++r) add_ring(r);
    if (!links_.implied_by.empty())
      links_.pairs_of = pairs_of_variables(problem_, links_.pairs);
    return std::move(links_);
  }

 private:
  struct Node {
    Fingerprint sum;
    VarId any{};  // one of its variables
    std::uint32_t pair = kNone;
    const VarId* next = nullptr;  // variable of the pair to compare
  };

  void add_up(std::size_t pair) {
    Fingerprint sum;
    for (const VarId v : links_.pairs[pair]) sum.add(v);
    sums_.push_back(sum);
  }

  void add_ring(std::uint32_t r) {
    const std::span<const Spoke> spokes = problem_.ring(r);
    if (problem_.is_of_pairs(r)) return links_.rings.add(spokes);
    if (!guess_pairs(spokes) || !is_guess_right(spokes)) find_pairs(spokes, r);
    linked_.clear();
    for (const Spoke& s : spokes)
      linked_.push_back({s.var, nodes_[s.a].pair, nodes_[s.b].pair});
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
        node.pair = node.pair == kNone && sums_[p] == node.sum ? p : node.pair;
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
    links_.implied_by.push_back(ring);
    add_up(sums_.size());
    return static_cast<std::uint32_t>(sums_.size() - 1);
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
  std::vector<Fingerprint> sums_;    // of each pair
  std::vector<std::uint32_t> mark_;  // last search whose node has the variable
  std::uint32_t n_searches_ = 0;
  std::vector<Node> nodes_;  // of a ring
  std::vector<Spoke> linked_;
};

}  // namespace

Links link(const Problem& problem) {
  for (std::size_t r = 0; r < problem.n_rings(); ++r)
    if (!problem.is_of_pairs(r)) return Linker(problem).run();
  return {problem.pairs(),
          {},
          pairs_of_variables(problem, problem.pairs()),
          problem.rings()};
}

}  // namespace ilp
