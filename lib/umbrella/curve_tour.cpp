#include "umbrella/curve_tour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "umbrella/disjoint_sets_internal.h"

// A 1-tree is a spanning tree of all vertices but one, the root, and two edges
// at the root. Tours are 1-trees, so the shortest 1-tree is a lower bound, also
// when every vertex v adds a price pi(v) to its edges, which adds 2 sum pi to
// all tours alike. Prices rise where a 1-tree has too many edges and fall where
// it has too few; on samples of curves the best prices often leave no gap.
// Where they do, an edge at a crowded vertex is forbidden, then required.

namespace umbrella {
namespace {

using EdgeIndex = std::uint32_t;
using Vertex = std::uint32_t;

enum class State : std::uint8_t { Free, Required, Forbidden };

constexpr double kNever = std::numeric_limits<double>::infinity();

class TourSearch {
 public:
  TourSearch(std::size_t n_vertices, std::span<const TourEdge> edges,
             const TourOptions& options);
  TourResult run(std::span<const EdgeIndex> start);

 private:
  bool decide(EdgeIndex e, State state);
  bool propagate(Vertex v);
  void undo(std::size_t mark);

  double one_tree();
  bool add_root_edges(double& sum);
  double raise_bound(unsigned rounds);
  void change_prices(double bound, double step);
  bool is_tour() const;
  void keep(double length);
  EdgeIndex branching_edge() const;
  void search(unsigned depth);
  bool out_of_time() const { return n_trees_ >= options_.trees; }
  // Sums of n terms: what differs by less is not told apart.
  double slack() const { return 1e-12 * static_cast<double>(n_) * longest_; }

