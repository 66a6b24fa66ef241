// umbrella solve: the 0/1 solver alone, in the manner of the pseudo-Boolean
// competitions.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/option_checks.h"
#include "apps/paths.h"
#include "ilp/formats.h"
#include "ilp/linear_form.h"
#include "ilp/minimize.h"
#include "ilp/proof.h"
#include "ilp/proof_check.h"
#include "ilp/solver.h"
#include "io/error.h"
#include "io/file.h"

namespace command {
namespace {

using ilp::Status;

struct Options {
  std::string in;
  std::string proof, check_proof;
  std::string opb, lp, mps;
  ilp::Limits limits;
};

/// The log of a search as a file, which may grow large.
class ProofFile {
 public:
  explicit ProofFile(const std::string& path) : path_(path) {
    if (path.empty()) return;
    io::require_writable(path);
    out_.open(path, std::ios::binary);
  }
  ilp::ProofLog* log() { return path_.empty() ? nullptr : &log_; }
  void close() {
    if (path_.empty()) return;
    out_.close();
    if (!out_) throw io::WriteError(path_ + ": cannot write");
  }

 private:
  std::string path_;
  std::ofstream out_;
  ilp::ProofLog log_{out_};
};

void export_program(const Options& options, const ilp::Program& program) {
  const bool has_exports =
      !(options.opb.empty() && options.lp.empty() && options.mps.empty());
  if (has_exports && program.offset != 0)
    std::cout << "c the files written leave out the constant " << program.offset
              << " of the sum\n";
  ilp::LinearForm form = linear_form(program.problem);
  form.objective = program.objective;
  const auto write = [&form](const std::string& path, auto writer) {
    if (path.empty()) return;
    std::ostringstream text;
    writer(text, form);
    io::write_file(path, text.str());
  };
  write(options.opb, ilp::write_opb);
  write(options.lp, ilp::write_lp);
  write(options.mps, ilp::write_mps);
}

void print_model(const ilp::Model& model) {
  constexpr std::size_t kPerLine = 12;
  for (std::size_t v = 0; v < model.size(); ++v) {
    if (v % kPerLine == 0) std::cout << (v == 0 ? "v" : "\nv");
    std::cout << (model[v] ? " x" : " -x") << v + 1;
  }
  std::cout << (model.empty() ? "v\n" : "\n");
}

// The costliest variables are decided first.
std::vector<ilp::VarId> order_of(const std::vector<ilp::Term>& objective) {
  std::vector<ilp::Term> terms = objective;
  std::ranges::stable_sort(terms, [](const ilp::Term& s, const ilp::Term& t) {
    return std::abs(s.coefficient) > std::abs(t.coefficient);
  });
  std::vector<ilp::VarId> order;
  order.reserve(terms.size());
  for (const ilp::Term& t : terms) order.push_back(t.var);
  return order;
}

// Without an objective the first model will do. Ctrl-C is a limit.
ilp::Minimum search(const Options& options, const ilp::Program& program,
                    ilp::Solver& solver) {
  const terminal::Interrupt interrupt;
  ilp::Limits limits = options.limits;
  limits.stop = &terminal::Interrupt::flag();
  if (!program.has_objective) {
    const Status status = solver.solve({}, limits);
    if (status != Status::Feasible) return {status, {}, 0};
    return {status, solver.model(), 0};
  }
  solver.set_priority(order_of(program.objective));
  return minimize_sum(solver, program.objective, limits,
                      [&program](const ilp::Model&, std::int64_t sum) {
                        std::cout << "o " << sum + program.offset << std::endl;
                      });
}

ExitCode solve(const Options& options, const ilp::Program& program) {
  ProofFile proof(options.proof);
  ilp::Solver solver(program.problem);
  solver.set_log(proof.log());
  const ilp::Minimum found = search(options, program, solver);
  proof.close();

  const ilp::Statistics statistics = solver.statistics();
  std::cout << "c " << statistics.conflicts << " conflicts, "
            << statistics.decisions << " decisions, " << statistics.propagations
            << " propagations\n";
  switch (found.status) {
    case Status::Feasible:
      std::cout << "s SATISFIABLE\n";
      break;
    case Status::Optimal:
      std::cout << "s OPTIMUM FOUND\n";
      break;
    case Status::Infeasible:
      std::cout << "s UNSATISFIABLE\n";
      return ExitCode::Done;
    case Status::Limit:
      std::cout << "s UNKNOWN\n";
      return ExitCode::Open;
  }
  print_model(found.model);
  const bool is_settled =
      found.status == Status::Optimal || !program.has_objective;
  return is_settled ? ExitCode::Done : ExitCode::Open;
}

ExitCode check(const Options& options, const ilp::Program& program) {
  std::istringstream log(io::read_file(options.check_proof));
  ilp::ProofChecker checker(program.problem, program.objective);
  const std::string flaw = checker.first_flaw(log);
  if (!flaw.empty()) {
    std::cout << "s NOT VERIFIED\nc " << options.check_proof << ": " << flaw
              << '\n';
    return ExitCode::Open;
  }
  if (checker.best())
    std::cout << "o " << *checker.best() + program.offset << '\n';
  if (!checker.is_refuted()) {
    std::cout << "s NOT VERIFIED\nc the log ends without a refutation\n";
    return ExitCode::Open;
  }
  std::cout << (checker.best() ? "s VERIFIED OPTIMUM\n"
                               : "s VERIFIED UNSATISFIABLE\n");
  return ExitCode::Done;
}

void require_outputs(const Options& options) {
  const std::array inputs = {options.in, options.check_proof};
  const std::array outputs = {options.proof, options.opb, options.lp,
                              options.mps};
  require_no_input(inputs, outputs);
  require_different(outputs);
}

ExitCode run(const Options& options) {
  require_outputs(options);
  const std::string name = options.in == "-" ? "<stdin>" : options.in;
  const std::string text = io::read_file(options.in);
  if (text.empty()) throw io::ParseError(name + ": the file is empty");
  const ilp::Program program = ilp::read_opb(text, name);
  std::cout << "c " << program.problem.n_variables() << " variables, "
            << program.problem.n_clauses() << " clauses, "
            << program.problem.n_linear() << " linear constraints\n";
  export_program(options, program);
  return options.check_proof.empty() ? solve(options, program)
                                     : check(options, program);
}

constexpr const char* kFooter =
    R"(Prints the lines of the pseudo-Boolean competitions: c a comment, o the sum of
a better model, s the answer, v the model. Exit code 0: answered; 3: a limit or
Ctrl-C came first, or the log does not verify.

Examples:
  umbrella solve program.opb --proof program.log
  umbrella solve program.opb --check-proof program.log
  umbrella solve program.opb --conflicts 0 --write-mps program.mps)";

}  // namespace

void add_solve(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* const sub = app.add_subcommand("solve", "Solve a 0/1 program");
  sub->footer(kFooter);
  sub->add_option("file", options->in, "OPB file, - for standard input")
      ->required()
      ->check(path_problem)
      ->type_name("FILE");
  const auto file = [sub](const char* name, std::string& path,
                          const char* what) {
    return sub->add_option(name, path, what)
        ->check(file_problem)
        ->type_name("FILE");
  };
  file("--proof", options->proof, "Log what the search derives");
  sub->add_option("--check-proof", options->check_proof,
                  "Check such a log instead of searching, - for standard input")
      ->check(path_problem)
      ->excludes("--proof")
      ->type_name("FILE");
  file("--write-opb", options->opb, "Write the program as OPB");
  file("--write-lp", options->lp, "Write the program as CPLEX LP");
  file("--write-mps", options->mps, "Write the program as free MPS");
  sub->add_option("--time-limit", options->limits.seconds,
                  "Seconds of search [none]")
      ->check(seconds_problem)
      ->type_name("S");
  sub->add_option("--conflicts", options->limits.conflicts,
                  "Conflicts of the search [no limit]")
      ->check(count_problem)
      ->type_name("N");
  sub->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace command
