#include "apps/program_files.h"

#include <sstream>
#include <utility>

#include "ilp/formats.h"
#include "ilp/linear_form.h"
#include "ilp/solver.h"
#include "io/file.h"

namespace command {
namespace {

std::string path(const std::string& prefix, std::size_t number,
                 const char* extension) {
  return prefix + "-" + std::to_string(number) + extension;
}

const char* name(ilp::Status status) {
  switch (status) {
    case ilp::Status::Feasible:
    case ilp::Status::Optimal:
      return "feasible";
    case ilp::Status::Infeasible:
      return "infeasible";
    case ilp::Status::Limit:
      break;
  }
  return "limit";
}

// Calls visit(prefix, extension, writer) for each format asked for.
template <class Visit>
void for_each_format(const ProgramPrefixes& prefixes, Visit visit) {
  if (!prefixes.opb.empty()) visit(prefixes.opb, ".opb", ilp::write_opb);
  if (!prefixes.lp.empty()) visit(prefixes.lp, ".lp", ilp::write_lp);
  if (!prefixes.mps.empty()) visit(prefixes.mps, ".mps", ilp::write_mps);
}

}  // namespace

void require_writable(const ProgramPrefixes& prefixes) {
  for_each_format(prefixes,
                  [](const std::string& prefix, const char* extension, auto) {
                    io::require_writable(path(prefix, 1, extension));
                  });
}

ProgramFiles::ProgramFiles(ProgramPrefixes prefixes)
    : prefixes_(std::move(prefixes)) {}

void ProgramFiles::add(const ilp::LinearForm& form, ilp::Status status) {
  answers_.push_back(name(status));
  for_each_format(prefixes_, [&](const std::string& prefix,
                                 const char* extension, auto write) {
    std::ostringstream text;
    write(text, form);
    io::write_file(path(prefix, answers_.size(), extension), text.str());
  });
}

}  // namespace command
