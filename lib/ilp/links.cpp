#include "ilp/links.h"

#include <algorithm>
#include <optional>

namespace ilp {
namespace {

class Linker {
 public:
  explicit Linker(const Problem& problem)
      : problem_(problem), mark_(problem.n_variables(), 0) {
    std::vector<VarId> vars;
    for (std::uint32_t p = 0; p < problem.n_pairs(); ++p) {
      add_pair(problem.pair(p), {ConstraintKind::Pair, p});
      pair_of_entry_.resize(links_.pairs.n_items(), p);
      vars.insert(vars.end(), problem.pair(p).begin(), problem.pair(p).end());
    }
    pairs_of_ = Rows<std::uint32_t>::grouped(
        problem.n_variables(), vars.size(),
        [&vars](std::size_t i) { return index(vars[i]); },
        [this](std::size_t i) { return pair_of_entry_[i]; });
  }

  Links run() {
    for (std::uint32_t r = 0; r < problem_.n_rings(); ++r) add_ring(r);
    return std::move(links_);
  }

 private:
  void add_pair(std::span<const VarId> vars, ConstraintId origin) {
    links_.pairs.add(vars);
    links_.pair_origin.push_back(origin);
  }

  void add_ring(std::uint32_t r) {
    const std::span<const Spoke> spokes = problem_.ring(r);
    const auto node_of_end = [&spokes](std::size_t i) {
      return i % 2 == 0 ? spokes[i / 2].a : spokes[i / 2].b;
    };
    nodes_.group(2 * spokes.size(), 2 * spokes.size(), node_of_end,
                 [&spokes](std::size_t i) { return spokes[i / 2].var; });

    pair_of_node_.assign(nodes_.size(), 0);
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      if (!nodes_[node].empty())
        pair_of_node_[node] = pair_with(nodes_[node], r);

    linked_.clear();
    for (const Spoke& s : spokes)
      linked_.push_back({s.var, pair_of_node_[s.a], pair_of_node_[s.b]});
    links_.rings.add(linked_);
  }

  std::uint32_t pair_with(std::span<const VarId> vars, std::uint32_t ring) {
    if (const auto found = find_pair(vars)) return *found;
    add_pair(vars, {ConstraintKind::Ring, ring});
    return static_cast<std::uint32_t>(links_.pairs.size() - 1);
  }

  // A pair of the problem with these variables and no other.
  std::optional<std::uint32_t> find_pair(std::span<const VarId> vars) {
    ++n_searches_;
    for (const VarId v : vars) mark_[index(v)] = n_searches_;
    for (const std::uint32_t p : pairs_of_[index(vars.front())]) {
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
  std::vector<std::uint32_t> pair_of_entry_;
  Rows<std::uint32_t> pairs_of_;
  std::vector<std::uint32_t> mark_;  // last search whose node has the variable
  std::uint32_t n_searches_ = 0;
  Rows<VarId> nodes_;  // of the ring at hand, as the next two
  std::vector<std::uint32_t> pair_of_node_;
  std::vector<LinkedSpoke> linked_;
};

}  // namespace

Links link(const Problem& problem) { return Linker(problem).run(); }

}  // namespace ilp
