#include "tests/support/cbc_peer.h"

#include <coin/Cbc_C_Interface.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ilp/linear_form.h"
#include "ilp/rows.h"

namespace support {
namespace {

using ilp::Cycle;
using ilp::LinearForm;
using ilp::LinearRow;
using ilp::Minimum;
using ilp::Model;
using ilp::Problem;
using ilp::Status;
using ilp::VarId;

using CbcPointer = std::unique_ptr<Cbc_Model, decltype(&Cbc_deleteModel)>;

struct Entry {
  std::uint32_t var;
  int row;
  double coefficient;
};

CbcPointer model_of(const LinearForm& form, double seconds) {
  std::vector<Entry> entries;
  std::vector<double> lower, upper;
  for (const LinearRow& row : form.rows) {
    for (const auto& [var, a] : row.terms)
      entries.push_back({static_cast<std::uint32_t>(index(var)),
                         static_cast<int>(lower.size()),
                         static_cast<double>(a)});
    const auto bound = static_cast<double>(row.bound);
    lower.push_back(bound);
    upper.push_back(row.is_equation ? bound
                                    : std::numeric_limits<double>::infinity());
  }
  const auto columns = ilp::Rows<Entry>::grouped(
      form.n_variables, entries.size(),
      [&entries](std::size_t i) { return entries[i].var; },
      [&entries](std::size_t i) { return entries[i]; });
  std::vector<int> start = {0}, rows;
  std::vector<double> values;
  for (std::size_t v = 0; v < form.n_variables; ++v) {
    for (const Entry& e : columns[v]) {
      rows.push_back(e.row);
      values.push_back(e.coefficient);
    }
    start.push_back(static_cast<int>(rows.size()));
  }
  const auto n = static_cast<int>(form.n_variables);
  const std::vector<double> zeros(form.n_variables, 0),
      ones(form.n_variables, 1);
  CbcPointer model(Cbc_newModel(), &Cbc_deleteModel);
  Cbc_loadProblem(model.get(), n, static_cast<int>(lower.size()), start.data(),
                  rows.data(), values.data(), zeros.data(), ones.data(),
                  zeros.data(), lower.data(), upper.data());
  for (int v = 0; v < n; ++v) Cbc_setInteger(model.get(), v);
  Cbc_setParameter(model.get(), "logLevel", "0");
  Cbc_setParameter(model.get(), "seconds", std::to_string(seconds).c_str());
  Cbc_setParameter(model.get(), "timeMode", "elapsed");
  return model;
}

}  // namespace

Minimum solve_by_inequalities(const Problem& problem, double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  std::vector<Cycle> cycles;
  for (;;) {
    const std::chrono::duration<double> passed = Clock::now() - begin;
    if (passed.count() > seconds) return {Status::Limit, {}, 0};
    const CbcPointer cbc =
        model_of(linear_form(problem, cycles), seconds - passed.count());
    Cbc_solve(cbc.get());
    if (Cbc_isProvenInfeasible(cbc.get()) != 0)
      return {Status::Infeasible, {}, 0};
    const double* solution = Cbc_bestSolution(cbc.get());
    if (Cbc_isProvenOptimal(cbc.get()) == 0 || solution == nullptr)
      return {Status::Limit, {}, 0};
    Model model;
    for (std::size_t v = 0; v < problem.n_variables(); ++v)
      model.push_back(solution[v] > 0.5);
    const std::vector<Cycle> excess = excess_cycles(problem, model);
    if (excess.empty()) return {Status::Feasible, model, 0};
    cycles.insert(cycles.end(), excess.begin(), excess.end());
  }
}

}  // namespace support
