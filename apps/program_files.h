/// @file
/// The programs of the closing as files, for other solvers.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "apps/report.h"

namespace ilp {
struct LinearForm;
enum class Status;
}  // namespace ilp

namespace command {

/// Program k of the closing, from 1, becomes the file PREFIX-k.opb, and so on;
/// an empty prefix asks for none.
struct ProgramPrefixes {
  std::string opb, lp, mps;

  bool are_empty() const { return opb.empty() && lp.empty() && mps.empty(); }
};

/// @throws io::WriteError  a first file cannot be written
void require_writable(const ProgramPrefixes& prefixes);

/// @throws std::invalid_argument  a program may be written to one of the files
void require_apart(const ProgramPrefixes& prefixes,
                   std::span<const std::string> files);

class ProgramFiles {
 public:
  explicit ProgramFiles(ProgramPrefixes prefixes);

  /// @throws io::WriteError
  void add(const ilp::LinearForm& form, ilp::Status status);

  /// For each program "feasible", "infeasible" or "limit".
  const report::Json& answers() const { return answers_; }

 private:
  ProgramPrefixes prefixes_;
  report::Json answers_ = report::Json::array();
};

}  // namespace command
