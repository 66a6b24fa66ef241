/// @file
/// Checks of option values, for CLI::Option::check(): each returns what is
/// wrong, or nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// Empty names are refused.
std::string path_problem(const std::string& text);

/// Likewise, and standard output, which takes other lines.
std::string file_problem(const std::string& text);

/// A time from 0 to 1e9. (CLI::Range lets NaN through.)
std::string seconds_problem(const std::string& text);

/// A number without a sign. (CLI takes -1 for a large one.)
std::string count_problem(const std::string& text);

/// Not one of `names`, which the message lists.
std::string choice_problem(const std::string& text,
                           std::span<const std::string> names);

struct OptionText {
  const char* name;   ///< "--stage"
  const char* value;  ///< "STAGE"
  std::string about;
};

/// An option with a value for each of a few names, and none else.
/// (CLI::CheckedTransformer also takes the numbers behind the names, and shows
/// them in its messages.)
template <class Target, class Value>
void add_choice(CLI::App& sub, const OptionText& text, Target& target,
                const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const auto& choice : choices) names.push_back(choice.first);
  sub.add_option_function<std::string>(
         text.name,
         [&target, choices](const std::string& name) {
           target = std::ranges::find(choices, name,
                                      &std::pair<std::string, Value>::first)
                        ->second;
         },
         text.about)
      ->check([names](const std::string& name) {
        return choice_problem(name, names);
      })
      ->type_name(text.value);
}

}  // namespace command
