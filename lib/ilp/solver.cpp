// Conflict-driven clause learning [Marques99; Moskewicz01; Een03] over the
// propagators of propagate.h. A decision takes the worst open variable, or one
// of the last conflicts, and sets it false; each conflict teaches a clause;
// short runs between restarts return to the order of priority, so that the
// search keeps to the caller's notion of worst. Assumptions are the decisions
// of the first levels, and levels are kept from call to call where the
// assumptions agree.

#include "ilp/solver.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "ilp/analysis.h"
#include "ilp/antecedents.h"
#include "ilp/decision_order.h"
#include "ilp/propagate.h"

namespace ilp {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxDerivationItems = std::size_t{1} << 25U;
constexpr std::uint64_t kRestartUnit = 32;
constexpr std::uint64_t kFirstReduction = 2000;
constexpr std::uint64_t kReductionStep = 500;
constexpr std::uint64_t kStepsPerClockLook = 256;

// The i-th term, i >= 1, of 1 1 2 1 1 2 4 1 1 2 1 1 2 4 8 ... [Luby93].
std::uint64_t luby(std::uint64_t i) {
  while (!std::has_single_bit(i + 1)) i -= std::bit_floor(i) - 1;
  return (i + 1) / 2;
}

}  // namespace

class Solver::Search {
 public:
  explicit Search(const Problem& problem)
      : propagator_(problem),
        order_(problem.n_variables()),
        analyzer_(problem.n_variables()),
        derivations_(kMaxDerivationItems),
        n_pairs_(static_cast<std::uint32_t>(problem.n_pairs())),
        n_rings_(static_cast<std::uint32_t>(problem.n_rings())),
        n_sides_(static_cast<std::uint32_t>(problem.n_sides())),
        n_clauses_(static_cast<std::uint32_t>(problem.n_clauses())),
        model_(problem.n_variables(), false) {}

  void set_priority(std::span<const VarId> order) {
    backtrack(0);
    order_.set_priority(order);
  }

  void set_branching(Branching branching) {
    order_.forget_activity();
    branching_ = branching;
  }

  ConstraintId add_clause(std::span<const Literal> literals) {
    check_known(literals);
    backtrack(0);
    const ConstraintId id{ConstraintKind::Clause, n_clauses_++};
    std::vector<Literal> clause(literals.begin(), literals.end());
    if (normalize(clause)) propagator_.add_clause(clause, Antecedent(id), 0);
    return id;
  }

  Status solve(std::span<const Literal> assumptions, const Limits& limits) {
    check_known(assumptions);
    start(assumptions, limits);
    for (;;) {
      if (!propagator_.propagate()) {
        if (values().n_levels() == 0) return refuted();
        if (statistics_.conflicts == max_conflicts_) return stopped();
        learn();
      } else if (is_out_of_time()) {
        return stopped();
      } else {
        if (n_until_restart_ == 0) restart();
        const Step step = decide();
        if (step == Step::Refuted) return Status::Infeasible;
        if (step == Step::Complete) return found();
      }
    }
  }

  const Model& model() const { return model_; }

  Statistics statistics() const {
    Statistics result = statistics_;
    result.propagations = propagator_.n_propagated();
    return result;
  }

  Core core() const {
    Core core = find_core(propagator_, derivations_, refutation_);
    if (failed_assumption_) core.assumptions.push_back(*failed_assumption_);
    std::ranges::sort(core.assumptions);
    if (!derivations_.is_complete()) core.constraints = all_constraints();
    return core;
  }

 private:
  const Assignment& values() const { return propagator_.assignment(); }

  enum class Step { Decided, Complete, Refuted };

  void check_known(std::span<const Literal> literals) const {
    for (const Literal l : literals)
      if (index(l.var()) >= model_.size())
        throw std::invalid_argument("ilp: no variable " +
                                    std::to_string(index(l.var())));
  }

  // Keeps the levels that the new assumptions share with the old decisions.
  void start(std::span<const Literal> assumptions, const Limits& limits) {
    std::uint32_t n_shared = 0;
    while (n_shared < values().n_levels() && n_shared < assumptions.size() &&
           decisions_[n_shared] == assumptions[n_shared])
      ++n_shared;
    backtrack(n_shared);
    assumptions_.assign(assumptions.begin(), assumptions.end());

    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    const auto add = [](std::uint64_t used, std::uint64_t more) {
      return more < kMax - used ? used + more : kMax;
    };
    max_conflicts_ = add(statistics_.conflicts, limits.conflicts);
    max_propagations_ = add(propagator_.n_propagated(), limits.propagations);
    max_seconds_ = limits.seconds;
    stop_ = limits.stop;
    start_time_ = Clock::now();
    n_until_clock_ = 0;
    n_restarts_ = 1;
    n_until_restart_ = kRestartUnit;
    order_.forget_activity();
  }

  void backtrack(std::uint32_t level) {
    if (level >= values().n_levels()) return;
    const std::size_t n_kept = values().begin_of_level(level + 1);
    for (const Literal l : values().trail().subspan(n_kept))
      order_.reopen(l.var());
    propagator_.backtrack(level);
    decisions_.resize(level);
  }

