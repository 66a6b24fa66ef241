#include "ilp/baseline.h"

#include <chrono>
#include <cstdint>
#include <vector>

#include "ilp/decision_order.h"
#include "ilp/propagate.h"

namespace ilp {
namespace {

class DepthFirst {
 public:
  DepthFirst(const Problem& problem, std::span<const VarId> order,
             std::span<const Term> sum, const Limits& limits)
      : propagator_(problem),
        order_(problem.n_variables()),
        sum_(sum),
        limits_(limits) {
    order_.set_priority(order);
  }

  Minimum run() {
    for (;;) {
      if (is_out_of_limits()) return stopped();
      if (!propagator_.propagate() || !may_be_better()) {
        ++n_conflicts_;
        if (!go_back()) return exhausted();
        continue;
      }
      const VarId next =
          order_.next([this](VarId v) { return values().is_open(v); }).var;
      if (index(next) < values().n_variables()) {
        decide(Literal(next, false));
      } else {
        keep_model();
        if (sum_.empty()) return {Status::Feasible, best_.model, 0};
      }
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Assignment& values() const { return propagator_.assignment(); }

  void decide(Literal l) {
    propagator_.open_level();
    decisions_.push_back(l);
    propagator_.decide(l);
  }

  // Back to the last decision that was false, and on with it true.
  bool go_back() {
    while (!decisions_.empty() && decisions_.back().value())
      decisions_.pop_back();
    if (decisions_.empty()) return false;
    const Literal last = decisions_.back();
    decisions_.pop_back();
    const auto level = static_cast<std::uint32_t>(decisions_.size());
    const std::size_t n_kept = values().begin_of_level(level + 1);
    for (const Literal l : values().trail().subspan(n_kept))
      order_.reopen(l.var());
    propagator_.backtrack(level);
    decide(!last);
    return true;
  }

  bool may_be_better() const {
    return best_.model.empty() || least_sum() < best_.sum;
  }

  std::int64_t least_sum() const {
    std::int64_t total = 0;
    for (const auto& [var, a] : sum_)
      if (values().is_open(var) ? a < 0 : values().is_true(var)) total += a;
    return total;
  }

  void keep_model() {
    best_.model.assign(values().n_variables(), false);
    for (const Literal l : values().trail())
      best_.model[index(l.var())] = l.value();
    best_.sum = least_sum();
  }

  bool is_out_of_limits() const {
    const std::chrono::duration<double> seconds = Clock::now() - start_;
    return n_conflicts_ > limits_.conflicts ||
           propagator_.n_propagated() > limits_.propagations ||
           seconds.count() > limits_.seconds;
  }

  Minimum stopped() {
    best_.status = best_.model.empty() ? Status::Limit : Status::Feasible;
    return best_;
  }

  Minimum exhausted() {
    best_.status = best_.model.empty() ? Status::Infeasible : Status::Optimal;
    return best_;
  }

  Propagator propagator_;
  DecisionOrder order_;
  std::span<const Term> sum_;
  Limits limits_;
  std::vector<Literal> decisions_;
  std::uint64_t n_conflicts_ = 0;
  Minimum best_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

Minimum depth_first(const Problem& problem, std::span<const VarId> order,
                    std::span<const Term> sum, const Limits& limits) {
  return DepthFirst(problem, order, sum, limits).run();
}

}  // namespace ilp
