// Conflict-driven clause learning [Marques99; Moskewicz01; Een03] over the
// propagators of propagate.h. A decision takes the worst open variable, or one
// of the last conflicts, and sets it false; each conflict teaches a clause;
// short runs between restarts return to the order of priority, so that the
// search keeps to the caller's notion of worst. Assumptions are the decisions
// of the first levels. Levels are kept from call to call, and when a search
// starts anew, where the same would be decided again.

#include "ilp/solver.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "ilp/analysis.h"
#include "ilp/antecedents.h"
#include "ilp/constraint_counts.h"
#include "ilp/decision_order.h"
#include "ilp/late_literals.h"
#include "ilp/proof.h"
#include "ilp/propagate.h"

namespace ilp {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxDerivationItems = std::size_t{1} << 25U;
constexpr std::uint64_t kRestartUnit = 32;
constexpr std::uint64_t kFirstReduction = 2000;
constexpr std::uint64_t kReductionStep = 500;
constexpr std::uint64_t kStepsPerClockLook = 256;
// In levels; as in [Nadel18, Sec. 5]. On the programs of docs/corpus.md 0, 100
// and 500 differ by less than other noise.
constexpr std::uint32_t kFarJump = 100;
constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

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
        counts_(problem),
        model_(problem.n_variables(), false),
        preferred_(problem.n_variables(), false) {}

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
    if (log_ != nullptr) log_->join(literals);
    const ConstraintId id = counts_.add(ConstraintKind::Clause);
    std::vector<Literal> clause(literals.begin(), literals.end());
    if (normalize(clause)) join(clause, Antecedent(id), 0);
    return id;
  }

  ConstraintId add_linear(std::span<const Term> terms, std::int64_t bound) {
    const ConstraintId id = join_linear(terms, bound);
    if (log_ != nullptr) log_->join(terms, bound);
    return id;
  }

  ConstraintId require_better(std::span<const Term> sum) {
    std::int64_t bound = -1;
    for (const auto& [var, a] : sum)
      if (model_[index(var)]) bound += a;
    if (objective_ && std::ranges::equal(sum, objective_terms_)) {
      backtrack(0);
      propagator_.tighten(objective_->index, bound);
    } else {
      objective_ = join_linear(sum, bound);
      objective_terms_.assign(sum.begin(), sum.end());
    }
    if (log_ != nullptr) log_->improve(model_);
    return *objective_;
  }

  void prefer(std::span<const Literal> values) {
    check_known(values);
    for (const Literal l : values) preferred_[index(l.var())] = l.value();
  }

  void set_log(ProofLog* log) { log_ = log; }
  void keep_cycles() { analyzer_.set_cycles(&cycles_); }

  std::vector<Cycle> cycles() const {
    std::set<Cycle> all = cycles_;
    add_cycles_of_level_0(propagator_, refutation_, all);
    return {all.begin(), all.end()};
  }

  void assume(Literal l) {
    check_known({&l, 1});
    assumptions_.push_back(l);
  }

  void retract() {
    assert(!assumptions_.empty());
    assumptions_.pop_back();
    n_alike_ = std::min(n_alike_, assumptions_.size());
  }

  Status solve(std::span<const Literal> assumptions, const Limits& limits) {
    check_known(assumptions);
    assumptions_.assign(assumptions.begin(), assumptions.end());
    n_alike_ = 0;
    return solve_assumed(limits);
  }

  Status solve_assumed(const Limits& limits) {
    start(limits);
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
    if (!derivations_.is_complete()) core.constraints = counts_.ids();
    return core;
  }

 private:
  const Assignment& values() const { return propagator_.assignment(); }

  enum class Step { Decided, Complete, Refuted };
  struct Level {
    Literal decision;
    bool is_in_order;       // it came first of all that were open
    std::size_t n_assumed;  // first assumptions that held before it
  };

  void check_known(std::span<const Literal> literals) const {
    for (const Literal l : literals)
      if (index(l.var()) >= model_.size())
        throw std::invalid_argument("ilp: no variable " +
                                    std::to_string(index(l.var())));
  }

  ConstraintId join_linear(std::span<const Term> terms, std::int64_t bound) {
    check_terms(terms, bound);
    backtrack(0);
    propagator_.add_linear(terms, bound);
    return counts_.add(ConstraintKind::Linear);
  }

  void check_terms(std::span<const Term> terms, std::int64_t bound) const {
    if (!is_in_range(terms, bound))
      throw std::invalid_argument("ilp: linear constraint out of range");
    std::vector<Literal> vars;
    for (const Term& t : terms) vars.emplace_back(t.var, true);
    check_known(vars);
    std::ranges::sort(vars);
    const auto twice = std::ranges::adjacent_find(vars);
    if (twice != vars.end())
      throw std::invalid_argument("ilp: variable " +
                                  std::to_string(index(twice->var())) +
                                  " twice in one constraint");
  }

  // The level at which a literal fails; if it does not, above all others.
  std::uint32_t failed_at(Literal l) const {
    return values().holds(!l) ? values().level(l.var()) : kNever;
  }

  // Puts two literals first that fail later than all others, or not at all.
  void find_watches(std::span<Literal> clause) const {
    for (std::size_t i = 0; i < std::min<std::size_t>(clause.size(), 2); ++i)
      std::swap(clause[i], *std::ranges::max_element(
                               clause.subspan(i), {},
                               [this](Literal l) { return failed_at(l); }));
  }

  // Takes back levels until the clause does not fail, or fails for good. If a
  // literal follows from it, that holds from now on. Where it is known far
  // below, not all levels between are taken back for it [Nadel18]: it comes
  // late, and backtrack() saves it.
  void join(std::span<Literal> clause, Antecedent origin, std::uint32_t glue) {
    find_watches(clause);
    const auto last = [&] { return clause.empty() ? 0 : failed_at(clause[0]); };
    const auto known_at = [&] {
      return clause.size() < 2 ? 0 : failed_at(clause[1]);
    };
    const auto return_to = [&](std::uint32_t level) {
      backtrack(level);
      find_watches(clause);
    };
    if (last() != kNever && last() > known_at() + kFarJump)
      return_to(last() - 1);
    while (last() != kNever && last() > 0)
      return_to(std::min(last() - 1, known_at()));
    const bool fails = last() == 0;
    if (fails || (values().holds(clause[0]) &&
                  known_at() < values().level(clause[0].var())))
      return_to(known_at());
    const bool is_late = !fails && values().is_open(clause[0].var()) &&
                         known_at() < values().n_levels();
    if (is_late) late_.note(clause[0], known_at());
    propagator_.add_clause(clause, origin, glue);
  }

  void start(const Limits& limits) {
    return_to_order();

    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    const auto add = [](std::uint64_t used, std::uint64_t more) {
      return more < kMax - used ? used + more : kMax;
    };
    max_conflicts_ = add(statistics_.conflicts, limits.conflicts);
    max_propagations_ = add(propagator_.n_propagated(), limits.propagations);
    max_seconds_ = limits.seconds;
    stop_ = limits.stop;
    if (!std::isinf(max_seconds_)) start_time_ = Clock::now();
    n_until_clock_ = 0;
    n_restarts_ = 1;
    n_until_restart_ = kRestartUnit;
  }

  // Forgets all activity, and takes back what would not be decided again then:
  // the levels from the first on that is another one [vanderTak11].
  void return_to_order() {
    order_.forget_activity();
    const auto first = std::ranges::partition_point(
        levels_, [this](const Level& l) { return l.n_assumed < n_alike_; });
    std::size_t n_assumed = std::min(
        first == levels_.end() ? n_assumed_ : first->n_assumed, n_alike_);
    auto level = static_cast<std::uint32_t>(first - levels_.begin());
    n_alike_ = assumptions_.size();
    for (; level < values().n_levels(); ++level) {
      n_assumed = skip_assumed(n_assumed, level);
      if (!is_due(levels_[level], n_assumed)) break;
      levels_[level].n_assumed = n_assumed;
    }
    backtrack(level);
    n_assumed_ = n_assumed;
  }

  // The first assumption from the n-th on that does not hold at the level.
  std::size_t skip_assumed(std::size_t n, std::uint32_t level) const {
    while (n < assumptions_.size() && values().holds(assumptions_[n]) &&
           values().level(assumptions_[n].var()) <= level)
      ++n;
    return n;
  }

  // Whether the decision would be taken again after the first assumptions.
  bool is_due(const Level& level, std::size_t n_assumed) const {
    if (n_assumed < assumptions_.size())
      return level.decision == assumptions_[n_assumed];
    return level.is_in_order &&
           level.decision == preference(level.decision.var());
  }

  void backtrack(std::uint32_t level) {
    if (level >= values().n_levels()) return;
    const std::size_t n_kept = values().begin_of_level(level + 1);
    n_in_model_ = std::min(n_in_model_, n_kept);
    for (const Literal l : values().trail().subspan(n_kept))
      order_.reopen(l.var());
    const auto known = late_.take(values(), n_kept, level);
    propagator_.backtrack(level);
    n_assumed_ = levels_[level].n_assumed;
    levels_.resize(level);
    for (const auto& [literal, reason, known_at] : known) {
      propagator_.imply(literal, reason);
      if (known_at < level) late_.note(literal, known_at);
    }
  }

  void open_level(Literal decision, bool is_in_order) {
    propagator_.open_level();
    levels_.push_back({decision, is_in_order, n_assumed_});
  }

  void learn() {
    const Lesson& lesson =
        analyzer_.analyze(propagator_, propagator_.conflict(), derivations_);
    const Antecedent origin = derivations_.learn();
    if (log_ != nullptr) log_->derive(lesson.literals);
    if (branching_ == Branching::Adaptive) {
      for (const VarId v : lesson.touched) order_.bump(v);
      order_.decay();
    }
    std::vector<Literal> clause = lesson.literals;
    join(clause, origin, lesson.glue);
    ++statistics_.conflicts;
    if (n_until_restart_ > 0) --n_until_restart_;
    if (--n_until_reduction_ == 0) reduce();
  }

  void reduce() {
    propagator_.forget_clauses([this](std::span<const Literal> clause) {
      if (log_ != nullptr) log_->forget(clause);
    });
    ++n_reductions_;
    n_until_reduction_ = kFirstReduction + kReductionStep * n_reductions_;
  }

  void restart() {
    ++statistics_.restarts;
    n_until_restart_ = kRestartUnit * luby(++n_restarts_);
    return_to_order();
  }

  Step decide() {
    n_assumed_ = skip_assumed(n_assumed_, values().n_levels());
    if (n_assumed_ < assumptions_.size()) {
      const Literal a = assumptions_[n_assumed_];
      if (values().holds(!a)) {
        failed_assumption_ = a;
        refutation_ = {{}, {!a}};
        if (log_ != nullptr) log_refuted_assumptions();
        return Step::Refuted;
      }
      open_level(a, false);
      propagator_.decide(a);
      return Step::Decided;
    }
    const auto [next, is_in_order] =
        order_.next([this](VarId v) { return values().is_open(v); });
    if (index(next) == values().n_variables()) return Step::Complete;
    const Literal decision = preference(next);
    open_level(decision, is_in_order);
    propagator_.decide(decision);
    ++statistics_.decisions;
    return Step::Decided;
  }

  Literal preference(VarId v) const {
    return Literal(v,
                   branching_ == Branching::Adaptive && preferred_[index(v)]);
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
    for (const Literal l : values().trail().subspan(n_in_model_))
      model_[index(l.var())] = l.value();
    n_in_model_ = model_.size();
    return Status::Feasible;
  }

  Status refuted() {
    refutation_ = propagator_.conflict();
    failed_assumption_.reset();
    if (log_ != nullptr) log_->derive({});
    return Status::Infeasible;
  }

  void log_refuted_assumptions() {
    std::vector<Literal> clause;
    for (const Literal a : core().assumptions) clause.push_back(!a);
    log_->derive(clause);
  }

  Status stopped() {
    backtrack(0);
    return Status::Limit;
  }

  Propagator propagator_;
  DecisionOrder order_;
  Analyzer analyzer_;
  Derivations derivations_;
  ConstraintCounts counts_;

  Branching branching_ = Branching::Adaptive;
  std::vector<Level> levels_;
  LateLiterals late_;
  std::vector<Literal> assumptions_;
  std::size_t n_assumed_ = 0;   // the first ones hold
  std::size_t n_alike_ = 0;     // the first ones are those of the last call
  std::size_t n_in_model_ = 0;  // the first of the trail are as in the model
  Model model_;
  Model preferred_;
  std::optional<ConstraintId> objective_;  // of require_better()
  std::vector<Term> objective_terms_;
  ProofLog* log_ = nullptr;
  std::set<Cycle> cycles_;  // of rings, that were needed; if kept
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

ConstraintId Solver::add_linear(std::span<const Term> terms,
                                std::int64_t bound) {
  return search_->add_linear(terms, bound);
}

ConstraintId Solver::require_better(std::span<const Term> sum) {
  return search_->require_better(sum);
}

void Solver::prefer(std::span<const Literal> values) {
  search_->prefer(values);
}

void Solver::set_log(ProofLog* log) { search_->set_log(log); }
void Solver::keep_cycles() { search_->keep_cycles(); }
std::vector<Cycle> Solver::cycles() const { return search_->cycles(); }

Status Solver::solve(std::span<const Literal> assumptions,
                     const Limits& limits) {
  return search_->solve(assumptions, limits);
}

void Solver::assume(Literal l) { search_->assume(l); }
void Solver::retract() { search_->retract(); }

Status Solver::solve_assumed(const Limits& limits) {
  return search_->solve_assumed(limits);
}

const Model& Solver::model() const { return search_->model(); }
Core Solver::core() const { return search_->core(); }
Statistics Solver::statistics() const { return search_->statistics(); }

}  // namespace ilp