  void open_level(Literal decision) {
    propagator_.open_level();
    decisions_.push_back(decision);
  }

  void learn() {
    const Lesson& lesson =
        analyzer_.analyze(propagator_, propagator_.conflict(), derivations_);
    const Antecedent origin = derivations_.learn();
    if (branching_ == Branching::Adaptive) {
      for (const VarId v : lesson.touched) order_.bump(v);
      order_.decay();
    }
    backtrack(lesson.level);
    std::vector<Literal> clause = lesson.literals;
    propagator_.add_clause(clause, origin, lesson.glue);
    ++statistics_.conflicts;
    if (n_until_restart_ > 0) --n_until_restart_;
    if (--n_until_reduction_ == 0) reduce();
  }

  void reduce() {
    propagator_.forget_clauses();
    ++n_reductions_;
    n_until_reduction_ = kFirstReduction + kReductionStep * n_reductions_;
  }

  void restart() {
    ++statistics_.restarts;
    n_until_restart_ = kRestartUnit * luby(++n_restarts_);
    order_.forget_activity();
    backtrack(static_cast<std::uint32_t>(assumptions_.size()));
  }

  Step decide() {
    while (values().n_levels() < assumptions_.size()) {
      const Literal a = assumptions_[values().n_levels()];
      if (values().holds(!a)) {
        failed_assumption_ = a;
        refutation_ = {{}, {!a}};
        return Step::Refuted;
      }
      open_level(a);
      if (!values().holds(a)) {
        propagator_.decide(a);
        return Step::Decided;
      }
    }
    const VarId next =
        order_.next([this](VarId v) { return values().is_open(v); });
    if (index(next) == model_.size()) return Step::Complete;
    open_level(Literal(next, false));
    propagator_.decide(Literal(next, false));
    ++statistics_.decisions;
    return Step::Decided;
  }

  bool is_out_of_time() {
    if (propagator_.n_propagated() >= max_propagations_) return true;
    if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) return true;
    if (std::isinf(max_seconds_)) return false;
    if (n_until_clock_-- > 0) return false;
    n_until_clock_ = kStepsPerClockLook;
    return std::chrono::duration<double>(Clock::now() - start_time_).count() >=
           max_seconds_;
  }

  Status found() {
    for (const Literal l : values().trail()) model_[index(l.var())] = l.value();
    return Status::Feasible;
  }

  Status refuted() {
    refutation_ = propagator_.conflict();
    failed_assumption_.reset();
    return Status::Infeasible;
  }

  Status stopped() {
    backtrack(0);
    return Status::Limit;
  }

  std::vector<ConstraintId> all_constraints() const {
    std::vector<ConstraintId> all;
    for (std::uint32_t i = 0; i < n_pairs_; ++i)
      all.push_back({ConstraintKind::Pair, i});
    for (std::uint32_t i = 0; i < n_rings_; ++i)
      all.push_back({ConstraintKind::Ring, i});
    for (std::uint32_t i = 0; i < n_sides_; ++i)
      all.push_back({ConstraintKind::Sides, i});
    for (std::uint32_t i = 0; i < n_clauses_; ++i)
      all.push_back({ConstraintKind::Clause, i});
    return all;
  }

  Propagator propagator_;
  DecisionOrder order_;
  Analyzer analyzer_;
  Derivations derivations_;
  std::uint32_t n_pairs_;
  std::uint32_t n_rings_;
  std::uint32_t n_sides_;
  std::uint32_t n_clauses_;

  Branching branching_ = Branching::Adaptive;
  std::vector<Literal> decisions_;  // of each level; an assumption may hold
  std::vector<Literal> assumptions_;
  Model model_;
  Conflict refutation_;
  std::optional<Literal> failed_assumption_;
  Statistics statistics_;

  std::uint64_t max_conflicts_ = 0;
  std::uint64_t max_propagations_ = 0;
  double max_seconds_ = 0;
  const std::atomic<bool>* stop_ = nullptr;
  Clock::time_point start_time_;
  std::uint64_t n_until_clock_ = 0;
  std::uint64_t n_restarts_ = 0;  // of this call, plus 1
  std::uint64_t n_until_restart_ = 0;
  std::uint64_t n_reductions_ = 0;
  std::uint64_t n_until_reduction_ = kFirstReduction;
};

Solver::Solver(const Problem& problem)
    : search_(std::make_unique<Search>(problem)) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::set_priority(std::span<const VarId> order) {
  search_->set_priority(order);
}

void Solver::set_branching(Branching branching) {
  search_->set_branching(branching);
}

ConstraintId Solver::add_clause(std::span<const Literal> literals) {
  return search_->add_clause(literals);
}

Status Solver::solve(std::span<const Literal> assumptions,
                     const Limits& limits) {
  return search_->solve(assumptions, limits);
}

const Model& Solver::model() const { return search_->model(); }
Core Solver::core() const { return search_->core(); }
Statistics Solver::statistics() const { return search_->statistics(); }

}  // namespace ilp
