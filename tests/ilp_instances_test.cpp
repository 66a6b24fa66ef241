// Hand-written programs in data/programs; each says its answer in its second
// line, `* answer: satisfiable`, `unsatisfiable` or `optimum N`. Runs in the
// project's root folder.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "ilp/formats.h"
#include "ilp/minimize.h"
#include "ilp/solver.h"
#include "tests/support/ilp_proofs.h"

namespace {

namespace fs = std::filesystem;

using ilp::Minimum;
using ilp::Program;
using ilp::Solver;
using ilp::Status;

std::vector<fs::path> instances() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator("data/programs"))
    files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string expected_answer(const std::string& text) {
  const std::string key = "* answer: ";
  const std::size_t begin = text.find(key) + key.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

std::string answer(const Program& program) {
  Solver solver(program.problem);
  support::CheckedLog checked(program.problem, program.objective);
  solver.set_log(checked.log());
  Minimum found;
  if (program.has_objective) {
    found = minimize_sum(solver, program.objective);
  } else {
    found = {solver.solve(), solver.model(), 0};
  }
  EXPECT_EQ(checked.first_flaw(), "");
  EXPECT_EQ(checked.checker().is_refuted(), found.status != Status::Feasible);
  if (found.status == Status::Infeasible) return "unsatisfiable";
  EXPECT_EQ(first_violation(program.problem, found.model), "");
  if (found.status == Status::Feasible) return "satisfiable";
  return "optimum " + std::to_string(found.sum + program.offset);
}

TEST(Instances, HaveTheAnswerThatTheyState) {
  const std::vector<fs::path> files = instances();
  EXPECT_GE(files.size(), 10U);
  for (const fs::path& path : files) {
    SCOPED_TRACE(path);
    const std::string text = content(path);
    EXPECT_EQ(answer(ilp::read_opb(text, path)), expected_answer(text));
  }
}

}  // namespace
