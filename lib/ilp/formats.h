/// @file
/// 0/1 programs as files: OPB [Roussel09] in and out, LP and MPS out.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "ilp/linear_form.h"
#include "ilp/problem.h"

namespace ilp {

/// A program with a sum to be minimised: the objective plus `offset`.
struct Program {
  Problem problem;
  std::vector<Term> objective;  ///< each variable once
  std::int64_t offset = 0;
  bool has_objective = false;
};

/// Variable x1 of the file is variable 0. An equation becomes two linear
/// constraints. docs/ilp.md says what is read.
///
/// @param name  of the file, for messages
/// @throws std::invalid_argument  `name:line:column: what`; a number or a sum
///   out of range (kMaxLinearSum) is one of these
Program read_opb(std::string_view text, const std::string& name);

/// Variable 0 is x1; rows are c1, c2, ... in the order of the form. Lines end
/// early enough for every reader.
void write_opb(std::ostream& out, const LinearForm& form);
void write_lp(std::ostream& out, const LinearForm& form);
void write_mps(std::ostream& out, const LinearForm& form);

}  // namespace ilp
