/// @file
/// What the log of a search proves.
#pragma once

#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "ilp/proof.h"
#include "ilp/proof_check.h"

namespace support {

/// Log of one solver, and the checker that follows it.
class CheckedLog {
 public:
  explicit CheckedLog(const ilp::Problem& problem,
                      std::span<const ilp::Term> sum = {})
      : checker_(problem, sum) {}

  ilp::ProofLog* log() { return &log_; }

  /// Checks what was logged since the last call.
  std::string first_flaw() {
    std::istringstream lines(text_.str());
    text_.str({});
    return checker_.first_flaw(lines);
  }

  /// Call first_flaw() before these.
  const ilp::ProofChecker& checker() const { return checker_; }
  bool excludes(std::span<const ilp::Literal> assumptions) {
    std::vector<ilp::Literal> clause;
    for (const ilp::Literal a : assumptions) clause.push_back(!a);
    return checker_.implies(clause);
  }
  /// Whether no model is less than this one in the given order.
  bool shows_least(const ilp::Model& model, std::span<const ilp::VarId> order) {
    std::vector<ilp::Literal> prefix;
    for (const ilp::VarId v : order) {
      const bool value = model[index(v)];
      prefix.emplace_back(v, false);
      if (value && !excludes(prefix)) return false;
      prefix.back() = ilp::Literal(v, value);
    }
    return true;
  }

 private:
  std::ostringstream text_;
  ilp::ProofLog log_{text_};
  ilp::ProofChecker checker_;
};

}  // namespace support
