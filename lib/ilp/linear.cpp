// A row is kept as weights of literals, all positive: a x = a + (-a) not x. Its
// slack is what the literals counted so far leave of the bound. Nothing is
// forced while the slack covers the heaviest open literal; as the terms are
// sorted, that one is found by going on from where the last look ended.
// A negative slack is a conflict; a literal heavier than the slack is false.

#include "ilp/linear.h"

#include <algorithm>
#include <cassert>

namespace ilp {
namespace {

Reason linear_reason(std::uint32_t row) {
  return {Reason::Kind::Linear, row, {}};
}

}  // namespace

Linears::Linears(const Problem& problem) : n_variables_(problem.n_variables()) {
  for (std::size_t i = 0; i < problem.n_linear(); ++i)
    add_row(problem.linear(i), problem.bound(i));
}

Linears::Row Linears::normal_form(std::span<const Term> terms,
                                  std::int64_t bound) {
  Row row;
  for (const auto& [var, a] : terms) {
    if (a > 0) row.terms.push_back({Literal(var, true), a});
    if (a >= 0) continue;
    row.terms.push_back({Literal(var, false), -a});
    row.offset -= a;
  }
  row.bound = bound + row.offset;
  std::ranges::sort(row.terms, [](const auto& s, const auto& t) {
    return s.weight != t.weight ? s.weight > t.weight : s.literal < t.literal;
  });
  row.slack = row.bound;
  return row;
}

std::uint32_t Linears::add_row(std::span<const Term> terms,
                               std::int64_t bound) {
  const std::uint32_t r = size();
  rows_.push_back(normal_form(terms, bound));
  rows_of_.resize(2 * n_variables_);
  for (const auto& [literal, weight] : rows_.back().terms)
    rows_of_[literal.code()].push_back({r, weight});
  return r;
}

void Linears::add(std::span<const Term> terms, std::int64_t bound,
                  std::span<const Literal> counted) {
  const std::uint32_t r = add_row(terms, bound);
  for (const Literal l : counted)
    for (const auto& [row, weight] : rows_of_[l.code()])
      if (row == r) rows_[r].slack -= weight;
}

void Linears::tighten(std::uint32_t row, std::int64_t bound) {
  Row& r = rows_[row];
  const std::int64_t decrease = r.bound - r.offset - bound;
  assert(decrease >= 0);
  r.bound -= decrease;
  r.slack -= decrease;
}

bool Linears::start(Assignment& assignment, Conflict& conflict) {
  for (std::uint32_t r = 0; r < size(); ++r)
    if (!settle(r, assignment, conflict)) return false;
  return true;
}

bool Linears::settle(std::uint32_t r, Assignment& assignment,
                     Conflict& conflict) {
  Row& row = rows_[r];
  if (row.slack < 0) {
    conflict = {linear_reason(r), {}};
    const auto end = static_cast<std::uint32_t>(assignment.trail().size());
    append_heaviest(row, assignment, {end, row.bound}, conflict.literals);
    return false;
  }
  if (row.n_reopened != n_reopened_) row.first = 0;
  row.n_reopened = n_reopened_;
  for (; row.first < row.terms.size(); ++row.first) {
    const auto& [literal, weight] = row.terms[row.first];
    if (!assignment.is_open(literal.var())) continue;
    if (weight <= row.slack) break;
    assignment.assign(!literal, linear_reason(r));
  }
  return true;
}

void Linears::take(Literal l) {
  for (const auto& [row, weight] : rows_of_[l.code()])
    rows_[row].slack -= weight;
}

bool Linears::settle_rows_of(Literal l, Assignment& assignment,
                             Conflict& conflict) {
  for (const auto& [row, weight] : rows_of_[l.code()])
    if (!settle(row, assignment, conflict)) return false;
  return true;
}

void Linears::give_back(Literal l) {
  for (const auto& [row, weight] : rows_of_[l.code()])
    rows_[row].slack += weight;
}

// The heaviest literals that came to hold before `end`, until they weigh more
// than the limit.
void Linears::append_heaviest(const Row& row, const Assignment& assignment,
                              Until until, std::vector<Literal>& out) {
  for (const auto& [literal, weight] : row.terms) {
    if (until.limit < 0) return;
    if (!assignment.holds(literal) ||
        assignment.position(literal.var()) >= until.position)
      continue;
    out.push_back(literal);
    until.limit -= weight;
  }
  assert(until.limit < 0);
}

void Linears::explain(Literal l, const Assignment& assignment,
                      std::vector<Literal>& out) const {
  const std::uint32_t r = assignment.reason(l.var()).index;
  const auto& rows = rows_of_[(!l).code()];
  const auto own = std::ranges::lower_bound(rows, r, {}, &Occurrence::row);
  append_heaviest(rows_[r], assignment,
                  {assignment.position(l.var()), rows_[r].bound - own->weight},
                  out);
}

}  // namespace ilp
