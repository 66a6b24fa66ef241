#include "apps/program_files.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "apps/paths.h"
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

// Whether the file is PREFIX-k of some k.
bool is_program(const std::filesystem::path& file, const std::string& prefix,
                const std::string& extension) {
  const std::filesystem::path first = place(path(prefix, 1, ""));
  if (file.parent_path() != first.parent_path()) return false;
  std::string start = first.filename();
  start.pop_back();  // the 1
  const std::string name = file.filename();
  if (!name.starts_with(start) || !name.ends_with(extension) ||
      name.size() <= start.size() + extension.size())
    return false;
  return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start.size()),
                     name.end() - static_cast<std::ptrdiff_t>(extension.size()),
                     [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void require_apart(const ProgramPrefixes& prefixes,
                   std::span<const std::string> files) {
  for_each_format(prefixes, [files](const std::string& prefix,
                                    const char* extension, auto) {
    for (const std::string& file : files)
      if (!file.empty() && file != "-" &&
          is_program(place(file), prefix, extension))
        throw std::invalid_argument(path(prefix, 1, extension) +
                                    ", ...: would overwrite " + file);
  });
}

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
