#include "apps/option_checks.h"

namespace command {

std::string path_problem(const std::string& text) {
  return text.empty() ? "the name of a file is empty" : "";
}

std::string file_problem(const std::string& text) {
  return text == "-" ? "cannot be standard output" : path_problem(text);
}

std::string seconds_problem(const std::string& text) {
  double value = 0;
  const bool is_time =
      CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 1e9;
  return is_time ? "" : "Value " + text + " not in range 0 to 1e9";
}

std::string count_problem(const std::string& text) {
  return text.starts_with('-') ? "Value " + text + " is negative" : "";
}

std::string choice_problem(const std::string& text,
                           std::span<const std::string> names) {
  if (std::ranges::find(names, text) != names.end()) return "";
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return "'" + text + "' is none of " + list;
}

}  // namespace command
