/// @file
/// A log of what a search derives, line by line, for a checker.
#pragma once

#include <iosfwd>
#include <span>

#include "ilp/problem.h"

namespace ilp {

/// Each line is a letter, numbers, and a 0 at its end; 3 stands for "variable 2
/// is true", -3 for "variable 2 is false". docs/ilp.md, "Proofs".
class ProofLog {
 public:
  /// @param out  must outlive the log
  explicit ProofLog(std::ostream& out) : out_(out) {}

  /// `l`: follows by propagation from the program and the lines before.
  void derive(std::span<const Literal> clause) { line('l', clause); }
  /// `d`: a derived clause that no later line needs.
  void forget(std::span<const Literal> clause) { line('d', clause); }
  /// `a`: joins the program from here on.
  void join(std::span<const Literal> clause) { line('a', clause); }
  /// `b`: likewise, sum <= bound.
  void join(std::span<const Term> terms, std::int64_t bound);
  /// `m`: a model; from here on only those of a smaller objective count.
  void improve(const Model& model);

 private:
  void line(char kind, std::span<const Literal> literals);

  std::ostream& out_;
};

}  // namespace ilp