  std::size_t n_;
  std::span<const TourEdge> edges_;
  TourOptions options_;
  std::vector<std::vector<EdgeIndex>> at_;  // edges of a vertex
  std::vector<State> state_;
  std::vector<EdgeIndex> trail_;      // decided edges, for undo
  std::vector<unsigned> n_required_;  // of a vertex
  std::vector<unsigned> n_allowed_;   // of a vertex: not forbidden
  std::vector<double> price_;         // of a vertex
  std::vector<double> priced_;        // length of an edge with its prices
  std::vector<EdgeIndex> by_price_;
  std::vector<EdgeIndex> tree_;   // the last 1-tree
  std::vector<int> degree_;       // in it
  std::vector<int> last_degree_;  // in the one before
  double longest_ = 0;
  double best_length_ = kNever;
  std::vector<EdgeIndex> best_;
  double root_bound_ = 0;
  std::uint64_t n_trees_ = 0;
};

constexpr Vertex kRoot = 0;

TourSearch::TourSearch(std::size_t n_vertices, std::span<const TourEdge> edges,
                       const TourOptions& options)
    : n_(n_vertices),
      edges_(edges),
      options_(options),
      at_(n_vertices),
      state_(edges.size(), State::Free),
      n_required_(n_vertices),
      n_allowed_(n_vertices),
      price_(n_vertices),
      priced_(edges.size()),
      by_price_(edges.size()),
      degree_(n_vertices),
      last_degree_(n_vertices, 2) {
  for (EdgeIndex e = 0; e < edges.size(); ++e) {
    for (const Vertex v : edges[e].ends) {
      at_[v].push_back(e);
      ++n_allowed_[v];
    }
    longest_ = std::max(longest_, edges[e].length);
  }
  std::iota(by_price_.begin(), by_price_.end(), 0U);
}

/// False if some vertex cannot have two edges any more.
bool TourSearch::decide(EdgeIndex e, State state) {
  if (state_[e] != State::Free) return state_[e] == state;
  state_[e] = state;
  trail_.push_back(e);
  for (const Vertex v : edges_[e].ends) {
    if (state == State::Required)
      ++n_required_[v];
    else
      --n_allowed_[v];
  }
  return propagate(edges_[e].ends[0]) && propagate(edges_[e].ends[1]);
}

bool TourSearch::propagate(Vertex v) {
  if (n_required_[v] > 2 || n_allowed_[v] < 2) return false;
  if (n_required_[v] < 2 && n_allowed_[v] > 2) return true;
  const State rest = n_required_[v] == 2 ? State::Forbidden : State::Required;
  return std::ranges::all_of(at_[v], [&](EdgeIndex e) {
    return state_[e] != State::Free || decide(e, rest);
  });
}

void TourSearch::undo(std::size_t mark) {
  while (trail_.size() > mark) {
    const EdgeIndex e = trail_.back();
    trail_.pop_back();
    for (const Vertex v : edges_[e].ends) {
      if (state_[e] == State::Required)
        --n_required_[v];
      else
        ++n_allowed_[v];
    }
    state_[e] = State::Free;
  }
}

/// The required edges at the root and the cheapest others.
bool TourSearch::add_root_edges(double& sum) {
  std::size_t n_chosen = 0;
  for (const State wanted : {State::Required, State::Free}) {
    for (const EdgeIndex e : by_price_) {
      const auto& ends = edges_[e].ends;
      if (state_[e] != wanted || (ends[0] != kRoot && ends[1] != kRoot))
        continue;
      if (n_chosen == 2) return true;
      ++n_chosen;
      tree_.push_back(e);
      sum += priced_[e];
    }
  }
  return n_chosen == 2;
}

/// The least 1-tree at the present prices.
/// @return the bound that it gives; infinite if there is none
double TourSearch::one_tree() {
  ++n_trees_;
  for (EdgeIndex e = 0; e < edges_.size(); ++e)
    priced_[e] = edges_[e].length + price_[edges_[e].ends[0]] +
                 price_[edges_[e].ends[1]];
  std::ranges::sort(by_price_, [&](EdgeIndex e, EdgeIndex f) {
    return priced_[e] != priced_[f] ? priced_[e] < priced_[f] : e < f;
  });
  tree_.clear();
  DisjointSets joined(n_);
  double sum = 0;
  for (const State wanted : {State::Required, State::Free}) {
    for (const EdgeIndex e : by_price_) {
      const auto& [v, w] = edges_[e].ends;
      if (state_[e] != wanted || v == kRoot || w == kRoot) continue;
      if (joined.root(v) == joined.root(w)) {
        if (wanted == State::Required) return kNever;  // a smaller circle
        continue;
      }
      joined.unite(v, w);
      tree_.push_back(e);
      sum += priced_[e];
    }
  }
  if (tree_.size() + 2 != n_ || !add_root_edges(sum)) return kNever;
  std::ranges::fill(degree_, 0);
  for (const EdgeIndex e : tree_)
    for (const Vertex v : edges_[e].ends) ++degree_[v];
  return sum - 2 * std::accumulate(price_.begin(), price_.end(), 0.0);
}

bool TourSearch::is_tour() const {
  return std::ranges::all_of(degree_, [](int d) { return d == 2; });
}

void TourSearch::keep(double length) {
  if (length >= best_length_) return;
  best_length_ = length;
  best_ = tree_;
}

// Step along the subgradient, damped by the one before [Held74, Sec. 5].
void TourSearch::change_prices(double bound, double step) {
  double norm = 0;
  for (const int d : degree_) norm += (d - 2) * (d - 2);
  const double target =
      best_length_ < kNever ? best_length_ : bound + 0.02 * std::abs(bound);
  const double t = step * std::max(target - bound, slack()) / norm;
  for (Vertex v = 0; v < n_; ++v)
    price_[v] += t * (0.7 * (degree_[v] - 2) + 0.3 * (last_degree_[v] - 2));
  last_degree_ = degree_;
}

/// The best bound of so many 1-trees; leaves the prices and the 1-tree of it.
/// Infinite if nothing here is shorter than the best tour.
double TourSearch::raise_bound(unsigned rounds) {
  double best = -kNever;
  std::vector<double> best_price = price_;
  double step = 1;
  unsigned since = 0;
  for (unsigned i = 0; i < rounds && !out_of_time(); ++i) {
    const double bound = one_tree();
    if (bound >= best_length_ - slack()) return kNever;
    if (bound > best) {
      best = bound;
      best_price = price_;
      since = 0;
    } else if (++since == 8) {
      step *= 0.7;
      since = 0;
    }
    if (is_tour()) {
      double length = 0;
      for (const EdgeIndex e : tree_) length += edges_[e].length;
      keep(length);
      return kNever;  // the bound is that tour's length
    }
    change_prices(bound, step);
  }
  price_ = best_price;
  if (one_tree() == kNever) return kNever;
  return best;
}

/// A free edge of the 1-tree at its most crowded vertex, the longest of these.
EdgeIndex TourSearch::branching_edge() const {
  const auto crowd = [&](EdgeIndex e) {
    return std::max(degree_[edges_[e].ends[0]], degree_[edges_[e].ends[1]]);
  };
  EdgeIndex chosen = 0;
  int most = 0;
  for (const EdgeIndex e : tree_) {
    if (state_[e] != State::Free) continue;
    const int c = crowd(e);
    if (c < most || (c == most && priced_[e] <= priced_[chosen])) continue;
    most = c;
    chosen = e;
  }
  return chosen;
}

void TourSearch::search(unsigned depth) {
  const double bound = raise_bound(depth == 0 ? 400 : 60);
  if (depth == 0) root_bound_ = std::min(bound, best_length_);
  if (bound == kNever || out_of_time()) return;
  const EdgeIndex e = branching_edge();
  const std::vector<double> price = price_;
  for (const State state : {State::Forbidden, State::Required}) {
    const std::size_t mark = trail_.size();
    if (decide(e, state)) search(depth + 1);
    undo(mark);
    price_ = price;
    if (out_of_time()) return;
  }
}

TourResult TourSearch::run(std::span<const EdgeIndex> start) {
  if (!start.empty()) {
    best_.assign(start.begin(), start.end());
    best_length_ = 0;
    for (const EdgeIndex e : start) best_length_ += edges_[e].length;
  }
  bool possible = true;
  for (EdgeIndex e = 0; e < edges_.size(); ++e)
    if (edges_[e].required) possible = possible && decide(e, State::Required);
  for (Vertex v = 0; v < n_; ++v) possible = possible && propagate(v);
  if (possible) search(0);

  TourResult result;
  const bool is_done = !out_of_time();
  result.edges = best_;
  std::ranges::sort(result.edges);
  const bool found = !best_.empty();
  result.length = found ? best_length_ : 0;
  result.bound = is_done && found ? best_length_ : root_bound_;
  if (is_done)
    result.status = found ? TourStatus::Optimal : TourStatus::Infeasible;
  else
    result.status = found ? TourStatus::Feasible : TourStatus::Limit;
  return result;
}

}  // namespace

TourResult shortest_tour(std::size_t n_vertices,
                         std::span<const TourEdge> edges,
                         std::span<const std::uint32_t> start,
                         const TourOptions& options) {
  return TourSearch(n_vertices, edges, options).run(start);
}

}  // namespace umbrella
