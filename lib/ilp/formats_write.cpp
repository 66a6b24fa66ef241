#include <algorithm>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "ilp/formats.h"
#include "ilp/rows.h"

namespace ilp {
namespace {

std::string name(VarId var) {
  return std::string("x").append(std::to_string(index(var) + 1));
}
std::string row_name(std::size_t i) {
  return std::string("c").append(std::to_string(i + 1));
}

// "+1 x2 -3 x5"; readers of LP want lines below 510 characters.
void write_sum(std::ostream& out, std::span<const Term> terms,
               const char* sign_end, const char* line_break) {
  constexpr std::size_t kTermsPerLine = 10;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::int64_t a = terms[i].coefficient;
    out << (i == 0                   ? ""
            : i % kTermsPerLine == 0 ? line_break
                                     : " ")
        << (a < 0 ? "-" : "+") << sign_end << (a < 0 ? -a : a) << ' '
        << name(terms[i].var);
  }
}

// Formats want a variable in every row and every objective.
std::vector<Term> at_least_one(std::vector<Term> terms) {
  if (terms.empty()) terms.push_back({VarId{0}, 0});
  return terms;
}

LinearForm without_empty_sums(LinearForm form) {
  form.n_variables = std::max<std::size_t>(form.n_variables, 1);
  form.objective = at_least_one(form.objective);
  for (LinearRow& row : form.rows) row.terms = at_least_one(row.terms);
  return form;
}

void write_columns(std::ostream& out, const LinearForm& form) {
  struct Entry {
    std::size_t row;  // 0 is the objective
    Term term;
  };
  std::vector<Entry> entries;
  for (const Term& t : form.objective) entries.push_back({0, t});
  for (std::size_t i = 0; i < form.rows.size(); ++i)
    for (const Term& t : form.rows[i].terms) entries.push_back({i + 1, t});
  const auto columns = Rows<Entry>::grouped(
      form.n_variables, entries.size(),
      [&entries](std::size_t i) { return index(entries[i].term.var); },
      [&entries](std::size_t i) { return entries[i]; });
  for (std::uint32_t v = 0; v < form.n_variables; ++v) {
    if (columns[v].empty()) out << " " << name(VarId{v}) << " obj 0\n";
    for (const auto& [row, term] : columns[v])
      out << " " << name(VarId{v}) << " "
          << (row == 0 ? "obj" : row_name(row - 1)) << " " << term.coefficient
          << '\n';
  }
}

}  // namespace

void write_opb(std::ostream& out, const LinearForm& given) {
  const LinearForm form = without_empty_sums(given);
  out << "* #variable= " << form.n_variables
      << " #constraint= " << form.rows.size() << '\n';
  if (!given.objective.empty()) {
    out << "min: ";
    write_sum(out, form.objective, "", "\n ");
    out << " ;\n";
  }
  for (const LinearRow& row : form.rows) {
    write_sum(out, row.terms, "", "\n ");
    out << (row.is_equation ? " = " : " >= ") << row.bound << " ;\n";
  }
}

void write_lp(std::ostream& out, const LinearForm& given) {
  const LinearForm form = without_empty_sums(given);
  out << "Minimize\n obj: ";
  write_sum(out, form.objective, " ", "\n ");
  out << "\nSubject To\n";
  for (std::size_t i = 0; i < form.rows.size(); ++i) {
    out << ' ' << row_name(i) << ": ";
    write_sum(out, form.rows[i].terms, " ", "\n ");
    out << (form.rows[i].is_equation ? " = " : " >= ") << form.rows[i].bound
        << '\n';
  }
  out << "Binary\n";
  for (std::uint32_t v = 0; v < form.n_variables; ++v)
    out << ' ' << name(VarId{v}) << '\n';
  out << "End\n";
}

void write_mps(std::ostream& out, const LinearForm& given) {
  const LinearForm form = without_empty_sums(given);
  out << "NAME umbrella FREE\nROWS\n N obj\n";
  for (std::size_t i = 0; i < form.rows.size(); ++i)
    out << (form.rows[i].is_equation ? " E " : " G ") << row_name(i) << '\n';
  out << "COLUMNS\n MARKER 'MARKER' 'INTORG'\n";
  write_columns(out, form);
  out << " MARKER 'MARKER' 'INTEND'\nRHS\n";
  for (std::size_t i = 0; i < form.rows.size(); ++i)
    if (form.rows[i].bound != 0)
      out << " RHS " << row_name(i) << " " << form.rows[i].bound << '\n';
  out << "BOUNDS\n";
  for (std::uint32_t v = 0; v < form.n_variables; ++v)
    out << " BV BND " << name(VarId{v}) << '\n';
  out << "ENDATA\n";
}

}  // namespace ilp
